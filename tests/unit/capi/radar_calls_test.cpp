#include <algorithm>
#include <cstring>

#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

constexpr std::uint32_t kSpokes = 512, kCells = 256;

class CRadar : public testing::Test {
 protected:
  int32_t set_scene(std::int64_t time_ns = 0) {
    return skerry_echo_radar_set_scene(radar, time_ns, &own, nullptr, 0);
  }

  Chart chart = chart_of(islands(nautical_miles(4.0), 30, 9));
  Coast coast = coast_of(chart);
  Radar radar = radar_of(coast, small_options());
  skerry_echo_own_ship own = own_ship_at(kAfloat);
  std::vector<std::uint8_t> video = std::vector<std::uint8_t>(kSpokes * kCells, 0xA5);
};

TEST_F(CRadar, SaysWhenEachSpokeIsOnTheAir) {
  std::int64_t time = -1;
  ASSERT_OK(skerry_echo_radar_spoke_time(radar, 0, &time));
  EXPECT_EQ(time, 0);
  ASSERT_OK(skerry_echo_radar_spoke_time(radar, kSpokes, &time));
  EXPECT_EQ(time, 2'500'000'000) << "a turn at 24 rpm";
  // 1e9 s of 24 turns a minute.
  const std::uint64_t last = 400'000'000ull * kSpokes;
  ASSERT_OK(skerry_echo_radar_spoke_time(radar, last, &time));
  EXPECT_EQ(time, 1'000'000'000'000'000'000);
  for (const std::uint64_t bad : {last + 2, std::uint64_t{1} << 63, UINT64_MAX}) {
    EXPECT_REFUSED(skerry_echo_radar_spoke_time(radar, bad, &time), SKERRY_ECHO_ERROR_ARGUMENT,
                   "spoke is");
  }
  EXPECT_REFUSED(skerry_echo_radar_spoke_time(radar, 0, nullptr), SKERRY_ECHO_ERROR_ARGUMENT,
                 "time_ns is NULL");
}

TEST_F(CRadar, RefusesOptionsOutOfRange) {
  using Options = skerry_echo_radar_options;
  skerry_echo_radar* made = nullptr;
  const auto refused = [&](auto member, auto value, int32_t code, const char* word) {
    Options options = small_options();
    options.*member = value;
    EXPECT_REFUSED(skerry_echo_radar_create(coast, &options, &made), code, word);
  };
  for (const uint32_t bad : {0u, 255u, 8193u, UINT32_MAX}) {
    refused(&Options::spokes_per_turn, bad, SKERRY_ECHO_ERROR_ARGUMENT, "256 to 8192");
  }
  for (const uint32_t bad : {0u, 255u, 4097u, UINT32_MAX}) {
    refused(&Options::cells, bad, SKERRY_ECHO_ERROR_ARGUMENT, "256 to 4096");
  }
  for (const uint32_t bad : {0u, 1u, 5u, 16u}) {
    refused(&Options::bits, bad, SKERRY_ECHO_ERROR_ARGUMENT, "4 or 8");
  }
  for (const uint32_t bad : {0u, 87u, 4097u, UINT32_MAX}) {
    refused(&Options::struct_size, bad, SKERRY_ECHO_ERROR_SIZE, "expected 88");
  }
  refused(&Options::reserved, 1u, SKERRY_ECHO_ERROR_ARGUMENT, "options.reserved");
  struct Range {
    double Options::*member;
    const char* name;
    double min, max;
  };
  const Range ranges[] = {{&Options::rpm, "options.rpm", 1.0, 240.0},
                          {&Options::frequency_hz, "options.frequency_hz", 2.85e9, 9.9e9},
                          {&Options::peak_power_w, "options.peak_power_w", 1.0, 100e3},
                          {&Options::antenna_gain_db, "options.antenna_gain_db", 15.0, 45.0},
                          {&Options::beam_width_deg, "options.beam_width_deg", 0.3, 7.5},
                          {&Options::antenna_height_m, "options.antenna_height_m", 1.0, 100.0},
                          {&Options::noise_figure_db, "options.noise_figure_db", 0.0, 20.0},
                          {&Options::losses_db, "options.losses_db", 0.0, 20.0}};
  for (const Range& range : ranges) {
    for (const double bad : {range.min * 0.999 - 1e-3, range.max * 1.001, -1.0, kNaN, kInfinity}) {
      refused(range.member, bad, SKERRY_ECHO_ERROR_ARGUMENT, range.name);
    }
    for (const double good : {range.min, range.max}) {
      Options options = small_options();
      options.*range.member = good;
      const Radar one = radar_of(coast, options);
      ASSERT_OK(skerry_echo_radar_set_scene(one, 0, &own, nullptr, 0));
      EXPECT_OK(skerry_echo_radar_render(one, 0, 8, video.data(), video.size(), kCells));
    }
  }
  const Options options = small_options();
  EXPECT_REFUSED(skerry_echo_radar_create(coast, nullptr, &made), SKERRY_ECHO_ERROR_ARGUMENT,
                 "options is NULL");
  EXPECT_REFUSED(skerry_echo_radar_create(coast, &options, nullptr), SKERRY_ECHO_ERROR_ARGUMENT,
                 "radar is NULL");
  EXPECT_EQ(made, nullptr);
}

TEST_F(CRadar, RefusesControlsAndSeasOutOfRange) {
  for (const double bad : {0.0, 5.0, 0.1, 100.0, -6.0, kNaN, kInfinity}) {
    EXPECT_REFUSED(skerry_echo_radar_set_controls(radar, bad, 50, 20, 0),
                   SKERRY_ECHO_ERROR_ARGUMENT, "0.125 0.25");
  }
  for (const double bad : {-0.1, 100.1, kNaN, kInfinity}) {
    EXPECT_REFUSED(skerry_echo_radar_set_controls(radar, 6, bad, 20, 0), SKERRY_ECHO_ERROR_ARGUMENT,
                   "gain");
    EXPECT_REFUSED(skerry_echo_radar_set_controls(radar, 6, 50, bad, 0), SKERRY_ECHO_ERROR_ARGUMENT,
                   "sea");
    EXPECT_REFUSED(skerry_echo_radar_set_controls(radar, 6, 50, 20, bad),
                   SKERRY_ECHO_ERROR_ARGUMENT, "rain");
  }
  for (const double bad : {-17.1, 15.1, kNaN}) {
    EXPECT_REFUSED(skerry_echo_radar_set_sea(radar, bad, 0), SKERRY_ECHO_ERROR_ARGUMENT,
                   "water_level_m");
  }
  for (const double bad : {-0.1, 15.1, kNaN}) {
    EXPECT_REFUSED(skerry_echo_radar_set_sea(radar, 0, bad), SKERRY_ECHO_ERROR_ARGUMENT,
                   "wave_height_m");
  }
}

template <typename Ship>
struct ShipRange {
  double Ship::*member;
  const char* name;
  double min, max;
};

TEST_F(CRadar, RefusesOwnShipsOutOfRange) {
  using Own = skerry_echo_own_ship;
  const ShipRange<Own> ranges[] = {{&Own::latitude_deg, "latitude_deg", -90, 90},
                                   {&Own::longitude_deg, "longitude_deg", -180, 180},
                                   {&Own::course_deg, "course_deg", -360, 360},
                                   {&Own::speed_mps, "speed_mps", -50, 50},
                                   {&Own::heading_deg, "heading_deg", -360, 360},
                                   {&Own::turn_rate_deg_s, "turn_rate_deg_s", -30, 30}};
  const Own good = own;
  for (const auto& range : ranges) {
    for (const double bad : {range.min * 1.001, range.max * 1.001, kNaN, kInfinity, -kInfinity}) {
      own = good;
      own.*range.member = bad;
      EXPECT_REFUSED(set_scene(), SKERRY_ECHO_ERROR_ARGUMENT,
                     "own_ship: " + std::string(range.name));
    }
    for (const double edge : {range.min, range.max}) {
      own = good;
      own.*range.member = edge;
      EXPECT_OK(set_scene());
      EXPECT_OK(skerry_echo_radar_render(radar, 0, 8, video.data(), video.size(), kCells));
    }
  }
  own = good;
  own.reserved = 1;
  EXPECT_REFUSED(set_scene(), SKERRY_ECHO_ERROR_ARGUMENT, "own_ship: reserved");
  own = good;
  own.struct_size = 8;
  EXPECT_REFUSED(set_scene(), SKERRY_ECHO_ERROR_SIZE, "expected 56");
  EXPECT_REFUSED(skerry_echo_radar_set_scene(radar, 0, nullptr, nullptr, 0),
                 SKERRY_ECHO_ERROR_ARGUMENT, "own_ship is NULL");
  own = good;
  for (const std::int64_t bad : {INT64_MIN, INT64_MAX, std::int64_t{1'000'000'000'000'000'001}}) {
    EXPECT_REFUSED(set_scene(bad), SKERRY_ECHO_ERROR_ARGUMENT, "time_ns");
  }
}

TEST_F(CRadar, RefusesTargetsOutOfRange) {
  using Target = skerry_echo_target;
  const ShipRange<Target> ranges[] = {{&Target::latitude_deg, "latitude_deg", -90, 90},
                                      {&Target::longitude_deg, "longitude_deg", -180, 180},
                                      {&Target::course_deg, "course_deg", -360, 360},
                                      {&Target::speed_mps, "speed_mps", -50, 50},
                                      {&Target::heading_deg, "heading_deg", -360, 360},
                                      {&Target::turn_rate_deg_s, "turn_rate_deg_s", -30, 30},
                                      {&Target::length_m, "length_m", 0.3, 500},
                                      {&Target::beam_m, "beam_m", 0.1, 100},
                                      {&Target::height_m, "height_m", 0.1, 100}};
  std::vector<Target> targets(3, target_at({60.28, 5.15}, 1));
  const std::vector<Target> good = targets;
  const auto set = [&] {
    return skerry_echo_radar_set_scene(radar, 0, &own, targets.data(), targets.size());
  };
  for (const auto& range : ranges) {
    for (const double bad :
         {range.min - 0.01 - 0.001 * std::abs(range.min), range.max * 1.001, kNaN, kInfinity}) {
      targets = good;
      targets[2].*range.member = bad;
      EXPECT_REFUSED(set(), SKERRY_ECHO_ERROR_ARGUMENT, "targets[2]: " + std::string(range.name));
    }
    for (const double edge : {range.min, range.max}) {
      targets = good;
      targets[1].*range.member = edge;
      EXPECT_OK(set());
      EXPECT_OK(skerry_echo_radar_render(radar, 0, 8, video.data(), video.size(), kCells));
    }
  }
  for (const uint32_t bad : {0u, 87u, 96u, UINT32_MAX}) {
    targets = good;
    targets[1].struct_size = bad;
    EXPECT_REFUSED(set(), SKERRY_ECHO_ERROR_SIZE, "targets[1]: struct_size");
  }
  targets = good;
  targets[0].struct_size = 0;
  EXPECT_REFUSED(set(), SKERRY_ECHO_ERROR_SIZE, "targets[0]");
  EXPECT_REFUSED(skerry_echo_radar_set_scene(radar, 0, &own, nullptr, 1),
                 SKERRY_ECHO_ERROR_ARGUMENT, "targets is NULL");
  for (const std::size_t bad : {std::size_t{10'001}, SIZE_MAX}) {
    EXPECT_REFUSED(skerry_echo_radar_set_scene(radar, 0, &own, good.data(), bad),
                   SKERRY_ECHO_ERROR_ARGUMENT, "0 to 10000");
  }
}

TEST_F(CRadar, NeedsASceneThatIsNotTooOld) {
  const auto render = [&](std::uint64_t first) {
    return skerry_echo_radar_render(radar, first, 8, video.data(), video.size(), kCells);
  };
  skerry_echo_radar_state state{};
  state.struct_size = sizeof state;
  EXPECT_REFUSED(render(0), SKERRY_ECHO_ERROR_STATE, "skerry_echo_radar_set_scene");
  EXPECT_REFUSED(skerry_echo_radar_get_state(radar, &state), SKERRY_ECHO_ERROR_STATE,
                 "skerry_echo_radar_set_scene");
  ASSERT_OK(set_scene(20'000'000'000));
  EXPECT_OK(render(2048));  // 10 s before
  EXPECT_OK(render(6136));  // to 10 s after
  EXPECT_REFUSED(render(6140), SKERRY_ECHO_ERROR_STATE, "serves 10 s");
  EXPECT_REFUSED(render(2000), SKERRY_ECHO_ERROR_STATE, "serves 10 s");
  // At 0.25 NM the coast made serves 20 m, of which 10 may be used up when a scene is set.
  own.speed_mps = 15.0;
  own.course_deg = 90.0;
  ASSERT_OK(skerry_echo_radar_set_controls(radar, 0.25, 50, 20, 0));
  ASSERT_OK(set_scene(0));
  EXPECT_OK(render(128));  // 9.6 m on
  EXPECT_REFUSED(render(300), SKERRY_ECHO_ERROR_STATE, "22.5 m from where");
  EXPECT_OK(skerry_echo_radar_get_state(radar, &state));
  EXPECT_THAT(video, testing::Contains(0xA5));
}

TEST_F(CRadar, WritesOnlyTheCellsAskedFor) {
  ASSERT_OK(set_scene());
  EXPECT_REFUSED(skerry_echo_radar_render(radar, 0, 1, nullptr, kCells, kCells),
                 SKERRY_ECHO_ERROR_ARGUMENT, "video is NULL");
  for (const std::uint32_t bad : {0u, kSpokes + 1, UINT32_MAX}) {
    EXPECT_REFUSED(skerry_echo_radar_render(radar, 0, bad, video.data(), video.size(), kCells),
                   SKERRY_ECHO_ERROR_ARGUMENT, "count is");
  }
  for (const std::uint64_t bad : {UINT64_MAX, UINT64_MAX - 7, std::uint64_t{1} << 60}) {
    EXPECT_REFUSED(skerry_echo_radar_render(radar, bad, 8, video.data(), video.size(), kCells),
                   SKERRY_ECHO_ERROR_ARGUMENT, "spoke is");
  }
  const auto refused = [&](std::uint32_t count, std::size_t size, std::size_t stride,
                           const char* word) {
    EXPECT_REFUSED(skerry_echo_radar_render(radar, 0, count, video.data(), size, stride),
                   SKERRY_ECHO_ERROR_SIZE, word);
  };
  refused(1, kCells - 1, kCells, "video has 255 bytes");
  refused(1, 0, kCells, "video has 0 bytes");
  refused(4, 4 * kCells - 1, kCells, "take 1024");
  refused(4, 3 * 300 + kCells - 1, 300, "take 1156");
  refused(4, video.size(), kCells - 1, "stride is 255");
  refused(4, video.size(), 0, "stride is 0");
  refused(4, video.size(), SIZE_MAX, "bytes apart");
  refused(3, video.size(), SIZE_MAX / 2 + 1, "bytes apart");
  EXPECT_THAT(video, testing::Each(0xA5)) << "a refused call writes nothing";

  constexpr std::size_t kStride = 300, kSize = 3 * kStride + kCells;
  ASSERT_OK(skerry_echo_radar_render(radar, 100, 4, video.data(), kSize, kStride));
  std::vector<std::uint8_t> tight(4 * kCells);
  ASSERT_OK(skerry_echo_radar_render(radar, 100, 4, tight.data(), tight.size(), kCells));
  for (std::size_t k = 0; k < 4; ++k) {
    const auto row = video.begin() + static_cast<std::ptrdiff_t>(k * kStride);
    EXPECT_TRUE(
        std::equal(row, row + kCells, tight.begin() + static_cast<std::ptrdiff_t>(k * kCells)));
    const std::size_t between = k < 3 ? kStride - kCells : 1000;
    EXPECT_TRUE(std::all_of(row + kCells, row + kCells + static_cast<std::ptrdiff_t>(between),
                            [](std::uint8_t b) { return b == 0xA5; }))
        << "between the rows and behind them";
  }
}

TEST_F(CRadar, SaysWhereItIsAndWhatItMade) {
  skerry_echo_radar_state state{};
  state.struct_size = sizeof state;
  ASSERT_OK(skerry_echo_radar_set_controls(radar, 1.5, 50, 20, 0));
  ASSERT_OK(set_scene());
  ASSERT_OK(skerry_echo_radar_get_state(radar, &state));
  EXPECT_EQ(state.own_ship_ashore, 0);
  EXPECT_GT(state.coast_edges, 50u);
  EXPECT_EQ(state.coasts_made, 1u);
  EXPECT_EQ(state.charts_read, 1u);
  EXPECT_EQ(state.cell_m, 1.5 * 1852.0 / kCells);
  ASSERT_OK(set_scene());
  ASSERT_OK(skerry_echo_radar_get_state(radar, &state));
  EXPECT_EQ(state.coasts_made, 1u) << "the coast at hand serves";
  own.latitude_deg += 60.0 / 111412.0;  // 60 m on: more than half of 2 % of 1.5 NM
  ASSERT_OK(set_scene());
  ASSERT_OK(skerry_echo_radar_get_state(radar, &state));
  EXPECT_EQ(state.coasts_made, 2u);
  EXPECT_EQ(state.charts_read, 1u);
  own.latitude_deg += 0.1;  // 6 NM
  ASSERT_OK(set_scene());
  ASSERT_OK(skerry_echo_radar_get_state(radar, &state));
  EXPECT_EQ(state.charts_read, 2u);
  for (const uint32_t bad : {0u, 39u, 5000u}) {
    state.struct_size = bad;
    EXPECT_REFUSED(skerry_echo_radar_get_state(radar, &state), SKERRY_ECHO_ERROR_SIZE, "40");
  }
  EXPECT_REFUSED(skerry_echo_radar_get_state(radar, nullptr), SKERRY_ECHO_ERROR_ARGUMENT, "NULL");
}

TEST_F(CRadar, RefusesWhatIsNoRadar) {
  std::int64_t time = 7;
  skerry_echo_radar_state state{};
  state.struct_size = sizeof state;
  const auto refused_everywhere = [&](skerry_echo_radar* none) {
    const int32_t code = SKERRY_ECHO_ERROR_HANDLE;
    EXPECT_REFUSED(skerry_echo_radar_set_controls(none, 6, 50, 20, 0), code, "radar is");
    EXPECT_REFUSED(skerry_echo_radar_set_sea(none, 0, 0), code, "radar is");
    EXPECT_REFUSED(skerry_echo_radar_set_scene(none, 0, &own, nullptr, 0), code, "radar is");
    EXPECT_REFUSED(skerry_echo_radar_spoke_time(none, 0, &time), code, "radar is");
    EXPECT_REFUSED(skerry_echo_radar_render(none, 0, 1, video.data(), kCells, kCells), code,
                   "radar is");
    EXPECT_REFUSED(skerry_echo_radar_get_state(none, &state), code, "radar is");
  };
  for (skerry_echo_radar* none : no_handles<skerry_echo_radar>()) {
    refused_everywhere(none);
    EXPECT_EQ(skerry_echo_radar_destroy(none), none ? SKERRY_ECHO_ERROR_HANDLE : SKERRY_ECHO_OK);
  }
  refused_everywhere(reinterpret_cast<skerry_echo_radar*>(static_cast<skerry_echo_coast*>(coast)));
  skerry_echo_radar* gone = nullptr;
  const auto options = small_options();
  ASSERT_OK(skerry_echo_radar_create(coast, &options, &gone));
  ASSERT_OK(skerry_echo_radar_destroy(gone));
  refused_everywhere(gone);
  EXPECT_EQ(skerry_echo_radar_destroy(gone), SKERRY_ECHO_ERROR_HANDLE);
  EXPECT_EQ(time, 7);
  EXPECT_THAT(video, testing::Each(0xA5));
}

}  // namespace
}  // namespace skerry::capi_test
