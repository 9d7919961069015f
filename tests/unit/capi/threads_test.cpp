// Several threads at the C interface.
#include <atomic>
#include <barrier>
#include <thread>

#include "tests/unit/capi/capi_support.hpp"

namespace skerry::capi_test {
namespace {

constexpr std::uint32_t kSpokes = 512, kCells = 256;

std::vector<std::uint8_t> turn_of(skerry_echo_chart* chart, std::uint64_t seed) {
  const Coast coast = coast_of(chart, seed);
  const Radar radar = radar_of(coast, small_options());
  EXPECT_OK(skerry_echo_radar_set_controls(radar, 3.0, 50.0, 20.0, 0.0));
  std::vector<std::uint8_t> video(kSpokes * kCells);
  for (std::uint32_t first = 0; first < kSpokes; first += 64) {
    skerry_echo_own_ship own = own_ship_at(kAfloat);
    own.latitude_deg += 1e-6 * first;
    std::int64_t time = 0;
    EXPECT_OK(skerry_echo_radar_spoke_time(radar, first, &time));
    EXPECT_OK(skerry_echo_radar_set_scene(radar, time, &own, nullptr, 0));
    EXPECT_OK(skerry_echo_radar_render(radar, first, 64, video.data() + first * kCells, 64 * kCells,
                                       kCells));
    int32_t land = -1;
    EXPECT_OK(skerry_echo_chart_is_land(chart, own.latitude_deg, own.longitude_deg, &land));
    EXPECT_EQ(land, 0);
  }
  return video;
}

TEST(CThreads, ShareAChartAndMakeTheVideoEachWouldAlone) {
  const Chart chart = chart_of(islands(nautical_miles(4.0), 40, 3));
  std::vector<std::vector<std::uint8_t>> alone, together(4);
  for (std::uint64_t seed = 0; seed < 4; ++seed) alone.push_back(turn_of(chart, seed));
  std::vector<std::thread> threads;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    threads.emplace_back([&, seed] { together[seed] = turn_of(chart, seed); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t seed = 0; seed < 4; ++seed) EXPECT_TRUE(together[seed] == alone[seed]) << seed;
  EXPECT_FALSE(alone[0] == alone[1]);
}

TEST(CThreads, AreRefusedAHandleThatAnotherUses) {
  const Chart chart = chart_of(islands(nautical_miles(4.0), 40, 3));
  const Coast coast = coast_of(chart);
  const Radar radar = radar_of(coast, small_options());
  const skerry_echo_own_ship own = own_ship_at(kAfloat);
  ASSERT_OK(skerry_echo_radar_set_scene(radar, 0, &own, nullptr, 0));
  std::vector<std::uint8_t> want(kSpokes * kCells);
  ASSERT_OK(skerry_echo_radar_render(radar, 0, kSpokes, want.data(), want.size(), kCells));

  // Each renders the same turn until it has been refused once and has succeeded once, or until the
  // other has.
  std::atomic<bool> refused{false};
  std::barrier start(2);
  const auto render = [&] {
    std::vector<std::uint8_t> video(kSpokes * kCells);
    start.arrive_and_wait();
    for (int i = 0; i < 1000 && !refused; ++i) {
      const int32_t result =
          skerry_echo_radar_render(radar, 0, kSpokes, video.data(), video.size(), kCells);
      if (result == SKERRY_ECHO_ERROR_BUSY) {
        refused = true;
        EXPECT_THAT(skerry_echo_last_error(), testing::HasSubstr("another thread"));
      } else {
        EXPECT_OK(result);
        EXPECT_TRUE(video == want);
      }
    }
  };
  std::thread one(render), other(render);
  one.join();
  other.join();
  EXPECT_TRUE(refused) << "two threads never met in 1000 turns";
  EXPECT_OK(skerry_echo_radar_render(radar, 0, 1, want.data(), want.size(), kCells));
}

TEST(CThreads, MayDestroyWhatOthersAreAboutToUse) {
  const Chart chart = chart_of(islands(nautical_miles(4.0), 5, 3));
  for (int round = 0; round < 200; ++round) {
    skerry_echo_coast* coast = nullptr;
    ASSERT_OK(skerry_echo_coast_create(chart, 1, &coast));
    std::barrier start(2);
    std::thread user([&] {
      start.arrive_and_wait();
      int32_t result = SKERRY_ECHO_OK;
      for (int i = 0; i < 50 && result != SKERRY_ECHO_ERROR_HANDLE; ++i) {
        result = skerry_echo_coast_set_guessing(coast, i % 2);
        EXPECT_THAT(result, testing::AnyOf(SKERRY_ECHO_OK, SKERRY_ECHO_ERROR_BUSY,
                                           SKERRY_ECHO_ERROR_HANDLE));
      }
    });
    start.arrive_and_wait();
    int32_t result = SKERRY_ECHO_ERROR_BUSY;
    while (result == SKERRY_ECHO_ERROR_BUSY) result = skerry_echo_coast_destroy(coast);
    EXPECT_OK(result);
    user.join();
    EXPECT_EQ(skerry_echo_coast_destroy(coast), SKERRY_ECHO_ERROR_HANDLE);
  }
}

}  // namespace
}  // namespace skerry::capi_test
