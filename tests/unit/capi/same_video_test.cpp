// The video of the C interface against a SpokeRenderer driven directly.
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

#include "echo/chart/gdal/open_chart.hpp"
#include "echo/chart/gshhg_reader.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/spoke_renderer.hpp"
#include "tests/scenes/scenes.hpp"
#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

constexpr std::uint64_t kSeed = 20261121;

// The interface's promise, done by hand: the coast is made around a position that was set, when
// half of its slack is used up or the range scale is another; the chart is read when it no longer
// serves.  Its indices are made
// for every scene, which must change nothing.
class ByHand {
 public:
  using Load = std::function<echo::CoastChart(GeoPoint, double radius_m)>;

  ByHand(Load load, const skerry_echo_radar_options& o)
      : load_(std::move(load)),
        geometry_{o.spokes_per_turn, o.cells, o.bits},
        renderer_({}, geometry_, {o.rpm, o.spokes_per_turn}, o.number) {}

  void set_controls(const echo::ViewControls& controls) {
    renderer_.set_controls(controls);
    const double range = controls.range_scale.length().in_metres();
    resolution_ = {range, range / geometry_.cells, 360.0 / geometry_.spokes_per_turn};
    picture_ = nullptr;
    if (preparer_) bring_coast(scene_.own_ship_geo);
  }

  void set_scene(std::int64_t time_ns, const skerry_echo_own_ship& own,
                 const std::vector<skerry_echo_target>& targets) {
    const GeoPoint at{own.latitude_deg, own.longitude_deg};
    bring_coast(at);
    const echo::LocalPlane& plane = picture_->plane;
    scene_ = {};
    scene_.time = ScenarioTime(Duration(time_ns));
    scene_.seed = kSeed;
    scene_.coast = picture_;
    scene_.own_ship_geo = at;
    scene_.own_ship = plane.to_plane(at);
    scene_.true_north_deg = plane.true_north_degrees(at);
    scene_.own_velocity = velocity(own, scene_.true_north_deg);
    scene_.heading_deg = own.heading_deg;
    scene_.turn_rate_deg_s = own.turn_rate_deg_s;
    scene_.index = std::make_shared<const echo::PolarIndex>(*picture_, scene_.own_ship, 700.0);
    if (picture_->structures) {
      scene_.structure_index = std::make_shared<const echo::StructureIndex>(picture_->structures,
                                                                            scene_.own_ship, 700.0);
    }
    scene_.ashore = echo::is_ashore(*picture_, *scene_.index, scene_.own_ship);
    for (const skerry_echo_target& t : targets) {
      const GeoPoint place{t.latitude_deg, t.longitude_deg};
      const double north = plane.true_north_degrees(place);
      scene_.hulls.push_back({plane.to_plane(place), velocity(t, north), t.heading_deg + north,
                              t.turn_rate_deg_s, t.length_m, t.beam_m, t.height_m, t.identity});
    }
  }

  std::vector<std::uint8_t> render(std::uint64_t first, std::uint32_t count) {
    std::vector<std::uint8_t> video(std::size_t{count} * geometry_.cells);
    renderer_.render(scene_, first, count, video);
    return video;
  }

 private:
  void bring_coast(GeoPoint at) {
    if (!preparer_ || !preparer_->serves(at, resolution_.range_m)) {
      preparer_ = std::make_unique<echo::CoastPreparer>(
          load_(at, std::max(1.25 * resolution_.range_m + 5000.0, 12 * 1852.0)), at,
          echo::CoastRules{.seed = kSeed});
      picture_ = nullptr;
    }
    if (picture_) {
      const PlanePoint off = picture_->plane.to_plane(at) - picture_->centre;
      if (std::hypot(off.east_m, off.north_m) > 0.5 * picture_->slack_m) picture_ = nullptr;
    }
    if (!picture_) picture_ = preparer_->prepare(at, resolution_);
  }

