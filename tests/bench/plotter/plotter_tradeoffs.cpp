// The plotter's main choices: what they cost against what they are worth, as a table and a picture.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "server/app/options/charts.hpp"
#include "server/page/page_frame.hpp"
#include "server/page/plot_figure.hpp"
#include "tests/bench/plotter/tradeoff_run.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;
using bench::ChoiceOutcome;
using bench::PlotterChoice;
using bench::PlotterScene;

struct Tradeoff {
  PlotterScene scene;
  std::vector<ChoiceOutcome> outcomes;  // of each choice
};

const std::string kDefault = "default";

// Each differs from the default in what its name says.
std::vector<PlotterChoice> all_choices() {
  std::vector<PlotterChoice> choices;
  const auto add = [&](const char* group, const std::string& name, const auto& change) {
    Plotter::Rule rule;
    rule.tracks.most_tracks = 300;
    change(rule);
    choices.push_back({group, name, rule});
  };
  add("", kDefault, [](Plotter::Rule&) {});
  const auto statistic = [&](const char* name, Statistic is) {
    add("threshold", name, [is](Plotter::Rule& rule) { rule.plots.threshold.statistic = is; });
  };
  statistic("CA", Statistic::cell_mean);
  statistic("GO", Statistic::greatest_of);
  statistic("SO", Statistic::smallest_of);
  add("threshold", "OS, 3.75 deviations",
      [](Plotter::Rule& rule) { rule.plots.threshold.roughnesses = 3.75; });
  add("threshold", "OS, 4.75 deviations",
      [](Plotter::Rule& rule) { rule.plots.threshold.roughnesses = 4.75; });
  add("threshold", "OS, no spreads",
      [](Plotter::Rule& rule) { rule.plots.threshold.spreads = 0.0; });
  add("threshold", "OS, 2 spreads",
      [](Plotter::Rule& rule) { rule.plots.threshold.spreads = 2.0; });
  for (const auto& [name, width] :
       {std::pair{"rows of a spoke", 0.01}, {"of half a beam", 0.72}, {"of a beam", 1.44}})
    add("grain", name, [width](Plotter::Rule& rule) { rule.plots.grain.width_deg = width; });
  add("grain", "cells of 45 m", [](Plotter::Rule& rule) { rule.plots.grain.cell_m = 45.0; });
  add("grain", "no splitting", [](Plotter::Rule& rule) { rule.plots.valley = 0.0; });
  add("grain", "no bars", [](Plotter::Rule& rule) { rule.plots.bars = false; });
  // Of what is under way more is asked than hits and bits.
  const auto all = [&](const char* name, const auto& change) {
    add("tracks", name, [&](Plotter::Rule& rule) {
      rule.tracks.acquire = Tracker::Acquire::all;
      change(rule.tracks);
    });
  };
  all("all", [](Tracker::Rule&) {});
  all("all, 3 hits", [](Tracker::Rule& rule) { rule.least_hits = 3; });
  all("all, 6 hits", [](Tracker::Rule& rule) { rule.least_hits = 6; });
  all("all, 10 hits", [](Tracker::Rule& rule) { rule.least_hits = 10; });
  all("all, 10 bits", [](Tracker::Rule& rule) { rule.sure_bits = 10.0; });
  all("all, 24 bits", [](Tracker::Rule& rule) { rule.sure_bits = 24.0; });
  return choices;
}

PlotterScene scene_named(const std::string& name) {
  for (const PlotterScene& scene : bench::plotter_scenes())
    if (scene.name == name) return scene;
  throw std::invalid_argument("there is no scene \"" + name + "\"");
}

PlotterScene rougher(PlotterScene scene, int state) {
  const std::string calm = "state: 2";
  const auto at = scene.yaml.find(calm);
  if (at == std::string::npos) throw std::invalid_argument(scene.name + " is not calm");
  scene.yaml.replace(at, calm.size(), fmt::format("state: {}", state));
  scene.name += fmt::format(", sea state {}", state);
  return scene;
}

