#include "tests/bench/error/texture_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "echo/clutter/sea_returns.hpp"
#include "tests/bench/error/study.hpp"

namespace skerry::bench {
namespace {

constexpr std::uint32_t kSector = 16, kSeaSpokes = 1024;

echo::RadarModel radar() {
  const echo::RadarSet set;
  ScanGeometry geometry;
  return echo::radar_model(set, geometry, *RangeScale::find(3.0),
                           echo::SpokeClock(set.rpm, geometry.spokes_per_turn), 0);
}

void print_for(const echo::Scene& scene, std::FILE* out) {
  const echo::RadarModel model = radar();
  const auto aim = [&](std::uint64_t s) { return echo::aim_of(scene, model.clock, s); };
  const std::uint32_t in_use = echo::SeaReturns(model).texture_spokes();
  for (const std::uint32_t spokes : {1u, 2u, 4u, 8u, 16u}) {
    echo::SeaReturns sea(model, spokes), reference(model, 1);
    const auto lay = [&](std::uint64_t s) {
      sea.prepare(scene, aim(s), aim(s + kSector - 1));
      reference.prepare(scene, aim(s), aim(s + kSector - 1));
    };
    lay(0);
    std::vector<float> power(model.geometry.cells, 0.0f);
    const double seconds = median_seconds(15, [&] {
      for (std::uint64_t s = 0; s < kSeaSpokes; s += kSector) {
        sea.prepare(scene, aim(s), aim(s + kSector - 1));
        for (std::uint64_t k = s; k < s + kSector; ++k) sea.add(aim(k), power);
      }
    });
    std::vector<double> errors;
    std::vector<float> row(model.geometry.cells);
    std::vector<double> exact(model.geometry.cells);
    for (std::uint64_t s = 0; s < kSeaSpokes; s += kSector) {
      lay(s);
      for (std::uint64_t k = s; k < s + kSector; ++k) {
        sea.local_mean(aim(k), row);
        reference.local_mean_reference(scene, aim(k), exact);
        for (std::size_t i = 0; i < sea.reach_cells(); ++i) {
          errors.push_back(10.0 * std::fabs(std::log10((1.0 + row[i]) / (1.0 + exact[i]))));
        }
      }
    }
    std::sort(errors.begin(), errors.end());
    std::fprintf(out, "%-6s %8u %10.3f %10.3g %10.3g %10.3g%s\n",
                 scene.sea.swell.height_m > 0.0 ? "swell" : "none", spokes,
                 seconds * 1e9 / (double{kSeaSpokes} * model.geometry.cells),
                 errors[errors.size() / 2], errors[errors.size() * 99 / 100], errors.back(),
                 spokes == in_use ? "  in use" : "");
  }
}

}  // namespace

void print_texture_error(std::FILE* out) {
  std::fprintf(out, "%-6s %8s %10s %10s %10s %10s\n", "swell", "spokes", "ns/cell", "p50 dB",
               "p99 dB", "max dB");
  echo::Scene scene;
  scene.seed = 3;
  scene.sea.state = 4.0;
  print_for(scene, out);
  scene.sea.swell = {2.0, 10.0, 45.0};
  print_for(scene, out);
}

}  // namespace skerry::bench
