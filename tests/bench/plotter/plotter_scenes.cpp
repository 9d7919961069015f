// Scenes on the rendered video of a radar, and what the plotter makes of them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <set>

#include "protocol/quantity/speed.hpp"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/exercise_tool/radar_turns.hpp"
#include "server/plotter/assignment/assignment.hpp"
#include "server/plotter/judge/set_distance.hpp"
#include "server/plotter/plotter.hpp"
#include "server/plotter/tracks/ground_plane.hpp"
#include "tests/bench/plotter/scenes.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

struct Score {
  double gospa = 0.0, missed = 0.0, made_up = 0.0, truth = 0.0;
  int turns = 0, swaps = 0;
  double off2 = 0.0, far_m = 0.0, right_m = 0.0;  // of the tracks from the truth
  int pairs = 0;
  double plots = 0.0, extended = 0.0, seconds = 0.0, followed = 0.0;
  std::set<std::uint32_t> false_numbers, numbers;
};

// Of a track that is nobody's.
struct Life {
  PlottedTrack first, last;
  double beside_first_m = 0.0, beside_last_m = 0.0;  // the nearest ship
  int from = 0, turns = 0;
  void take(const PlottedTrack& track, double beside_m, int turn) {
    if (turns++ == 0) {
      first = track;
      beside_first_m = beside_m;
      from = turn;
    }
    last = track;
    beside_last_m = beside_m;
  }
  void print(std::uint32_t number) const {
    const auto at = [](const PlottedTrack& track, double beside_m) {
      return fmt::format("{:.1f} deg {:.0f} m (the nearest ship {:.0f} m off)",
                         track.bearing.in_degrees(), track.range_m, beside_m);
    };
    fmt::print("  false {}: {} turns from turn {}; {}, then {}; {:.1f} kn\n", number, turns, from,
               at(first, beside_first_m), at(last, beside_last_m),
               length_of(last.velocity_mps) / kKnot);
  }
};

constexpr double kCut_m = 200.0;
// Of targets nearer to each other than this nobody can tell which is which: they are one echo, or
// were one when they were measured.  Whose track is whose counts again when they have parted.
constexpr double kApart_m = 150.0;

bool stands_alone(const std::vector<PlanePoint>& truth, std::size_t which) {
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (i != which && length_of(truth[i] - truth[which]) < kApart_m) return false;
  return true;
}

void take(Score& score, const GroundPlane& plane, const World& world, const Plotter& plotter,
          double reach_m, std::map<std::uint32_t, std::size_t>& whose,
          std::set<std::uint32_t>& ever_right) {
  const auto state = world.state();
  const PlanePoint own = plane.to_plane(state.own_ships.front().position);
  std::vector<PlanePoint> truth, told;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    const PlanePoint at = plane.to_plane(state.targets[i].position);
    if (length_of(at - own) > reach_m || length_of(at - own) < 200.0) continue;
    truth.push_back(at);
    of.push_back(i);
  }
  const auto tracks = plotter.tracks();
  for (const PlottedTrack& track : tracks) told.push_back(plane.to_plane(track.place));
  const Gospa g = gospa(truth, told, kCut_m, 1.0);
  score.gospa += g.m;
  score.missed += static_cast<double>(g.missed);
  score.made_up += static_cast<double>(g.made_up);
  score.truth += static_cast<double>(truth.size());
  ++score.turns;
  std::vector<double> costs;
  for (const PlanePoint& a : told)
    for (const PlanePoint& b : truth) costs.push_back(length_of(a - b));
  const auto pairs = cheapest_pairs(costs, told.size(), truth.size(), kCut_m);
  for (std::size_t i = 0; i < told.size(); ++i) {
    score.numbers.insert(tracks[i].number);
    if (pairs[i] == kUnpaired) continue;
    ever_right.insert(tracks[i].number);
    const double off = costs[i * truth.size() + pairs[i]];
    score.off2 += off * off;
    ++score.pairs;
    const PlanePoint along = (truth[pairs[i]] - own) * (1.0 / length_of(truth[pairs[i]] - own));
    score.far_m += dot(told[i] - truth[pairs[i]], along);
    score.right_m -= cross(along, told[i] - truth[pairs[i]]);
    if (!stands_alone(truth, pairs[i])) continue;
    const auto known = whose.find(tracks[i].number);
    if (known != whose.end() && known->second != of[pairs[i]]) ++score.swaps;
    whose[tracks[i].number] = of[pairs[i]];
  }
}

