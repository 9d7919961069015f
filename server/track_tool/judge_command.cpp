#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "echo/tool_console/console.hpp"
#include "protocol/quantity/length.hpp"
#include "server/plotter/judge/judging.hpp"
#include "server/plotter/judge/score_page.hpp"
#include "server/plotter/judge/score_text.hpp"
#include "server/track_tool/commands.hpp"

namespace skerry::server {
namespace {

struct JudgeOptions {
  JudgeRequest request;
  double within_nm = 0.0;
  std::string tables, page;
};

// What is wrong with the outputs, before anything is read.
std::string misuse(const JudgeOptions& options) {
  if (options.page.empty()) return "";
  if (!options.page.ends_with(".html")) {
    return fmt::format("--page {}: expected a file that ends in .html", options.page);
  }
  std::vector<std::string> inputs = options.request.told;
  inputs.push_back(options.request.truth);
  inputs.push_back(options.request.scans);
  for (const std::string& input : inputs) {
    std::error_code ignored;
    if (input == options.page || std::filesystem::equivalent(input, options.page, ignored)) {
      return fmt::format("{} would be written over", input);
    }
  }
  return "";
}

int judge_files(const JudgeOptions& options) {
  JudgeRequest request = options.request;
  if (options.within_nm > 0.0)
    request.rule.within_m = nautical_miles(options.within_nm).in_metres();
  const Judged judged = judge_trackers(request);
  for (const std::string& note : judged.notes) fmt::print(stderr, "{}\n", note);
  if (!options.tables.empty()) {
    std::filesystem::create_directories(options.tables);
    for (const auto& [name, text] : score_csv_files(judged.scores))
      echo::write_file(std::filesystem::path(options.tables) / name, text);
  }
  if (!options.page.empty()) {
    const ScorePage page{"Trackers against the truth", judged.notes};
    echo::write_file(options.page, score_page(page, judged.truth, judged.told, judged.scores));
  }
  echo::write_out(score_table(judged.scores));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_judge_command(CLI::App& app) {
  auto options = std::make_shared<JudgeOptions>();
  JudgeRequest& request = options->request;
  JudgeRule& rule = request.rule;
  CLI::App* command =
      app.add_subcommand("judge", "Compares tracks, of any tracker, with the truth");
  command->add_option("--truth", request.truth,
                      "where targets were: CSV with utc_s,id,lat_deg,lon_deg and, if known, "
                      "course_deg,speed_kn; the id `own` is own ship");
  command
      ->add_option("--told", request.told,
                   "what a tracker told: CSV of `skerry track -o`, or a log with TTM, TLL or TTD")
      ->expected(1)
      ->take_all();
  command->add_option("--scans", request.scans,
                      "plots of each turn, with truth, as JSON lines: for --baseline, and instead "
                      "of --truth");
  command
      ->add_option(
          "--baseline", request.baselines,
          "trackers run on the scans: skerry, and after the rules of others radar_pi, mayara")
      ->delimiter(',')
      ->check(CLI::IsMember({"skerry", "radar_pi", "mayara"}));
  command
      ->add_option("--cut-m", rule.cut_m,
                   "m; farther from its target no track is right, and what a missed or a made-up "
                   "target costs (200)")
      ->check(CLI::Range(0.1, 1e6));
  command->add_option("--order", rule.order, "of OSPA and GOSPA: 1, or 2, which heeds outliers (2)")
      ->check(CLI::Range(1.0, 16.0));
  command
      ->add_option("--step-s", rule.step_s,
                   "s between the times that are compared; 0: whenever something was told (2.5)")
      ->check(CLI::Range(0.0, 3600.0));
  command
      ->add_option("--hold-s", rule.hold_s,
                   "s that a track counts as shown after it was told last (7.5)")
      ->check(CLI::Range(0.0, 3600.0));
  command
      ->add_option("--steady-s", rule.steady_s,
                   "s before and after for which both ships keep on where CPA is judged (30)")
      ->check(CLI::Range(0.0, 3600.0));
  command
      ->add_option("--within-nm", options->within_nm,
                   "NM from own ship; who is farther counts not (all)")
      ->check(CLI::Range(0.01, 200.0));
  command->add_option("--csv", options->tables,
                      "a folder for scenes.csv, targets.csv, tracks.csv, steps.csv and errors.csv");
  command->add_option("--page", options->page, "a page with figures, one HTML file");
  command->footer(
      "Tracks are paired with targets at the least sum of distances, and a pair lasts until "
      "another\n"
      "is clearly better.  Tentative tracks are not judged.  Errors of course, speed, CPA and "
      "TCPA\n"
      "are 95 % of their amounts.  What is left out of a file is counted on stderr.\n"
      "Exit codes: 0 done, 1 it could not be done, 2 the command line cannot be understood.\n"
      "Examples:\n"
      "  skerry track judge --truth truth.csv --told tracks.csv\n"
      "  skerry track judge --truth truth.csv --told tracks.csv --told other-maker.nmea --page "
      "r.html\n"
      "  skerry track judge --scans harbour.jsonl --baseline skerry,radar_pi,mayara --cut-m 50\n"
      "  skerry track judge --truth truth.csv --told tracks.csv --within-nm 6 --csv tables\n");
  return {command, [options] {
            const JudgeRequest& asked = options->request;
            const bool has_truth = !asked.truth.empty() || !asked.scans.empty();
            const bool has_told = !asked.told.empty() || !asked.baselines.empty();
            const bool has_scans = asked.baselines.empty() || !asked.scans.empty();
            if (!has_truth || !has_told || !has_scans) {
              fmt::print(stderr, "skerry track judge: {}\n",
                         !has_truth  ? "no truth; expected --truth FILE or --scans FILE"
                         : !has_told ? "nothing to judge; expected --told FILE or --baseline NAME"
                                     : "--baseline needs plots; expected --scans FILE");
              return echo::kExitUsage;
            }
            if (const std::string why = misuse(*options); !why.empty()) {
              fmt::print(stderr, "skerry track judge: {}\n", why);
              return echo::kExitUsage;
            }
            return judge_files(*options);
          }};
}

}  // namespace skerry::server
