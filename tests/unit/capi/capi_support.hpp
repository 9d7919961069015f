// Shared by the tests of the C interface: owners of handles, and a chart of made-up islands that
// the interface and the C++ chain make alike.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <skerry_echo.h>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::capi_test {

inline constexpr GeoPoint kAfloat{60.27, 5.15};
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline int32_t destroy(skerry_echo_chart* chart) { return skerry_echo_chart_destroy(chart); }
inline int32_t destroy(skerry_echo_coast* coast) { return skerry_echo_coast_destroy(coast); }
inline int32_t destroy(skerry_echo_radar* radar) { return skerry_echo_radar_destroy(radar); }

// Owns a handle; what a create call writes to.
template <typename Object>
class Owner {
 public:
  Owner() = default;
  Owner(Owner&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owner& operator=(Owner&&) = delete;
  ~Owner() { EXPECT_EQ(destroy(handle_), SKERRY_ECHO_OK) << skerry_echo_last_error(); }
  Object** out() { return &handle_; }
  operator Object*() const { return handle_; }  // NOLINT: tests read like the C they stand for
  void destroy_now() { EXPECT_EQ(destroy(std::exchange(handle_, nullptr)), SKERRY_ECHO_OK); }

 private:
  Object* handle_ = nullptr;
};
using Chart = Owner<skerry_echo_chart>;
using Coast = Owner<skerry_echo_coast>;
using Radar = Owner<skerry_echo_radar>;

#define EXPECT_OK(call) EXPECT_EQ((call), SKERRY_ECHO_OK) << skerry_echo_last_error()
#define ASSERT_OK(call) ASSERT_EQ((call), SKERRY_ECHO_OK) << skerry_echo_last_error()
// Refused with that code and a text that has `word` in it.
#define EXPECT_REFUSED(call, code, word)                             \
  do {                                                               \
    EXPECT_EQ((call), (code)) << skerry_echo_last_error();           \
    EXPECT_THAT(skerry_echo_last_error(), testing::HasSubstr(word)); \
  } while (false)

// Islands around kAfloat within `radius`, land on the left, vertices on the grid of 1e-7 deg.
struct Rings {
  std::vector<skerry_echo_position> vertices;
  std::vector<std::size_t> sizes;
};
Rings islands(Length radius, int count, std::uint64_t seed);

// Those rings as the interface takes them, and as a CoastChart of its own.
Chart chart_of(const Rings& rings);
echo::CoastChart coast_chart_of(const Rings& rings, GeoPoint centre, double radius_m);

// Whether a GSHHG shoreline is installed (Debian: gmt-gshhg-full).
bool world_installed();
int32_t open_chart(const std::string& path, Chart& chart);

Coast coast_of(skerry_echo_chart* chart, std::uint64_t seed = 1);
skerry_echo_radar_options small_options();  // 512 spokes of 256 cells
Radar radar_of(skerry_echo_coast* coast, const skerry_echo_radar_options& options);
skerry_echo_own_ship own_ship_at(GeoPoint place);
skerry_echo_target target_at(GeoPoint place, std::uint64_t identity);

// Values given as handles that are none: other objects' addresses, small and large numbers.
template <typename Object>
std::vector<Object*> no_handles() {
  static std::uint64_t room[8] = {};
  return {nullptr,
          reinterpret_cast<Object*>(&room),
          reinterpret_cast<Object*>(std::uintptr_t{2}),
          reinterpret_cast<Object*>(UINTPTR_MAX),
          reinterpret_cast<Object*>(UINTPTR_MAX - 1),
          reinterpret_cast<Object*>(std::uintptr_t{1} << 30 | 1)};
}

}  // namespace skerry::capi_test
