#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "echo/tool_console/console.hpp"
#include "protocol/recording/reader.hpp"
#include "server/app/coastline.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/version.hpp"
#include "server/debrief/chart_figure.hpp"
#include "server/debrief/csv_files.hpp"
#include "server/debrief/debrief_page.hpp"
#include "server/debrief/observer.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/exercise_tool/sheet_judge.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostCoastPoints = 30'000;

struct ReportOptions {
  std::string file, page, tables;
  ChartFiles charts;
  DebriefLimits limits;
  std::optional<double> until_min;
  bool no_checks = false;
};

void warn(const std::string& text) { fmt::print(stderr, "skerry exercise: {}\n", text); }

// The exercise's charts; those that are here if they are others.
std::unique_ptr<const echo::ChartSource> charts_of(const RecordedExercise& exercise,
                                                   const ReportOptions& options) {
  ChartFiles files = options.charts;
  if (!exercise.charts_json.empty()) {
    try {
      files = recorded_charts(exercise.charts_json, options.charts);
    } catch (const std::runtime_error& wrong) {
      warn(fmt::format("{}; the coast is drawn from what is here", wrong.what()));
    }
  }
  return open_charts(files.charts, files.elevation);
}

wire::Coastline coast_about(const echo::ChartSource& chart, const ChartExtent& extent) {
  wire::GetCoastline place;
  place.set_latitude_deg(extent.middle.latitude_deg);
  place.set_longitude_deg(extent.middle.longitude_deg);
  // The figure is at most half as much longer one way than the other.
  const double half_m = 1.6 * std::max(extent.half_east_m, extent.half_north_m);
  place.set_radius_nm(std::max(1.0, half_m / 1852.0));
  const double corner_m = std::sqrt(2.0) * place.radius_nm() * 1852.0;
  return coastline_of(chart.load(extent.middle, metres(corner_m)), place, kMostCoastPoints);
}

JudgedCheck judged_check(const scenario::ExerciseCheck& check, const ExercisePlan& plan,
                         const echo::ChartSource& chart, World world) {
  // In an exercise that runs at 20 times the pace ships leave their places within a turn.
  wire::ExerciseOrder steady;
  steady.mutable_clock()->set_rate(1.0);
  steady.mutable_clock()->set_frozen(false);
  world.order(steady, "the debrief");
  const CheckResult result = judge(check, plan, chart, world, nullptr);
  JudgedCheck judged;
  judged.passed = result.passed();
  for (const CheckResult::Line& line : result.lines) {
    judged.lines.emplace_back(line.passed, line.text);
  }
  return judged;
}

