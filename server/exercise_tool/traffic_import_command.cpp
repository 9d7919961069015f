#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "echo/tool_console/console.hpp"
#include "protocol/nmea/log_time.hpp"
#include "protocol/quantity/length.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/traffic_logs/log_files.hpp"
#include "server/traffic_logs/traffic_fragment.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  std::vector<std::string> files;
  std::string out;
  std::string from, until, area;
  double tolerance_m = 30.0, gap_min = 15.0;
  std::size_t limit = 500;
  bool force = false;
};

// "57.5,11.2,10": degrees north, degrees east, nautical miles.
std::optional<TrackRules::Area> area_of(const std::string& text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (values.size() < 3) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    values.push_back(value);
    at = next;
    if (at == end) break;
    if (*at++ != ',') return std::nullopt;
  }
  if (values.size() != 3 || at != end || std::fabs(values[0]) > 90.0 ||
      std::fabs(values[1]) > 180.0 || values[2] <= 0.0 || values[2] > 1000.0) {
    return std::nullopt;
  }
  return TrackRules::Area{{values[0], wrapped_longitude(values[1])},
                          nautical_miles(values[2]).in_metres()};
}

CLI::Validator is_time() {
  return CLI::Validator(
      [](std::string& text) {
        return nmea::log_time_of(text) ? std::string()
                                       : text +
                                             " is no time; expected 2021-01-05T01:51:55Z or "
                                             "seconds since 1970";
      },
      "TIME");
}

CLI::Validator is_area() {
  return CLI::Validator(
      [](std::string& text) {
        return area_of(text) ? std::string()
                             : text +
                                   " is no area; expected LAT,LON,RADIUS_NM, the radius up to "
                                   "1000 NM";
      },
      "LAT,LON,RADIUS_NM");
}

std::string_view form_text(LogForm form) {
  switch (form) {
    case LogForm::csv:
      return "rows of a table";
    case LogForm::capture:
      return "datagrams with sentences";
    default:
      return "lines";
  }
}

void say_left_out(const LeftOutCounts& counts) {
  for (std::size_t i = 0; i < kLeftOutKinds; ++i) {
    const auto kind = static_cast<LeftOut>(i);
    if (counts.of(kind) == 0) continue;
    echo::write_out(fmt::format("{:>10}  left out: {}\n", counts.of(kind), name_of(kind)));
  }
}

int import_traffic(const ImportOptions& options) {
  std::error_code ignored;
  if (!options.force && fs::exists(options.out, ignored)) {
    return echo::report(fmt::format("{} is there already", options.out),
                        "Name another file, or give --force to write over it.");
  }
  TrackRules rules;
  rules.from = nmea::log_time_of(options.from);
  rules.until = nmea::log_time_of(options.until);
  if (rules.from && rules.until && *rules.from >= *rules.until) {
    return echo::report("--from is not before --until", "Give a --from that is earlier.");
  }
  rules.area = area_of(options.area);
  rules.tolerance_m = options.tolerance_m;
  rules.gap = seconds_as_duration(60.0 * options.gap_min);
  TrackBook book(rules);
  std::string origin = "AIS of";
  for (const std::string& file : options.files) {
    LogFileRead read;
    {
      echo::Progress progress;
      int shown = -1;
      const auto result = read_log_file(file, book, [&](double share) {
        const int percent = static_cast<int>(100.0 * share);
        if (percent == shown) return;
        shown = percent;
        progress.show(fmt::format("{}: {} %, {} fixes", file, percent, book.fixes()));
      });
      if (!result) {
        progress.clear();
        return echo::report(fmt::format("{}: {}", file, result.error()),
                            "Expected is a log of AIS sentences, a CSV table with a header, or a "
                            "capture (pcap).");
      }
      read = *result;
    }
    echo::write_out(fmt::format("{:>10}  {} of {}, {} used\n", read.lines, form_text(read.form),
                                file, read.used));
    origin += " " + fs::path(file).filename().string();
  }
  std::vector<LoggedShip> ships = book.finish();
  const LeftOutCounts left_out = book.left_out();
  const TrafficFragment made =
      traffic_fragment(std::move(ships), rules.from, {.most_targets = options.limit}, origin);
  say_left_out(left_out);
  if (made.targets == 0) {
    return echo::report("no ship is left that sailed",
                        "A ship needs two fixes with times; look at what was left out, and at "
                        "--from, --until and --area.");
  }
  echo::write_file(options.out, made.yaml);
  if (made.ships_beyond > 0) {
    echo::write_out(
        fmt::format("{:>10}  ships left out, those with the fewest fixes: a scenario "
                    "has room for {} tracks and 18000 waypoints; a smaller --area, a "
                    "shorter time or a larger --tolerance need less\n",
                    made.ships_beyond, options.limit));
  }
  echo::write_out(fmt::format(
      "{}: {} ships in {} tracks, {} fixes as {} waypoints, no fix is off by more than {:.1f} m\n"
      "minute 0 is {}, the last track ends at {:.0f} min; use it in a scenario:\n"
      "  include: [{}]\n",
      options.out, made.ships, made.targets, made.fixes, made.waypoints, made.worst_m,
      utc_text(made.begin), std::ceil(made.length_min), fs::path(options.out).filename().string()));
  return echo::kExitOk;
}

}  // namespace

CLI::App& add_traffic_commands(CLI::App& app) {
  CLI::App* traffic =
      app.add_subcommand("traffic", "Traffic from logs of AIS, and logs of AIS from exercises");
  traffic->require_subcommand(1);
  traffic->footer(
      "Examples:\n"
      "  skerry traffic import harbour.nmea -o traffic.yaml\n"
      "  skerry traffic export tss -o tss.nmea\n");
  return *traffic;
}

echo::Command make_traffic_import_command(CLI::App& app) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* command = app.add_subcommand("import", "Makes targets of a scenario from logs of AIS");
  command->add_option("FILE", options->files, "logs in the order of time, packed by gzip or not")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("-o,--output", options->out, "the scenario's part to write")->required();
  command->add_option("--from", options->from, "leave out what is before; minute 0 of the exercise")
      ->check(is_time());
  command->add_option("--until", options->until, "leave out what is after")->check(is_time());
  command->add_option("--area", options->area, "leave out what is outside of this circle")
      ->check(is_area());
  command
      ->add_option("--tolerance", options->tolerance_m,
                   "metres that a waypoint less may put a fix off")
      ->check(CLI::Range(0.0, 10'000.0))
      ->capture_default_str();
  command->add_option("--gap", options->gap_min, "minutes without a fix that end a track")
      ->check(CLI::Range(0.1, 1440.0))
      ->capture_default_str();
  command->add_option("--limit", options->limit, "most tracks; the ships heard most are kept")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000}))
      ->capture_default_str();
  command->add_flag("--force", options->force, "write over a file");
  command->footer(
      "FILE is a log of NMEA sentences (with TAG blocks or times before or behind them), a CSV\n"
      "table (as of the Danish Maritime Authority or MarineCadastre), or a capture (pcap).\n"
      "Times without a zone are UTC.  What is not used is counted by kind.\n"
      "Examples:\n"
      "  skerry traffic import harbour.nmea -o traffic.yaml\n"
      "  skerry traffic import aisdk-2024-03-01.csv -o traffic.yaml --area 55.7,12.7,12 \\\n"
      "    --from 2024-03-01T06:00:00Z --until 2024-03-01T08:00:00Z\n"
      "  skerry traffic import radar.pcap.gz -o traffic.yaml --tolerance 10\n");
  return {command, [options] { return import_traffic(*options); }};
}

}  // namespace skerry::server