  template <typename Ship>
  static PlanePoint velocity(const Ship& ship, double north_deg) {
    const echo::SinCos course = echo::sin_cos_degrees(ship.course_deg + north_deg);
    return {ship.speed_mps * course.sin, ship.speed_mps * course.cos};
  }

  Load load_;
  ScanGeometry geometry_;
  echo::SpokeRenderer renderer_;
  echo::RadarResolution resolution_;
  std::unique_ptr<echo::CoastPreparer> preparer_;
  echo::CoastPicturePtr picture_;
  echo::Scene scene_;
};

// A voyage at 25 m/s, four scenes a turn, with targets around; on the way the range scale changes.
struct Voyage {
  static constexpr std::uint32_t kPerScene = 128;
  GeoPoint start = kAfloat;
  double jump_deg = 0.0;  // northward, each turn

  skerry_echo_own_ship own_at(std::uint64_t spoke, double turns) const {
    skerry_echo_own_ship own = own_ship_at(start);
    own.latitude_deg += turns * (25.0 * 2.5 * std::cos(0.7) / 111400.0) +
                        jump_deg * static_cast<double>(spoke / 512);
    own.longitude_deg += turns * (25.0 * 2.5 * std::sin(0.7) / 55400.0);
    own.course_deg = 0.7 * 57.29577951;
    own.speed_mps = 25.0;
    own.heading_deg = 33.0 + static_cast<double>(spoke) * 0.01;
    own.turn_rate_deg_s = 2.0;
    return own;
  }
  std::vector<skerry_echo_target> targets_at(const skerry_echo_own_ship& own) const {
    std::vector<skerry_echo_target> targets;
    for (int i = 0; i < 8; ++i) {
      auto t = target_at({own.latitude_deg + 0.004 * (i - 3), own.longitude_deg + 0.006 * (4 - i)},
                         static_cast<std::uint64_t>(100 + i));
      t.course_deg = t.heading_deg = 45.0 * i;
      t.speed_mps = 2.0 * i;
      t.length_m = 20.0 + 30.0 * i;
      targets.push_back(t);
    }
    targets.push_back(
        target_at({-own.latitude_deg, wrapped_longitude(own.longitude_deg + 180.0)}, 999));
    return targets;
  }
};

void sail(const Voyage& voyage, skerry_echo_chart* chart, const ByHand::Load& load,
          std::uint32_t turns) {
  skerry_echo_radar_options options = small_options();
  options.number = 3;
  const Coast coast = coast_of(chart, kSeed);
  const Radar radar = radar_of(coast, options);
  ByHand by_hand(load, options);
  const auto set_range = [&](double nm) {
    ASSERT_OK(skerry_echo_radar_set_controls(radar, nm, 60.0, 30.0, 15.0));
    by_hand.set_controls({*RangeScale::find(nm), 60.0, 30.0, 15.0});
  };
  set_range(0.75);
  std::uint64_t lit = 0;
  for (std::uint64_t first = 0; first < 512u * turns; first += Voyage::kPerScene) {
    if (first == 512 * 2) set_range(3.0);
    const skerry_echo_own_ship own = voyage.own_at(first, static_cast<double>(first) / 512.0);
    const auto targets = voyage.targets_at(own);
    std::int64_t time = 0;
    ASSERT_OK(skerry_echo_radar_spoke_time(radar, first, &time));
    ASSERT_OK(skerry_echo_radar_set_scene(radar, time, &own, targets.data(), targets.size()));
    by_hand.set_scene(time, own, targets);
    std::vector<std::uint8_t> got(std::size_t{Voyage::kPerScene} * options.cells);
    ASSERT_OK(skerry_echo_radar_render(radar, first, Voyage::kPerScene, got.data(), got.size(),
                                       options.cells));
    ASSERT_TRUE(got == by_hand.render(first, Voyage::kPerScene)) << "spokes from " << first;
    for (const std::uint8_t cell : got) lit += cell > 100;
  }
  EXPECT_GT(lit, 2000u) << "there is something to be seen";
}

