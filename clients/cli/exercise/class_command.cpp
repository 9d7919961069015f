// skerry class: codes by which trainees sign in to a running server without accounts.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "clients/cli/console.hpp"
#include "clients/cli/exercise/exercise_link.hpp"
#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

struct ClassOptions {
  ExercisePlace place;
  std::string ship;
  double minutes = 0;        // 0: the server's usual time
  std::uint32_t digits = 0;  // 0: its usual number
};

// "123 456"
std::string spaced(const std::string& code) {
  const std::size_t half = code.size() / 2;
  return code.empty() ? "spent" : code.substr(0, half) + " " + code.substr(half);
}

std::string time_left(std::uint64_t ends_utc_ns) {
  using namespace std::chrono;
  const auto ends = nanoseconds(static_cast<std::int64_t>(ends_utc_ns));
  const auto now = system_clock::now().time_since_epoch();
  const std::int64_t left = std::max<std::int64_t>(ceil<minutes>(ends - now).count(), 0);
  return fmt::format("{}:{:02}", left / 60, left % 60);
}

std::string list_text(const wire::ClassList& list) {
  if (list.codes().empty()) return "no class codes\n";
  std::string text =
      fmt::format("{:<20} {:<11} {:<6} {:<6} {}\n", "ship", "code", "left", "wrong", "signed in");
  for (const wire::ClassCode& code : list.codes()) {
    std::string names;
    for (const std::string& name : code.trainees()) {
      names += (names.empty() ? "" : ", ") + printable(name, 64);
    }
    text += fmt::format("{:<20} {:<11} {:<6} {:<6} {}\n", printable(code.ship(), 64),
                        spaced(printable(code.code(), 16)), time_left(code.ends_utc_ns()),
                        fmt::format("{}/{}", code.wrong(), code.wrong_most()),
                        names.empty() ? "nobody" : names);
  }
  return text;
}

int order(const ClassOptions& options, wire::ClassOrder order, bool lists) {
  auto client = options.place.server.connect();
  if (!client) return report(client.error());
  order.set_token(options.place.token);
  const auto list = client->order_class(order, options.place.timeout());
  if (!list) return report_refusal(list.error(), "skerry class list tells what there is.");
  if (lists) {
    write_out(list_text(*list));
    return kExitOk;
  }
  for (const wire::ClassCode& code : list->codes()) {
    if (!order.has_make() || code.ship() != options.ship) continue;
    write_out(spaced(printable(code.code(), 16)) + "\n");
    fmt::print(stderr,
               "Whoever signs in with it is a trainee of {} for {} (hours:minutes).  It can be had "
               "again by\n`skerry class list`, and ends by `skerry class end`.\n",
               printable(code.ship(), 64), time_left(code.ends_utc_ns()));
  }
  return kExitOk;
}

}  // namespace

Command make_class_command(CLI::App& app) {
  auto* command = app.add_subcommand("class", "Codes by which trainees sign in without accounts");
  command->require_subcommand(1);
  command->footer(
      "A ship has one code; another one ends the one before, and with it who signed in by it.\n"
      "Examples:\n"
      "  skerry class new Frida                 prints it\n"
      "  skerry class new Frida --for 90m --digits 8\n"
      "  skerry class list                      codes, and who signed in by each\n"
      "  skerry class end Frida\n");
  const auto options = std::make_shared<ClassOptions>();
  auto* made = command->add_subcommand("new", "Makes a ship's code and prints it");
  made->add_option("--for", options->minutes, "How long it holds: 90m, 8h (4h)")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"m", 1}, {"h", 60}},
                                        CLI::AsNumberWithUnit::UNIT_REQUIRED))
      ->check(CLI::Range(1.0, 24.0 * 60.0))
      ->type_name("TIME");
  made->add_option("--digits", options->digits, "Of the code: 6 to 8 (6)")->check(CLI::Range(6, 8));
  auto* list = command->add_subcommand("list", "Lists the codes, and who has signed in by them");
  auto* ended = command->add_subcommand("end", "Ends a ship's code; who signed in by it is out");
  for (CLI::App* each : {made, ended}) {
    each->add_option("SHIP", options->ship, "Own ship, as skerry status has her")->required();
  }
  for (CLI::App* each : {made, list, ended}) options->place.add_options(*each);
  return {command, [=] {
            wire::ClassOrder wanted;
            if (made->parsed()) {
              wanted.mutable_make()->set_ship(options->ship);
              wanted.mutable_make()->set_minutes(static_cast<std::uint32_t>(options->minutes));
              wanted.mutable_make()->set_digits(options->digits);
            } else if (ended->parsed()) {
              wanted.set_end(options->ship);
            }
            return order(*options, std::move(wanted), list->parsed());
          }};
}

}  // namespace skerry::client