int report_exercise(const ReportOptions& options) {
  echo::Progress progress;
  const auto reader = recording::RecordingReader::open(options.file, [&](double share) {
    progress.show(fmt::format("searching the file: {:.0f} %", 100.0 * share));
    return true;
  });
  if (!reader) throw std::runtime_error(reader.error().to_string());
  const auto exercise = RecordedExercise::read(*reader);
  if (!exercise) throw std::runtime_error(exercise.error().to_string());
  progress.clear();
  if (const auto& damage = reader->summary().damage) {
    warn(fmt::format("{}; what can be read is used", damage->to_string()));
  }
  if (exercise->server != kServerName) {
    warn(fmt::format("{} made this recording, this is {}: another version may sail otherwise",
                     exercise->server, kServerName));
  }
  const ExercisePlan plan =
      exercise_plan(exercise->scenario_yaml, options.file + ": scenario.yaml");
  const auto chart = charts_of(*exercise, options);
  DebriefOptions asked;
  asked.limits = options.limits;
  if (options.until_min) asked.until_s = 60.0 * *options.until_min;
  if (!options.no_checks) {
    asked.judge = [&](const scenario::ExerciseCheck& check, const World& world) {
      return judged_check(check, plan, *chart, world);
    };
  }
  auto debrief =
      make_debrief(*reader, *exercise, plan, asked, [&](double share, const char* doing) {
        progress.show(fmt::format("{}: {:.0f} %", doing, 100.0 * share));
        return true;
      });
  progress.clear();
  debrief->chart = chart->describe();
  if (debrief->differs) {
    warn(
        fmt::format("the world refused an input of this recording ({}): what follows is not what "
                    "was sailed; use the version that made it",
                    *debrief->differs));
  }
  if (!options.tables.empty()) {
    std::filesystem::create_directories(options.tables);
    for (const auto& [name, text] : csv_files(*debrief)) {
      echo::write_file(std::filesystem::path(options.tables) / name, text);
    }
  }
  if (!options.page.empty()) {
    echo::write_file(options.page,
                     debrief_page(*debrief, coast_about(*chart, chart_extent(*debrief))));
  }
  std::size_t collisions = 0;
  for (const Contact& contact : debrief->contacts) {
    if (contact.kind == Contact::Kind::collision) ++collisions;
  }
  echo::write_out(fmt::format(
      "{}: {:.1f} min, {} own ships, {} pairs within {:g} NM, {} collisions, {} groundings\n",
      debrief->exercise, debrief->end.at_s / 60.0, debrief->own_ships.size(),
      debrief->passings.size(), debrief->limits.near_nm, collisions,
      debrief->contacts.size() - collisions));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_report_command(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command =
      app.add_subcommand("report", "Tells what happened in a recorded exercise, as a page");
  command->add_option("FILE", options->file, "a recording that skerryd made with its inputs")
      ->required();
  command->add_option("-o,--output", options->page, "the page, one HTML file that needs no other");
  command->add_option("--csv", options->tables, "a folder for the same as CSV files");
  command->add_option("--every", options->limits.every_s, "seconds between points of tracks (1)")
      ->check(CLI::Range(0.1, 600.0));
  command->add_option("--near", options->limits.near_nm, "NM; who came no nearer is left out (3)")
      ->check(CLI::Range(0.05, 50.0));
  command->add_option("--cpa", options->limits.cpa_nm, "NM; a forecast CPA below it is close (0.5)")
      ->check(CLI::Range(0.01, 10.0));
  command->add_option("--tcpa", options->limits.tcpa_min, "min; if it is so soon (12)")
      ->check(CLI::Range(0.5, 120.0));
  command->add_option("--until", options->until_min, "look at so many minutes of it")
      ->check(CLI::Range(0.0, 100'000.0));
  command->add_flag("--no-checks", options->no_checks,
                    "do not judge the checks of the exercise's sheet, which makes video");
  command
      ->add_option("--chart", options->charts.charts, "the exercise's charts, where they lie now")
      ->take_all();
  command->add_option("--elevation", options->charts.elevation, "its heights, likewise");
  command->footer(
      "The exercise is sailed again from what it was given, so the report is the truth, not what "
      "a\n"
      "console showed; only the part \"What the set knew\" has targets and alerts as they were "
      "told.\n"
      "The page has tracks on the coast, how near ships came, collisions and groundings, checks,\n"
      "reaction times, plots of each own ship, and a time line with orders and settings.\n"
      "Exit codes: 0 done, 1 it could not be done, 2 the command line cannot be understood.\n"
      "Examples:\n"
      "  skerryd --scenario crossing --record\n"
      "  skerry exercise report crossing.mcap -o report.html\n"
      "  skerry exercise report crossing.mcap -o report.html --cpa 1 --near 6\n"
      "  skerry exercise report crossing.mcap --csv tables --every 10\n");
  return {command, [options] {
            if (options->page.empty() && options->tables.empty()) {
              fmt::print(stderr,
                         "skerry exercise report: nothing to write; expected -o FILE or "
                         "--csv FOLDER\n");
              return echo::kExitUsage;
            }
            return report_exercise(*options);
          }};
}

}  // namespace skerry::server
