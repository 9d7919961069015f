// Whole scenes with shores of all types, structures, charted relief, tide and waves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/isa.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "tests/scenes/ray_returns.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::echo {
namespace {

using scenes::NamedScene;

enum class With { types, rock_only, nothing };

// Islands of alternating types, a quay as high as charted among them.
CoastChart chart(With with, bool relief) {
  CoastChart chart = scenes::made_up_chart(scenes::kBergen, metres(6000.0), 40, 7);
  if (with != With::nothing) {
    chart.shores = {{CoastType::rocky, 0.0f},
                    {CoastType::artificial, 0.0f},
                    {CoastType::sandy, 0.0f},
                    {CoastType::artificial, 5.0f}};
    for (std::size_t r = 0; r < chart.rings.size(); ++r) {
      CoastRing& ring = chart.rings[r];
      for (std::size_t i = 0; i < ring.edges.size(); ++i) {
        ring.shores.push_back(with == With::rock_only
                                  ? std::uint16_t{0}
                                  : static_cast<std::uint16_t>((r + i / 5) % 4));
      }
    }
  }
  if (relief) {
    auto grid = std::make_shared<ElevationGrid>();
    grid->south_deg = scenes::kBergen.latitude_deg - 0.02;
    grid->west_deg = scenes::kBergen.longitude_deg - 0.05;
    grid->step_lat_deg = 0.0003, grid->step_lon_deg = 0.0006;
    grid->rows = 150, grid->columns = 150;
    for (int i = 0; i < grid->rows * grid->columns; ++i) {
      grid->heights_m.push_back(i % 37 == 0 ? std::nanf("") : static_cast<float>(i % 150) * 0.2f);
    }
    chart.elevation = grid;
  }
  return chart;
}

std::shared_ptr<const Structures> harbour() {
  auto built = std::make_shared<Structures>();
  for (int i = 0; i < 30; ++i) {
    const SinCos at = sin_cos_degrees(12.0 * i + 3.0);
    const double r = 300.0 + 150.0 * i;
    built->walls.push_back({{r * at.sin, r * at.cos},
                            {(r + 40.0) * at.sin, (r + 90.0) * at.cos},
                            i % 3 ? 0.0f : 15.0f,
                            i % 3 ? 4.0f : 20.0f,
                            static_cast<ObjectClass>(i % 6)});
    built->points.push_back({{r * at.cos, -r * at.sin}, 3.0f, 5.0f, ObjectClass::buoy, 1});
  }
  return built;
}

NamedScene scene(With with, bool relief, std::shared_ptr<const Structures> structures,
                 double level = 0.0, double waves = 0.0, std::vector<CoverArea> covers = {}) {
  const RangeScale scale = *RangeScale::find(3.0);
  const ScanGeometry geometry{1024, 512, 8};
  const GeoPoint at = scenes::kBergen;
  auto made = std::make_shared<Scene>(
      *scenes::scene_at(CoastChart{at, 1e5, "", {}, {}, {}, {}}, at, scale, geometry, {}, 31.0));
  CoastRules rules{.seed = 1};
  rules.guess_types = false;
  CoastChart all = chart(with, relief);
  all.covers = std::move(covers);
  made->coast = CoastPreparer(std::move(all), at, rules)
                    .prepare(at, {scale.length().in_metres(), geometry.cell_size(scale).in_metres(),
                                  360.0 / geometry.spokes_per_turn});
  made->index = std::make_shared<const PolarIndex>(*made->coast, made->own_ship, 50.0);
  made->ashore = is_ashore(*made->coast, *made->index, made->own_ship);
  if (structures)
    made->structure_index =
        std::make_shared<const StructureIndex>(structures, made->own_ship, 50.0);
  made->water_level_m = level;
  made->wave_height_m = waves;
  ViewControls controls;
  controls.range_scale = scale;
  return {"typed", made, {}, geometry, 24.0, controls};
}

std::uint64_t video_of(const NamedScene& named, const ParallelFor& parallel = serial_for) {
  return scenes::hash_of(scenes::render_scans(named, 1, parallel));
}

// Woods in quarters of a minute of arc, a town in the midst of them.
std::vector<CoverArea> woods() {
  std::vector<CoverArea> covers;
  const auto box = [&](LandCover cover, double south, double west, double size) {
    const GeoPoint at{scenes::kBergen.latitude_deg + south, scenes::kBergen.longitude_deg + west};
    covers.push_back({cover,
                      {{at,
                        {at.latitude_deg, at.longitude_deg + size},
                        {at.latitude_deg + size, at.longitude_deg + size},
                        {at.latitude_deg + size, at.longitude_deg}}}});
  };
  for (int i = 0; i < 200; ++i)
    box(static_cast<LandCover>(1 + i % (kLandCovers - 1)), -0.1 + 0.01 * (i / 14),
        -0.1 + 0.02 * (i % 14), 0.007);
  box(LandCover::built_up, -0.03, -0.05, 0.02);
  return covers;
}

// Not a place within 6 km is covered.
std::vector<CoverArea> far_woods() {
  const GeoPoint at = scenes::kBergen;
  return {{LandCover::forest,
           {{{at.latitude_deg + 0.06, at.longitude_deg},
             {at.latitude_deg + 0.06, at.longitude_deg + 0.1},
             {at.latitude_deg + 0.1, at.longitude_deg}}}}};
}

TEST(TypedScene, CoverChangesNothingButWhereItLies) {
  for (const bool relief : {false, true}) {
    for (const With with : {With::nothing, With::types}) {
      const auto plain = video_of(scene(with, relief, harbour()));
      EXPECT_EQ(video_of(scene(with, relief, harbour(), 0.0, 0.0, far_woods())), plain);
      EXPECT_NE(video_of(scene(with, relief, harbour(), 0.0, 0.0, woods())), plain);
    }
  }
}

class TypedScenes : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Covered, TypedScenes, testing::Bool());

