// skerry dump: one line per spoke.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "clients/cli/command.hpp"
#include "clients/cli/console.hpp"
#include "clients/cli/live/spoke_source.hpp"

namespace skerry::client {
namespace {

struct DumpOptions {
  ServerPlace place;
  std::optional<std::uint32_t> radar;
  std::uint32_t view = 0;
  std::optional<std::uint64_t> count;
  std::optional<std::uint32_t> turns;
  std::string format = "text";
  std::string udp, cat240;
};

ClientResult<SpokeSourcePtr> open_source(const DumpOptions& options) {
  if (!options.udp.empty()) {
    auto where = parse_udp_address(options.udp, kDefaultUdpPort);
    if (!where) return Failure{where.error()};
    return open_udp_source(*where, options.radar);
  }
  if (!options.cat240.empty()) {
    auto where = parse_udp_address(options.cat240, kDefaultCat240Port);
    if (!where) return Failure{where.error()};
    return open_cat240_source(*where);
  }
  return open_tcp_source(options.place, {options.radar.value_or(0), options.view});
}

// Lets through what --count and --turns ask for.
class Gate {
 public:
  explicit Gate(const DumpOptions& options) : options_(options) {}

  // Whole turns begin with the first spoke of the first turn whose beginning was seen.
  bool lets_through(const SourcedLine& sourced) {
    if (options_.turns && state_ != State::inside) {
      if (state_ == State::before) first_turn_ = sourced.turn;
      state_ = sourced.begins_turn || sourced.turn != first_turn_ ? State::inside : State::joined;
      if (state_ == State::joined) return false;
      first_turn_ = sourced.turn;
    }
    if (options_.turns && sourced.turn - first_turn_ >= *options_.turns) {
      done_ = true;
      return false;
    }
    ++passed_;
    if (options_.count && passed_ >= *options_.count) done_ = true;
    return true;
  }
  bool done() const { return done_; }

 private:
  const DumpOptions& options_;
  enum class State : std::uint8_t { before, joined, inside };
  State state_ = State::before;
  std::uint32_t first_turn_ = 0;  // while joined: the turn to be skipped
  std::uint64_t passed_ = 0;
  bool done_ = false;
};

void write_totals(const SpokeSource& source, LineFormat format) {
  std::string text = fmt::format("# received {}, lost {}", source.received(), source.lost());
  if (source.refused() > 0) text += fmt::format(", not understood {}", source.refused());
  text += '\n';
  if (format == LineFormat::text) {
    write_out(text);
  } else {
    fmt::print(stderr, "{}", text);
  }
}

LineFormat format_named(const std::string& name) {
  if (name == "csv") return LineFormat::csv;
  return name == "hex" ? LineFormat::hex : LineFormat::text;
}

int run_dump(const DumpOptions& options) {
  const LineFormat format = format_named(options.format);
  auto opened = open_source(options);
  if (!opened) return report(opened.error());
  SpokeSource& source = **opened;
  Gate gate(options);
  Progress progress;
  auto last_spoke = Clock::now();
  int exit_code = kExitOk;
  bool first_line = true;
  while (!gate.done() && !interrupted()) {
    auto next = source.next(kLookAround);
    if (!next) {
      exit_code = report(next.error());
      break;
    }
    if (*next) {
      last_spoke = Clock::now();
      if (!gate.lets_through(**next)) continue;
      if (std::exchange(first_line, false)) write_out(heading_line(format));
      write_out(format_line((*next)->line, format));
    } else if (Clock::now() - last_spoke > options.place.timeout()) {
      exit_code = report(
          fmt::format("no spokes from {} for {:g} s", source.name(), options.place.timeout_s),
          source.advice());
      break;
    } else if (first_line) {
      progress.show(fmt::format("waiting for spokes from {}", source.name()));
    }
  }
  write_totals(source, format);
  return exit_code;
}

}  // namespace

Command make_dump_command(CLI::App& app) {
  auto options = std::make_shared<DumpOptions>();
  CLI::App* command = app.add_subcommand("dump", "Writes one line per spoke");
  options->place.add_options(*command);
  command->add_option("--radar", options->radar, "Index of the radar; default: 0, with --udp all");
  command->add_option("--view", options->view, "Index of the view (TCP)")->capture_default_str();
  command->add_option("--count", options->count, "End after so many spokes")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--turns", options->turns,
                   "End after so many whole turns, the first from its beginning: from bow to bow, "
                   "with --cat240 from north to north")
      ->check(CLI::PositiveNumber);
  command->add_option("--format", options->format, "text, csv, or hex: csv and all cells")
      ->check(CLI::IsMember({"text", "csv", "hex"}))
      ->capture_default_str();
  const auto is_udp_address = [](const std::string& text) {
    const auto where = parse_udp_address(text, kDefaultUdpPort);
    return where ? std::string{} : where.error().text;
  };
  const CLI::Validator udp_address(is_udp_address, "[ADDRESS:]PORT", "udp address");
  CLI::Option* udp =
      command->add_option("--udp", options->udp,
                          "Native datagrams instead of TCP; a multicast address is joined, "
                          "without address: 127.0.0.1");
  CLI::Option* cat240 =
      command->add_option("--cat240", options->cat240, "ASTERIX CAT240 datagrams instead of TCP");
  udp->check(udp_address)->excludes(cat240);
  cat240->check(udp_address);
  command->footer(
      "Ends with the number of spokes received and lost; without --count and --turns with Ctrl-C.\n"
      "Examples:\n"
      "  skerry dump --count 10\n"
      "  skerry dump --turns 1 --format csv > turn.csv\n"
      "  skerry dump --udp 7411 --radar 1\n"
      "  skerry dump --cat240 239.192.43.78:8600 --format hex\n");
  return {command, [options] { return run_dump(*options); }};
}

}  // namespace skerry::client
