// Whose memory a radar is made of, and how much of it a sector touches.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "echo/receiver/view_receiver.hpp"
#include "echo/spoke_renderer.hpp"
#include "tests/bench/heap_count.hpp"
#include "tests/bench/radar_bench_parts.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/scenes/without.hpp"

namespace skerry::bench {
namespace {

// KiB of pages that were touched since forget_touched(); 0 where the system does not tell.
std::size_t touched_kib() {
  std::ifstream file("/proc/self/smaps_rollup");
  std::string word;
  std::size_t kib = 0;
  while (file >> word)
    if (word == "Referenced:" && file >> kib) return kib;
  return 0;
}
void forget_touched() { std::ofstream("/proc/self/clear_refs") << "1"; }

struct Weight {
  double shared_kib = 0.0;   // tables and scratch that the first radar makes for all
  double own_kib = 0.0;      // of each radar
  double touched_kib = 0.0;  // pages of those that a sector touches, the median
};

Weight weigh(const scenes::NamedScene& named) {
  const echo::SpokeClock clock(named.rpm, named.geometry.spokes_per_turn);
  std::vector<std::uint8_t> video(std::size_t{kSectorSpokes} * named.geometry.cells);
  scenes::MovingScene scenes(named.scene);
  const std::uint64_t end = named.geometry.spokes_per_turn * 5ull / 4;
  std::vector<echo::ScenePtr> sector_scenes;
  for (std::uint64_t spoke = 0; spoke < end + 64 * kSectorSpokes; spoke += kSectorSpokes)
    sector_scenes.push_back(scenes.at(clock.time_of(spoke)));
  std::vector<std::unique_ptr<echo::SpokeRenderer>> radars;
  const auto make = [&](std::size_t radar, std::uint64_t spoke) {
    radars[radar]->render(*sector_scenes[spoke / kSectorSpokes], spoke, kSectorSpokes, video);
  };
  std::vector<double> kib;
  for (std::uint32_t radar = 0; radar < 3; ++radar) {
    const std::size_t before = heap_bytes();
    radars.push_back(
        std::make_unique<echo::SpokeRenderer>(named.set, named.geometry, clock, radar));
    radars.back()->set_controls(named.controls);
    for (std::uint64_t spoke = 0; spoke < end; spoke += kSectorSpokes) make(radar, spoke);
    kib.push_back(static_cast<double>(heap_bytes() - before) / 1024.0);
  }
  // A sector of two radars, less a sector of one: what is shared is in both.
  std::vector<double> touched;
  for (std::uint64_t spoke = end; spoke < end + 64 * kSectorSpokes; spoke += kSectorSpokes) {
    make(2, spoke);
    forget_touched();
    make(0, spoke);
    const auto one = static_cast<double>(touched_kib());
    make(1, spoke);
    touched.push_back(static_cast<double>(touched_kib()) - one);
  }
  return {kib[0] - kib[1], kib[1], median_of(touched)};
}

void print_row(const std::string& name, const Weight& w) {
  fmt::print("{:<36}{:>14.0f}{:>12.0f}{:>16.0f}\n", name, w.shared_kib, w.own_kib, w.touched_kib);
}
Weight less(const Weight& a, const Weight& b) {
  return {a.shared_kib - b.shared_kib, a.own_kib - b.own_kib, a.touched_kib - b.touched_kib};
}

}  // namespace

void working_set(const scenes::NamedScene& full) {
  fmt::print(
      "\nMemory of a radar of the full scene, KiB, by what the scene without a part saves\n"
      "{:<36}{:>14}{:>12}{:>16}\n",
      "", "shared", "its own", "of it a sector");
  const Weight all = weigh(full);
  print_row("all", all);
  print_row("land", less(all, weigh(scenes::with(full, scenes::no_land))));
  print_row("sea", less(all, weigh(scenes::with(full, scenes::no_sea))));
  print_row("rain", less(all, weigh(scenes::with(full, scenes::no_rain))));
  print_row("ships and buoys", less(all, weigh(scenes::with(full, scenes::no_targets))));
  scenes::NamedScene plain = full;
  plain.controls = {};
  plain.controls.range_scale = full.controls.range_scale;
  print_row("memories of the receiver", less(all, weigh(plain)));
}

}  // namespace skerry::bench