TEST_P(TypedScenes, GiveTheSameVideoOnEveryInstructionSetAndInAnyOrder) {
  const NamedScene all = scene(With::types, true, harbour(), -2.0, 1.5,
                               GetParam() ? woods() : std::vector<CoverArea>{});
  ASSERT_FALSE(all.scene->ashore);
  const std::uint64_t expected = video_of(all);
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (isa > best_isa()) continue;
    force_isa(isa);
    EXPECT_EQ(video_of(all), expected) << name_of(isa);
  }
  force_isa(best_isa());
  EXPECT_EQ(video_of(all,
                     [](std::size_t n, const auto& body) {
                       for (std::size_t i = n; i-- > 0;) body(i);
                     }),
            expected);
}

TEST(TypedScene, EachThingOfItShows) {
  const auto plain = video_of(scene(With::nothing, false, nullptr));
  EXPECT_NE(video_of(scene(With::types, false, nullptr)), plain);
  EXPECT_NE(video_of(scene(With::nothing, true, nullptr)), plain);
  EXPECT_NE(video_of(scene(With::nothing, false, harbour())), plain);
  const auto typed = video_of(scene(With::types, false, nullptr));
  EXPECT_NE(video_of(scene(With::types, false, nullptr, -2.0)), typed);
  EXPECT_NE(video_of(scene(With::types, false, nullptr, 0.0, 1.5)), typed);
}

TEST(TypedScene, RockIsRockWhetherChartedOrNot) {
  const auto plain = video_of(scene(With::nothing, false, nullptr));
  EXPECT_EQ(video_of(scene(With::rock_only, false, nullptr)), plain);
  EXPECT_EQ(video_of(scene(With::rock_only, false, nullptr, -3.0, 4.0)), plain);
}

// Structures that lie too far off to echo, and rays that none lies on: the bits of a scene without.
TEST(TypedScene, StructuresChangeNothingButWhereTheyStand) {
  const NamedScene without = scene(With::nothing, false, nullptr);
  auto far = std::make_shared<Structures>();
  far->walls.push_back({{-2e5, 1e5}, {2e5, 1e5}, 0.0f, 5.0f, ObjectClass::pier});
  far->points.push_back({{1e5, 1e5}, 5.0f, 1e6f, ObjectClass::buoy, 1});
  EXPECT_EQ(video_of(scene(With::nothing, false, far)), video_of(without));

  // Buoys on 16 bearings, 1 km off; some stand behind islands.
  auto buoys = std::make_shared<Structures>();
  for (int i = 0; i < 16; ++i) {
    const SinCos at = sin_cos_degrees(22.5 * i);
    buoys->points.push_back({{1000 * at.sin, 1000 * at.cos}, 5.0f, 30.0f, ObjectClass::buoy, 1});
  }
  const NamedScene with = scene(With::nothing, false, buoys);
  RayModel model;
  model.pulse = with.set.pulse_for(with.controls.range_scale);
  model.rays_per_turn = 2048;
  model.cells = 512;
  model.cell_m = with.geometry.cell_size(with.controls.range_scale).in_metres();
  RayScratch scratch;
  std::vector<float> power_a(512), power_b(512);
  int changed = 0;
  for (std::uint32_t k = 0; k < model.rays_per_turn; ++k) {
    const std::uint32_t relative = k << 21;
    ray_returns(*with.scene, model, relative, 0.0, scratch, power_a);
    ray_returns(*without.scene, model, relative, 0.0, scratch, power_b);
    for (std::size_t i = 0; i < 512; ++i) {
      if (power_a[i] == power_b[i]) continue;
      ++changed;
      // One pulse deep: 37 m in cells of 10.9 m.
      EXPECT_GE(i, 91u);
      EXPECT_LE(i, 97u);
    }
  }
  std::printf("16 buoys changed %d cells of %u rays\n", changed, model.rays_per_turn);
  EXPECT_GT(changed, 16);
  EXPECT_LE(changed, 16 * 3 * 6);
}

}  // namespace
}  // namespace skerry::echo
