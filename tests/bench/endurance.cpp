// endurance: many cells of every scene, looked at one by one.
//
//   endurance                     10^9 cells of each scene (some minutes)
//   endurance --cells 1e7         fewer
//
// Rows of power hold nothing but zero and normal numbers in (0, 1e30): no NaN, no infinity, nothing
// negative, and no denormals, which would slow the loops down tenfold.  Ends with 1 if any is
// found.
#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "tests/scenes/artefact_scenes.hpp"
#include "tests/scenes/full_scene.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::bench {
namespace {

struct Found {
  std::uint64_t cells = 0, bad = 0, denormal = 0;
  float most = 0.0f;
};

void look_at(std::span<const float> row, Found& found) {
  std::uint64_t bad = 0, denormal = 0;
  float most = found.most;
  for (const float value : row) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    // Everything from 1e30 on, infinities, NaNs and, by their sign bit, negative numbers.
    bad += bits >= std::bit_cast<std::uint32_t>(1e30f) ? 1 : 0;
    denormal += bits != 0 && bits < 0x00800000u ? 1 : 0;
    most = value > most ? value : most;
  }
  found.cells += row.size();
  found.bad += bad;
  found.denormal += denormal;
  found.most = most;
}

// Sails for `horizon` seconds, then begins again: a coast picture serves no longer.
Found sail(const scenes::NamedScene& named, double cells) {
  constexpr std::uint32_t kSector = 16;
  constexpr double kHorizon = 20.0;
  const echo::SpokeClock clock(named.rpm, named.geometry.spokes_per_turn);
  echo::SpokeReturns returns(
      echo::radar_model(named.set, named.geometry, named.controls.range_scale, clock, 0),
      echo::serial_for);
  Found found;
  std::uint64_t spoke = 0;
  while (static_cast<double>(found.cells) < cells) {
    scenes::MovingScene scenes(named.scene);
    const ScenarioTime begun = clock.time_of(spoke);
    while (static_cast<double>(found.cells) < cells &&
           in_seconds(clock.time_of(spoke) - begun) < kHorizon) {
      const ScenarioTime since = named.scene->time + (clock.time_of(spoke) - begun);
      auto scene = std::make_shared<echo::Scene>(*scenes.at(since));
      scene->time = scene->time + (begun - named.scene->time);
      const echo::PowerRows rows = returns.make(*scene, spoke, kSector);
      for (std::uint32_t k = 0; k < kSector; ++k)
        look_at(rows.cells.subspan(k * rows.pitch, named.geometry.cells), found);
      spoke += kSector;
    }
  }
  return found;
}

int run(double cells) {
  std::vector<scenes::NamedScene> all = scenes::made_up_scenes();
  for (scenes::ArtefactScene artefact : scenes::artefact_scenes()) {
    artefact.with.name = artefact.name;
    all.push_back(std::move(artefact.with));
  }
  if (auto bergen = scenes::bergen()) all.push_back(std::move(*bergen));
  if (auto full = scenes::full_scene()) all.push_back(std::move(*full));
  std::uint64_t wrong = 0;
  for (const scenes::NamedScene& named : all) {
    const Found found = sail(named, cells);
    fmt::print("{:<28} {:.2e} cells, {} not a power, {} denormal, greatest {:.3g}\n", named.name,
               static_cast<double>(found.cells), found.bad, found.denormal, found.most);
    wrong += found.bad + found.denormal;
  }
  return wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace skerry::bench

int main(int argc, char** argv) {
  double cells = 1e9;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--cells" && i + 1 < argc) {
      cells = std::atof(argv[++i]);
    } else {
      fmt::print(stderr, "endurance: unknown argument '{}'; usage: endurance [--cells N]\n", word);
      return 2;
    }
  }
  return skerry::bench::run(cells);
}