Score run(const bench::PlotterScene& scene, const echo::ChartSource& chart, bool verbose) {
  const ExercisePlan plan = exercise_plan(scene.yaml, scene.name);
  World world(plan.scenario);
  RadarTurns turns(plan, 0, std::nullopt, chart, world);
  Plotter::Rule rule;
  rule.tracks.most_tracks = 300;
  rule.tracks.acquire = scene.all ? Tracker::Acquire::all : Tracker::Acquire::moving;
  Plotter plotter(rule);
  Score score;
  std::map<std::uint32_t, std::size_t> whose;
  std::set<std::uint32_t> ever_right;
  std::map<std::uint32_t, Life> seen;
  const GroundPlane plane(world.state().own_ships.front().position);
  const double reach_m = turns.config().controls.range_scale.length().in_metres();
  while (in_seconds(turns.world().state().exercise) < 60.0 * scene.minutes) {
    const Scan scan = turns.turn();
    const auto before = std::chrono::steady_clock::now();
    for (const auto& spoke : scan.spokes) {
      if (!spoke) continue;
      plotter.add(*spoke);
      for (const Plot& plot : plotter.new_plots()) ++(plot.extended ? score.extended : score.plots);
    }
    score.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    score.followed += static_cast<double>(plotter.tracker().counts().followed);
    if (in_seconds(turns.world().state().exercise) < 60.0) continue;
    take(score, plane, turns.world(), plotter, reach_m, whose, ever_right);
    if (!verbose) continue;
    for (const PlottedTrack& track : plotter.tracks()) {
      if (ever_right.contains(track.number)) continue;
      double beside_m = 1e9;
      for (const auto& ship : turns.world().state().targets)
        beside_m = std::min(beside_m,
                            length_of(plane.to_plane(ship.position) - plane.to_plane(track.place)));
      seen[track.number].take(track, beside_m, score.turns);
    }
  }
  for (const auto& [number, life] : seen) {
    if (!ever_right.contains(number)) life.print(number);
  }
  for (const std::uint32_t number : score.numbers) {
    if (!ever_right.contains(number)) score.false_numbers.insert(number);
  }
  return score;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Scenes on rendered video, and what the plotter makes of them."};
  std::string only;
  bool verbose = false;
  app.add_option("--scene", only, "only those whose name holds this");
  app.add_flag("--verbose", verbose, "also tells each false track");
  CLI11_PARSE(app, argc, argv);
  const auto chart = open_charts({}, "");
  std::printf(
      "scene                    targets  GOSPA m  missed  false   tracks  false    swaps  RMS m  "
      "plots  land  "
      "ms/turn followed\n                                   a turn  a turn  a turn           an "
      "hour\n");
  for (const auto& scene : bench::plotter_scenes()) {
    if (scene.name.find(only) == std::string::npos) continue;
    const Score s = run(scene, *chart, verbose);
    const double n = s.turns;
    const double hours = (scene.minutes - 1.0) / 60.0;
    std::printf(
        "%-24s %6.1f %8.0f %8.2f %7.2f %7zu %7.1f %6d %7.1f %6.1f %6.1f %7.1f %6.1f %6.2f %5.0f\n",
        scene.name.c_str(), s.truth / n, s.gospa / n, s.missed / n, s.made_up / n, s.numbers.size(),
        static_cast<double>(s.false_numbers.size()) / hours, s.swaps,
        std::sqrt(s.off2 / std::max(s.pairs, 1)), s.far_m / std::max(s.pairs, 1),
        s.right_m / std::max(s.pairs, 1), s.plots / n, s.extended / n, 1e3 * s.seconds / n,
        s.followed / n);
    std::fflush(stdout);
  }
}
