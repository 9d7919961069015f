// skerry board watch: the board's events and edges, a line each.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "clients/cli/board/board_command.hpp"
#include "clients/cli/board/board_words.hpp"
#include "clients/cli/console.hpp"

namespace skerry::client {
namespace {

struct WatchOptions {
  BoardPlace place;
  std::optional<std::uint64_t> count;
  bool edges = false;
  bool sweeps = false;
};

class Watch {
 public:
  explicit Watch(const WatchOptions& options) : options_(options) {}

  bool done() const { return options_.count && lines_ >= *options_.count; }

  void take(const board::Event& event) {
    std::string what;
    switch (event.event) {
      case board::event::arp:
        what = fmt::format("count {}", event.value);
        break;
      case board::event::fault_raised:
      case board::event::fault_cleared:
        what = fault_words(event.faults);
        break;
      default:
        break;
    }
    line(event.tick, event_words(event.event), what);
  }

  void take(const board::Edges& edges) {
    clock_hz_ = edges.sample_clock_hz;
    if (!options_.edges) return;
    static constexpr std::array kNames = {"TRIGGER", "ACP", "ARP", "HEADING"};
    for (const board::Edge& edge : edges.edges) {
      if (done()) return;
      line(edge.tick, kNames[static_cast<std::size_t>(edge.line) % kNames.size()], "");
    }
  }

  void take(const board::Sweep& sweep) {
    clock_hz_ = sweep.meta.sample_clock_hz;
    if (!options_.sweeps) return;
    const board::SweepMeta& meta = sweep.meta;
    const std::string formed =
        meta.spokes_per_turn == 0
            ? ""
            : fmt::format(", spoke {} of {}, {} {}", meta.spoke, meta.spokes_per_turn, meta.pulses,
                          meta.pulses == 1 ? "pulse" : "pulses");
    line(meta.trigger_tick, meta.spokes_per_turn == 0 ? "sweep" : "spoke",
         fmt::format("{} at {:.3f} deg, ACP {} + {}/{}, ARP {}{}, faults: {}", meta.trigger_count,
                     azimuth_deg(meta), meta.acp_count, meta.ticks_since_acp, meta.acp_period,
                     meta.arp_count, formed, fault_words(meta.faults)));
  }

  void set_clock(std::uint32_t clock_hz) { clock_hz_ = clock_hz; }

 private:
  void line(std::uint64_t tick, const std::string& kind, const std::string& what) {
    const double seconds = clock_hz_ == 0 ? 0.0 : static_cast<double>(tick) / clock_hz_;
    std::string text = fmt::format("{:>16.9f} s {:>16}  {:<14} {}", seconds, tick, kind, what);
    text.erase(text.find_last_not_of(' ') + 1);
    write_out(text + "\n");
    ++lines_;
  }

  const WatchOptions& options_;
  std::uint32_t clock_hz_ = 0;
  std::uint64_t lines_ = 0;
};

int run_watch(const WatchOptions& options) {
  const bool all = options.sweeps || options.place.stream == "shm";
  auto client = options.place.connect();
  if (!client) return report_board(client.error());
  const auto known = client->access({{.address = board::address_of(board::Reg::sample_clock_hz)},
                                     {.address = board::address_of(board::Reg::event_enable)},
                                     {.address = board::address_of(board::Reg::faults)}},
                                    options.place.timeout());
  if (!known) return report_board(known.error());
  Watch watch(options);
  watch.set_clock((*known)[0].value);
  fmt::print(stderr, "# events enabled: {}; faults now: {}; Ctrl-C ends\n",
             event_words((*known)[1].value), fault_words((*known)[2].value));
  const auto begun =
      options.place.start(*client, all ? BoardStreamKind::records : BoardStreamKind::signals);
  if (!begun) return report_board(begun.error());
  while (!watch.done() && !interrupted()) {
    auto record = client->next(kLookAround);
    if (!record) return report_board(record.error());
    if (!*record) continue;
    std::visit([&](const auto& came) { watch.take(came); }, (*record)->record);
  }
  if (client->records_lost() > 0) {
    fmt::print(stderr, "skerry: {} records were lost on the way\n", client->records_lost());
  }
  return kExitOk;
}

}  // namespace

Command make_board_watch_command(CLI::App& board) {
  auto options = std::make_shared<WatchOptions>();
  CLI::App* command =
      board.add_subcommand("watch", "Writes the board's events (ARP, faults ...) as they come");
  options->place.add_options(*command);
  options->place.add_stream_option(*command);
  command->add_option("--count", options->count, "End after so many lines")
      ->check(CLI::PositiveNumber);
  command->add_flag("--edges", options->edges, "Also every trigger, ACP, ARP and heading pulse");
  command->add_flag("--sweeps", options->sweeps, "Also every sweep's metadata");
  command->footer(
      "Each line: scenario time, tick of the sample clock, event.\n"
      "Examples:\n"
      "  skerry board watch\n"
      "  skerry board watch --edges --count 100\n"
      "  skerry board watch --sweeps --stream shm | head -20\n");
  return {command, [options] { return run_watch(*options); }};
}

}  // namespace skerry::client