void print(const Tradeoff& tradeoff, const std::vector<PlotterChoice>& choices) {
  fmt::print("\n{}\n{:10}{:22}{:>8}{:>8}{:>8}{:>9}{:>11}{:>9}{:>8}{:>8}{:>9}{:>7}\n",
             tradeoff.scene.name, "", "choice", "ns/cell", "floors", "plots", "targets",
             "us/target", "GOSPA m", "missed", "false", "false/h", "swaps");
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const ChoiceOutcome& one = tradeoff.outcomes[i];
    fmt::print("{:10}{:22}{:8.2f}{:8.2f}{:8.0f}{:9.0f}{:11.2f}{:9.0f}{:8.2f}{:8.2f}{:9.0f}{:7}\n",
               choices[i].group, choices[i].name, one.ns_per_cell, one.floors, one.plots,
               one.followed, one.us_per_target, one.score.mean_gospa_m, one.score.mean_missed,
               one.score.mean_made_up, one.score.false_per_hour.value_or(0.0), one.score.swaps);
  }
  std::fflush(stdout);
}

struct Panel {
  const char* group;
  const char* title;
};
// What is asked of a track costs nothing, so it has none.
constexpr Panel kPanels[] = {{"threshold", "GOSPA by threshold"},
                             {"grain", "GOSPA by rows, cells and blobs"}};

// A cross where a choice stands, in colours of their own.
std::string panel(const Tradeoff& tradeoff, const std::vector<PlotterChoice>& choices,
                  const Panel& is) {
  constexpr double kHeight_px = 210.0, kWidth_px = 788.0;  // of the plot inside
  std::vector<PlotCurve> curves;
  double most = 0.0, highest = 0.0;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].name != kDefault && choices[i].group != is.group) continue;
    most = std::max(most, 1.1 * tradeoff.outcomes[i].floors);
    highest = std::max(highest, 1.1 * tradeoff.outcomes[i].score.mean_gospa_m);
  }
  const double dx = 6.0 * most / kWidth_px, dy = 6.0 * highest / (kHeight_px - 42.0);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].name != kDefault && choices[i].group != is.group) continue;
    const double x = tradeoff.outcomes[i].floors, y = tradeoff.outcomes[i].score.mean_gospa_m;
    curves.push_back({choices[i].name,
                      static_cast<int>(curves.size()),
                      {{x - dx, y, true}, {x + dx, y}, {x, y - dy, true}, {x, y + dy}}});
  }
  PlotFrame frame;
  frame.title = tradeoff.scene.name + ": " + is.title;
  frame.unit = "m";
  frame.along = "floors";
  frame.end_s = most;
  frame.height_px = kHeight_px;
  frame.least = 0.0;
  frame.most = highest;
  return plot_figure(frame, curves, {});
}

// The plots one below the other, in a file that needs no other.
std::string picture(const std::vector<Tradeoff>& tradeoffs,
                    const std::vector<PlotterChoice>& choices) {
  std::string inside;
  double y = 0.0;
  for (const Tradeoff& tradeoff : tradeoffs) {
    for (const Panel& each : kPanels) {
      std::string plot = panel(tradeoff, choices, each);
      plot = plot.substr(plot.find('>') + 1);  // what is within its <svg>
      inside += fmt::format("<g transform=\"translate(0 {:.0f})\">{}</g>\n", y,
                            plot.substr(0, plot.rfind("</svg>")));
      y += 225.0;
    }
  }
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 {0:.0f}\"><style>{1}</style>\n"
      "<rect width=\"1000\" height=\"{0:.0f}\" style=\"fill:var(--page)\"/>\n{2}</svg>\n",
      y, kPageStyle, inside);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What the plotter's main choices cost against what they are worth."};
  double minutes = 10.0;
  std::string svg, only;
  app.add_option("--minutes", minutes, "Of each scene")->check(CLI::Range(2.0, 60.0));
  app.add_option("--scene", only, "Only those whose name holds this");
  app.add_option("--svg", svg, "Also writes the picture there");
  CLI11_PARSE(app, argc, argv);
  const auto chart = open_charts({}, "");
  const auto choices = all_choices();
  std::vector<Tradeoff> tradeoffs;
  for (const PlotterScene& scene : {rougher(scene_named("20 targets"), 3),
                                    scene_named("rain 16 mm/h"), scene_named("behind headlands")}) {
    if (scene.name.find(only) == std::string::npos) continue;
    tradeoffs.push_back({scene, bench::try_choices(scene, minutes, choices, *chart)});
    print(tradeoffs.back(), choices);
  }
  if (svg.empty()) return 0;
  std::ofstream file(svg);
  file << picture(tradeoffs, choices);
  if (!file.flush()) throw std::runtime_error(svg + ": cannot be written");
}
