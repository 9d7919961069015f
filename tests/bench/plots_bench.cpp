// plots_bench: what plots out of video cost, ns/cell of the radar and in floors
// (bench_support.hpp).
//
// Turns of 2048 spokes of 1024 cells, made before: open sea of state 4 with 20 ships, noise as the
// receiver has it; and, where a chart is installed, the full scene with its land and rain.  By the
// threshold's statistic, and with video that is all noise.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/plotter/plots/plot_extractor.hpp"
#include "tests/bench/bench_support.hpp"
#include "tests/scenes/full_scene.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/scenes/without.hpp"

namespace skerry::bench {
namespace {

using server::Plot;
using server::PlotExtractor;
using server::Statistic;

constexpr std::uint32_t kTurns = 6;

// Some turns again and again, with the places and turns of a radar that goes on.
std::vector<Spoke> spokes_of(const scenes::NamedScene& named) {
  constexpr std::uint32_t kSector = 16;
  const echo::SpokeClock clock(named.rpm, named.geometry.spokes_per_turn);
  echo::SpokeRenderer renderer(named.set, named.geometry, clock, 0);
  renderer.set_controls(named.controls);
  scenes::MovingScene moving(named.scene);
  const std::size_t sector_cells = std::size_t{kSector} * named.geometry.cells;
  std::vector<std::uint8_t> video(std::size_t{kTurns} * named.geometry.spokes_per_turn *
                                  named.geometry.cells);
  for (std::uint64_t k = 0; k < std::uint64_t{kTurns} * named.geometry.spokes_per_turn;
       k += kSector)
    renderer.render(*moving.at(clock.time_of(k)), k, kSector,
                    std::span(video).subspan(k * named.geometry.cells, sector_cells));
  std::vector<Spoke> spokes(std::size_t{kTurns} * named.geometry.spokes_per_turn);
  for (std::size_t n = 0; n < spokes.size(); ++n) {
    SpokeHeader& header = spokes[n].header;
    header.geometry = named.geometry;
    header.range_scale = named.controls.range_scale;
    header.scan = static_cast<std::uint32_t>(n / named.geometry.spokes_per_turn);
    header.index = static_cast<std::uint32_t>(n % named.geometry.spokes_per_turn);
    header.own_ship = scenes::kBergen;
    const auto first = video.begin() + static_cast<std::ptrdiff_t>(n * named.geometry.cells);
    spokes[n].cells.assign(first, first + named.geometry.cells);
  }
  return spokes;
}

scenes::NamedScene sea_and_ships() {
  scenes::NamedScene named;
  for (const scenes::NamedScene& each : scenes::made_up_scenes())
    if (each.name == "open sea") named = each;
  named.geometry = {2048, 1024, 8};
  named.controls.range_scale = *RangeScale::find(6.0);
  named = scenes::with(named, [&](echo::Scene& scene) {
    const double reach = named.controls.range_scale.length().in_metres();
    scene.hulls = scenes::a_dozen_ships(reach);
    for (const echo::Hull& hull : scenes::a_dozen_ships(0.6 * reach))
      if (scene.hulls.size() < 20) scene.hulls.push_back(hull);
    for (std::size_t i = 0; i < scene.hulls.size(); ++i) scene.hulls[i].identity = i;
    scene.sea.state = 4.0;
    scene.wave_height_m = 1.9;
  });
  return named;
}

void add(const std::string& name, std::vector<Spoke> made, const PlotExtractor::Rule& rule = {}) {
  const auto spokes = std::make_shared<std::vector<Spoke>>(std::move(made));
  register_per_isa(
      "plots/" + name,
      [spokes, rule](benchmark::State& state) {
        PlotExtractor extractor(rule);
        std::vector<Plot> plots;
        std::uint64_t turns = 0, told = 0;
        const std::size_t cells = spokes->front().cells.size() * spokes->size();
        // The map learns before time counts.
        const auto turn_all = [&] {
          for (Spoke& spoke : *spokes) {
            plots.clear();
            extractor.add(spoke, plots);
            told += plots.size();
            spoke.header.scan += kTurns;
          }
          turns += kTurns;
        };
        for (int i = 0; i < 5; ++i) turn_all();
        turns = told = 0;
        const PlotExtractor::Counts before = extractor.counts();
        Meter meter(state, static_cast<double>(cells));
        for (auto _ : state) turn_all();
        meter.stop();
        const PlotExtractor::Counts after = extractor.counts();
        const auto a_turn = [&](std::uint64_t from, std::uint64_t to) {
          return std::to_string((to - from) / turns);
        };
        state.SetLabel("a turn: " + a_turn(before.runs, after.runs) + " runs, " +
                       a_turn(before.blobs, after.blobs) + " blobs, " +
                       a_turn(before.in_clutter, after.in_clutter) + " below a bar, " +
                       a_turn(0, told) + " plots");
      },
      benchmark::kMillisecond);
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  using namespace skerry;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const scenes::NamedScene sea = bench::sea_and_ships();
  const auto spokes = bench::spokes_of(sea);
  bench::add("noise alone",
             bench::spokes_of(scenes::with(scenes::with(sea, scenes::no_sea), scenes::no_targets)));
  bench::add("noise and 20 ships", bench::spokes_of(scenes::with(sea, scenes::no_sea)));
  bench::add("sea and 20 ships", spokes);
  server::PlotExtractor::Rule mean;
  mean.threshold.statistic = server::Statistic::cell_mean;
  bench::add("by the mean of cells", spokes, mean);
  if (auto full = scenes::full_scene({20, 50})) {
    full->geometry = {2048, 1024, 8};
    bench::add("full scene", bench::spokes_of(*full));
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
