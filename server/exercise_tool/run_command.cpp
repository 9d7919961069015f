#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "echo/tool_console/console.hpp"
#include "protocol/picture/picture_file.hpp"
#include "protocol/picture/ppi_picture.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/commands.hpp"
#include "server/exercise_tool/exercise_run.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kApproachesShown = 12;

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);
extern "C" void note_interrupt(int) { interrupted = true; }

struct RunOptions {
  std::string file;
  std::vector<std::string> charts;
  bool fast = false;
  bool checks = false;
  double until_min = 0.0;
  std::string pictures;
  std::optional<std::uint64_t> seed;
};

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{:3}:{:02}", whole / 60, whole % 60);
}

// Prints a run as it happens.
class RunReport {
 public:
  explicit RunReport(const RunOptions& options) : options_(options) {}

  void marked(const wire::ExerciseMark& mark) {
    say(fmt::format("{}  {:<9} {}\n", clock_text(mark.exercise_s()), mark.kind(), mark.text()));
  }

  void judged(const CheckResult& result, const std::vector<CheckedTurn>& turns) {
    say(fmt::format("{}  check     {}{}\n", clock_text(60.0 * result.check->at_min()),
                    result.passed() ? "pass" : "FAIL",
                    result.check->says().empty() ? "" : ": " + result.check->says()));
    for (const CheckResult::Line& line : result.lines) {
      say(fmt::format("                 {} {}\n", line.passed ? "pass" : "FAIL", line.text));
    }
    for (const CheckedTurn& turn : turns) draw(turn, result.check->at_min());
  }

  // Waits for the exercise's time if it is not to run fast.
  bool second(Duration now, Duration length) {
    progress_.show(
        fmt::format("{} of {}", clock_text(in_seconds(now)), clock_text(in_seconds(length))));
    if (options_.fast) return !interrupted;
    const auto due = began_ + std::chrono::duration_cast<std::chrono::steady_clock::duration>(now);
    while (!interrupted && std::chrono::steady_clock::now() < due) {
      std::this_thread::sleep_for(std::min<std::chrono::steady_clock::duration>(
          std::chrono::milliseconds(100), due - std::chrono::steady_clock::now()));
    }
    return !interrupted;
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

  void say(const std::string& text) {
    progress_.clear();
    echo::write_out(text);
  }

 private:
  void draw(const CheckedTurn& turn, double at_min) {
    if (turn.scan.newest() == nullptr) return;
    PpiLabels labels;
    labels.radar = turn.radar;
    const RgbaImage image = draw_ppi(turn.scan, {}, labels);
    const std::string name = fmt::format("{:02}-{:g}min.png", ++pictures_, at_min);
    const auto file = std::filesystem::path(options_.pictures) / name;
    skerry::write_file(file.string(), encode_png(image, describe(turn.scan, turn.radar)));
    say(fmt::format("                 picture {}\n", file.string()));
  }

  const RunOptions& options_;
  echo::Progress progress_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  int pictures_ = 0;
};

void report_approaches(const ExerciseRun& run, RunReport& report) {
  const auto nearest = run.approaches().nearest();
  std::size_t shown = 0;
  for (const Contact& contact : run.world().state().log->contacts) {
    if (contact.kind != Contact::Kind::collision) continue;
    report.say(fmt::format("COLLISION {} and {} at {}\n", contact.own_name, contact.other_name,
                           clock_text(in_seconds(contact.when))));
  }
  for (const ClosestApproach& approach : nearest) {
    if (++shown > kApproachesShown) continue;
    report.say(fmt::format("closest {:7.2f} NM at {}  {} and {}\n", approach.closest_m / 1852.0,
                           clock_text(in_seconds(approach.when)), approach.own_ship,
                           approach.other));
  }
  if (nearest.size() > kApproachesShown) {
    report.say(
        fmt::format("and {} more pairs, farther apart\n", nearest.size() - kApproachesShown));
  }
}

int run_scenario(const RunOptions& options) {
  const ExercisePlan plan = exercise_plan(open_scenario(options.file, options.seed).scenario);
  const auto chart = open_charts(options.charts, "");
  if (!options.pictures.empty()) std::filesystem::create_directories(options.pictures);
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  const bool checks = options.checks || !options.pictures.empty();
  ExerciseRun run(plan, *chart, {options.until_min, checks, !options.pictures.empty()});
  RunReport report(options);
  report.say(fmt::format("{}\n", plan.scenario.name()));
  const bool whole =
      run.run({[&](const wire::ExerciseMark& mark) { report.marked(mark); },
               [&](const CheckResult& result, const std::vector<CheckedTurn>& turns) {
                 report.judged(result, turns);
               },
               [&](Duration now) { return report.second(now, run.length()); }});
  const double took_s = report.seconds();
  const double sailed_s = in_seconds(World::kTick * static_cast<std::int64_t>(run.world().tick()));
  report_approaches(run, report);
  if (!whole) report.say("stopped before its end\n");
  report.say(fmt::format("{} min in {:.1f} s: {:.0f} times real time\n", clock_text(sailed_s),
                         took_s, sailed_s / std::max(took_s, 1e-3)));
  if (checks) {
    report.say(fmt::format(
        "checks: {} of {} passed{}\n", run.judged() - run.failed(), run.judged(),
        run.not_reached() > 0 ? fmt::format(", {} not reached", run.not_reached()) : ""));
  }
  return run.failed() == 0 ? echo::kExitOk : echo::kExitFailure;
}

}  // namespace

echo::Command make_run_command(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Runs a scenario without a network, and judges it");
  command->add_option("FILE", options->file, "a scenario file, or a shipped exercise's name")
      ->required();
  command->add_flag("--fast", options->fast, "as fast as it can, instead of in real time");
  command->add_option("--until", options->until_min, "end after so many minutes")
      ->check(CLI::Range(0.1, 10'000.0));
  command->add_flag("--checks", options->checks, "make video where checks ask for it, and judge");
  command->add_option("--pictures", options->pictures, "a folder for a PNG of each checked turn");
  command->add_option("--seed", options->seed, "instead of the scenario's");
  command->add_option("--chart", options->charts, "charts over the built-in shoreline")->take_all();
  command->footer(
      "Nobody steers: own ships keep their routes and courses.  Exit codes: 0 done, 1 a check\n"
      "failed or it could not be done, 2 the command line cannot be understood.  Ctrl-C ends it.\n"
      "Examples:\n"
      "  skerry scenario run crossing --fast\n"
      "  skerry scenario run crossing --fast --checks --pictures pictures\n"
      "  skerry scenario run mine.yaml --until 5\n");
  return {command, [options] { return run_scenario(*options); }};
}

}  // namespace skerry::server