TEST(CVideo, IsThatOfASpokeRendererBitForBitOverAVoyage) {
  const Rings rings = islands(nautical_miles(5.0), 120, 4);
  const Chart chart = chart_of(rings);
  sail(
      {}, chart,
      [&](GeoPoint centre, double radius) { return coast_chart_of(rings, centre, radius); }, 6);
}

TEST(CVideo, IsThatOfASpokeRendererWhereTheChartIsReadAnew) {
  const Rings rings = islands(nautical_miles(5.0), 120, 4);
  const Chart chart = chart_of(rings);
  sail(
      {kAfloat, 0.03}, chart,
      [&](GeoPoint centre, double radius) { return coast_chart_of(rings, centre, radius); }, 5);
}

TEST(CVideo, IsThatOfASpokeRendererOnTheWorldsShoreline) {
  if (!world_installed()) GTEST_SKIP() << "no GSHHG chart installed (Debian: gmt-gshhg-full)";
  const auto reader = echo::GshhgReader::open(echo::GshhgReader::find_finest());
  Chart chart;
  ASSERT_OK(open_chart("", chart));
  sail(
      {}, chart,
      [&](GeoPoint centre, double radius) { return reader.load(centre, metres(radius)); }, 4);
}

TEST(CVideo, IsThatOfASpokeRendererOnAnEncCellWithItsPiers) {
  const std::filesystem::path cell = SKERRY_SOURCE_DIR "/../shared/data/enc/US5WA22M.000";
  if (!std::filesystem::exists(cell)) GTEST_SKIP() << "no " << cell << " here";
  const auto opened = echo::open_chart(cell);
  Chart chart;
  ASSERT_OK(open_chart(cell, chart));
  sail(
      {{47.285, -122.45}}, chart,
      [&](GeoPoint centre, double radius) { return opened.chart->load(centre, metres(radius)); },
      4);
}

// Three turns in one scene: the ship sails 187 m, within what her coast serves at 6 NM and beyond
// what an index does.
TEST(CVideo, IsThatOfASpokeRendererForAsLongAsASceneServes) {
  const Rings rings = islands(nautical_miles(5.0), 400, 4);
  const Chart chart = chart_of(rings);
  const Coast coast = coast_of(chart, kSeed);
  const Radar radar = radar_of(coast, small_options());
  ByHand by_hand([&](GeoPoint centre, double r) { return coast_chart_of(rings, centre, r); },
                 small_options());
  ASSERT_OK(skerry_echo_radar_set_controls(radar, 6.0, 60.0, 30.0, 0.0));
  by_hand.set_controls({*RangeScale::find(6.0), 60.0, 30.0, 0.0});
  const skerry_echo_own_ship own = Voyage{}.own_at(0, 0.0);
  ASSERT_OK(skerry_echo_radar_set_scene(radar, 0, &own, nullptr, 0));
  by_hand.set_scene(0, own, {});
  std::vector<std::uint8_t> got(512 * 256);
  for (std::uint64_t first = 0; first < 3 * 512; first += 512) {
    ASSERT_OK(skerry_echo_radar_render(radar, first, 512, got.data(), got.size(), 256));
    EXPECT_TRUE(got == by_hand.render(first, 512)) << "turn " << first / 512;
  }
}

