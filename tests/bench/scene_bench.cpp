// Whole spokes: everything from the Scene to 8 bits, one turn an iteration.
#include "tests/bench/bench_support.hpp"

namespace skerry::bench {
namespace {

constexpr std::uint32_t kSector = 16;

// Between sectors as many rows go through the floor, so that what else the machine does weighs on
// both alike.
void bench_scene_turn(benchmark::State& state, const scenes::NamedScene& named) {
  const ScanGeometry& geometry = named.geometry;
  const std::uint32_t spokes = geometry.spokes_per_turn;
  echo::SpokeRenderer renderer(named.set, geometry, {named.rpm, spokes}, 0);
  renderer.set_controls(named.controls);
  std::vector<std::uint8_t> video(std::size_t{kSector} * geometry.cells);
  Floor floor(geometry.cells);
  double scene_seconds = 0.0, floor_seconds = 0.0;
  for (auto _ : state) {
    double turn_seconds = 0.0;
    // Always the same turn: a Scene is good for a few seconds only.
    for (std::uint32_t first = 0; first < spokes; first += kSector) {
      const double begun = thread_seconds();
      renderer.render(*named.scene, first, kSector, video);
      benchmark::DoNotOptimize(video.data());
      const double made = thread_seconds();
      for (std::uint32_t k = 0; k < kSector; ++k) floor.run();
      turn_seconds += made - begun;
      floor_seconds += thread_seconds() - made;
    }
    state.SetIterationTime(turn_seconds);
    scene_seconds += turn_seconds;
  }
  const double turns = static_cast<double>(state.iterations());
  const double cells = turns * spokes * static_cast<double>(geometry.cells);
  report_cells(state, scene_seconds, cells, floor_seconds, cells);
  state.SetLabel(std::to_string(static_cast<int>(turns * spokes / scene_seconds)) + " spokes/s");
}

}  // namespace

void register_scenes() {
  for (const scenes::NamedScene& named : bench_scenes()) {
    const ScanGeometry& g = named.geometry;
    register_per_isa(
        "spokes/" + named.name + " " + std::to_string(g.spokes_per_turn) + "x" +
            std::to_string(g.cells),
        [&named](benchmark::State& state) { bench_scene_turn(state, named); },
        benchmark::kMillisecond, true);
  }
}

}  // namespace skerry::bench
