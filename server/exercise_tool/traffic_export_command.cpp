#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "echo/tool_console/console.hpp"
#include "echo/tool_console/part_file.hpp"
#include "protocol/nmea/log_time.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/exercise_tool/traffic_export.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string file, out;
  std::string begin;
  double minutes = 0.0;
  std::optional<double> every_s;
  bool own_ships = false, force = false;
};

int export_traffic(const ExportOptions& options) {
  const std::string ending = fs::path(options.out).extension().string();
  if (ending != ".csv" && ending != ".nmea") {
    return echo::report(fmt::format("{} ends neither in .nmea nor in .csv", options.out),
                        "The ending says what is written: a log of sentences or a table.");
  }
  std::error_code ignored;
  if (!options.force && fs::exists(options.out, ignored)) {
    return echo::report(fmt::format("{} is there already", options.out),
                        "Name another file, or give --force to write over it.");
  }
  // What was there stays until all of the new is.
  echo::PartFile part(options.out);
  TrafficExport wanted;
  wanted.form = ending == ".csv" ? TrafficForm::csv : TrafficForm::nmea;
  wanted.minutes = options.minutes;
  wanted.own_ships = options.own_ships;
  if (options.every_s) wanted.every = seconds_as_duration(std::round(*options.every_s));
  if (!options.begin.empty()) wanted.begin = nmea::log_time_of(options.begin);
  ExportedTraffic done;
  {
    echo::Progress progress;
    done = export_traffic(
        options.file, wanted, [&](std::string_view text) { part.write(text); },
        [&](double share) { progress.show(fmt::format("{:.0f} %", 100.0 * share)); });
  }
  part.finish();
  echo::write_out(fmt::format("{}: {} reports of {} ships and marks in {:.1f} min\n", options.out,
                              done.reports, done.ships, done.minutes));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_traffic_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand(
      "export", "Runs a scenario or a recorded exercise, and writes what its AIS says");
  command
      ->add_option("SCENARIO", options->file,
                   "a scenario file, a shipped exercise's name, or a recording (.mcap)")
      ->required();
  command->add_option("-o,--output", options->out, "FILE.nmea or FILE.csv")->required();
  command->add_option("--minutes", options->minutes, "instead of the exercise's or recording's")
      ->check(CLI::Range(0.1, 10'000.0));
  command->add_option("--every", options->every_s, "whole seconds, instead of the intervals of AIS")
      ->check(CLI::Range(1.0, 3600.0));
  command
      ->add_option("--begin", options->begin,
                   "when it begins; without it 2026-01-01T00:00:00Z, or the recording's own begin")
      ->check([](const std::string& text) {
        return nmea::log_time_of(text) ? std::string()
                                       : text + " is no time; expected 2021-01-05T01:51:55Z";
      });
  command->add_flag("--own-ships", options->own_ships, "own ships too");
  command->add_flag("--force", options->force, "write over a file");
  command->footer(
      "It runs as fast as it can.  Nobody steers a scenario; a recorded exercise has its orders.\n"
      "Intervals of AIS: class A 10 s, above 14 kn 6 s, above 23 kn 2 s, less in turns, 3 min at\n"
      "anchor; class B 30 s.\n"
      "Examples:\n"
      "  skerry traffic export tss -o tss.nmea\n"
      "  skerry traffic export mine.yaml -o mine.csv --minutes 60 --every 10\n"
      "  skerry traffic export lesson.mcap -o lesson.nmea --own-ships\n");
  return {command, [options] { return export_traffic(*options); }};
}

}  // namespace skerry::server