TEST(CVideo, IsTheSameHoweverATurnIsCutIntoCalls) {
  const Chart chart = chart_of(islands(nautical_miles(5.0), 120, 4));
  const Coast coast = coast_of(chart, kSeed);
  const auto turn = [&](const std::vector<std::uint32_t>& cuts, std::size_t stride) {
    const Radar radar = radar_of(coast, small_options());
    EXPECT_OK(skerry_echo_radar_set_controls(radar, 6.0, 50.0, 20.0, 0.0));
    const Voyage voyage;
    skerry_echo_own_ship own = voyage.own_at(0, 0.0);
    const auto targets = voyage.targets_at(own);
    EXPECT_OK(skerry_echo_radar_set_scene(radar, 0, &own, targets.data(), targets.size()));
    std::vector<std::uint8_t> out, part(512 * stride);
    std::uint64_t first = 0;
    for (std::size_t i = 0; first < 512; first += cuts[i % cuts.size()], ++i) {
      const std::uint32_t count =
          std::min<std::uint32_t>(cuts[i % cuts.size()], 512 - static_cast<std::uint32_t>(first));
      EXPECT_OK(skerry_echo_radar_render(radar, first, count, part.data(), part.size(), stride));
      for (std::size_t k = 0; k < count; ++k) {
        const auto row = part.begin() + static_cast<std::ptrdiff_t>(k * stride);
        out.insert(out.end(), row, row + 256);
      }
    }
    return out;
  };
  const auto whole = turn({512}, 256);
  ASSERT_EQ(whole.size(), 512u * 256u);
  EXPECT_GT(std::count_if(whole.begin(), whole.end(), [](auto c) { return c > 100; }), 2000);
  EXPECT_TRUE(turn({1}, 256) == whole);
  EXPECT_TRUE(turn({16}, 300) == whole);
  EXPECT_TRUE(turn({64, 65, 3, 127}, 256) == whole);
}

TEST(CVideo, OfFourBitsHasSixteenValues) {
  const Chart chart = chart_of(islands(nautical_miles(5.0), 120, 4));
  const Coast coast = coast_of(chart, kSeed);
  skerry_echo_radar_options options = small_options();
  options.bits = 4;
  const Radar radar = radar_of(coast, options);
  const auto own = own_ship_at(kAfloat);
  ASSERT_OK(skerry_echo_radar_set_controls(radar, 6.0, 50.0, 20.0, 0.0));
  ASSERT_OK(skerry_echo_radar_set_scene(radar, 0, &own, nullptr, 0));
  std::vector<std::uint8_t> video(512 * 256);
  ASSERT_OK(skerry_echo_radar_render(radar, 0, 512, video.data(), video.size(), 256));
  EXPECT_THAT(video, testing::Each(testing::Le(15)));
  EXPECT_THAT(video, testing::Contains(15));
}

TEST(CVideo, FollowsTheSeaAtOnceAndAgain) {
  const Rings rings = islands(nautical_miles(5.0), 60, 4);
  const std::vector<int32_t> types(rings.sizes.size(), SKERRY_ECHO_COAST_SANDY);
  Chart chart;
  ASSERT_OK(skerry_echo_chart_from_rings(rings.vertices.data(), rings.vertices.size(),
                                         rings.sizes.data(), types.data(), types.size(),
                                         chart.out()));
  const Coast coast = coast_of(chart, kSeed);
  const auto own = own_ship_at(kAfloat);
  const auto turn = [&](double level, double waves, bool before_the_scene) {
    const Radar radar = radar_of(coast, small_options());
    EXPECT_OK(skerry_echo_radar_set_controls(radar, 1.5, 60.0, 10.0, 0.0));
    const auto set_sea = [&] { EXPECT_OK(skerry_echo_radar_set_sea(radar, level, waves)); };
    if (before_the_scene) set_sea();
    EXPECT_OK(skerry_echo_radar_set_scene(radar, 0, &own, nullptr, 0));
    if (!before_the_scene) set_sea();
    std::vector<std::uint8_t> video(512 * 256);
    EXPECT_OK(skerry_echo_radar_render(radar, 0, 512, video.data(), video.size(), 256));
    return video;
  };
  const auto calm = turn(0.0, 0.0, true);
  EXPECT_TRUE(turn(-2.0, 0.0, true) == turn(-2.0, 0.0, false));
  EXPECT_FALSE(turn(-2.0, 0.0, true) == calm) << "the water has fallen off the sand";
}

}  // namespace
}  // namespace skerry::capi_test
