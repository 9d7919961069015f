#include "echo/spoke_renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/kernel/isa.hpp"
#include "server/core/worker_pool.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::echo {
namespace {

TEST(SpokeRenderer, ASceneIsTheSameForAnyNumberOfWorkers) {
  for (const auto& named : scenes::made_up_scenes()) {
    const auto expected = scenes::hash_of(scenes::render_scans(named, 1));
    for (std::size_t workers : {0u, 1u, 2u, 7u}) {
      server::WorkerPool pool(workers);
      const auto video = scenes::render_scans(
          named, 1, [&](std::size_t n, const auto& body) { pool.run(n, body); });
      EXPECT_EQ(scenes::hash_of(video), expected)
          << named.name << ", " << workers + 1 << " workers";
    }
  }
}

TEST(SpokeRenderer, ASceneIsTheSameOnEveryInstructionSet) {
  for (const auto& named : scenes::made_up_scenes()) {
    force_isa(Isa::baseline);
    const auto expected = scenes::hash_of(scenes::render_scans(named, 1));
    for (Isa isa : {Isa::avx2, Isa::avx512}) {
      force_isa(isa);
      EXPECT_EQ(scenes::hash_of(scenes::render_scans(named, 1)), expected)
          << named.name << ", " << name_of(isa);
    }
    force_isa(best_isa());
  }
}

TEST(SpokeRenderer, CallsOfAnySizeGiveTheSameVideo) {
  const auto named = scenes::made_up_scenes()[1];
  const auto expected = scenes::render_scans(named, 1);
  SpokeRenderer renderer(named.set, named.geometry, {named.rpm, named.geometry.spokes_per_turn}, 0);
  renderer.set_controls(named.controls);
  std::vector<std::uint8_t> video(expected.size());
  const std::uint32_t spokes = named.geometry.spokes_per_turn, cells = named.geometry.cells;
  for (std::uint32_t first = 0, size = 1; first < spokes; first += size, size = size % 150 + 13) {
    const std::uint32_t n = std::min(size, spokes - first);
    renderer.render(*named.scene, first, n,
                    std::span(video).subspan(std::size_t{first} * cells, std::size_t{n} * cells));
  }
  EXPECT_EQ(video, expected);
}

TEST(SpokeRenderer, NoiseIsNewEveryScanAndTheCoastStays) {
  auto named = scenes::made_up_scenes()[1];
  named.controls.gain = 80.0;
  const auto video = scenes::render_scans(named, 3);
  const std::size_t scan = video.size() / 3;
  std::size_t noise_differs = 0, strong = 0, strong_stays = 0;
  for (std::size_t i = 0; i < scan; ++i) {
    const std::uint8_t a = video[scan + i], b = video[2 * scan + i];
    noise_differs += a < 60 && b < 60 && a != b;
    strong += a > 150;
    strong_stays += a > 150 && b > 100;
  }
  EXPECT_GT(noise_differs, scan / 10);
  EXPECT_GT(strong, 1000u);
  EXPECT_GT(static_cast<double>(strong_stays), 0.95 * static_cast<double>(strong));
}

// A lone ship shows at her bearing and range, as wide as the beam.
TEST(SpokeRenderer, AShipStandsWhereSheIs) {
  for (std::uint32_t spokes : {256u, 1024u, 4096u}) {
    const ScanGeometry geometry{spokes, 1024, 8};
    const RangeScale scale = *RangeScale::find(6.0);
    const double range = 7000.0, bearing = 77.0;
    Hull hull{{range * std::sin(bearing / 57.29577951308232),
               range * std::cos(bearing / 57.29577951308232)},
              {0, 0},
              bearing,
              0,
              40,
              8,
              12,
              1};
    auto scene = std::make_shared<Scene>(
        *scenes::scene_at(scenes::made_up_chart(scenes::kBergen, nautical_miles(9), 0, 1),
                          scenes::kBergen, scale, geometry, {hull}));
    scene->own_velocity = {};
    const scenes::NamedScene named{"ship", scene, {}, geometry, 24.0, {scale, 20.0, 0.0, 0.0}};
    const auto video = scenes::render_scans(named, 2);
    double sum = 0, east = 0, north = 0, near = 1e9;
    int first = 9999, last = -1;
    const std::size_t scan = std::size_t{spokes} * 1024;
    for (std::uint32_t s = 0; s < spokes; ++s) {
      for (std::uint32_t c = 0; c < 1024; ++c) {
        const double v = video[scan + s * 1024 + c];
        if (v <= 0) continue;
        const double b = 6.283185307179586 * s / spokes;
        sum += v, east += v * std::sin(b), north += v * std::cos(b);
        near = std::min(near, c * 6 * 1852.0 / 1024);
        first = std::min(first, static_cast<int>(s)), last = std::max(last, static_cast<int>(s));
      }
    }
    ASSERT_GT(sum, 0.0);
    const double found = std::atan2(east, north) * 57.29577951308232;
    const double width = (last - first + 1) * 360.0 / spokes;
    std::printf("%u spokes: bearing %.2f, front at %.0f m, %.2f deg wide\n", spokes, found, near,
                width);
    EXPECT_NEAR(found, bearing, std::max(0.1, 180.0 / spokes));
    EXPECT_NEAR(near, range - 20.0, 2 * 6 * 1852.0 / 1024);
    EXPECT_LT(width, 3.0 + 360.0 / spokes);
    EXPECT_GT(width, 0.7);
  }
}

}  // namespace
}  // namespace skerry::echo
