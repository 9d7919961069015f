#include "server/tracking/watch/zones.hpp"

#include <gtest/gtest.h>

#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {
namespace {

wire::TargetZone zone(std::uint32_t number, double inner_nm, double outer_nm, double from_deg,
                      double to_deg, bool relative = false,
                      wire::TargetZone::Kind kind = wire::TargetZone::ACQUIRES) {
  wire::TargetZone zone;
  zone.set_number(number);
  zone.set_kind(kind);
  zone.set_inner_nm(inner_nm);
  zone.set_outer_nm(outer_nm);
  zone.set_from_deg(from_deg);
  zone.set_to_deg(to_deg);
  zone.set_relative(relative);
  return zone;
}

ZoneTable::Mask in(const ZoneTable& zones, double range_nm, double bearing_deg,
                   std::optional<double> heading_deg = 0.0, ZoneTable::Mask before = 0) {
  return zones.zones_at(range_nm * kNm, bearing_deg, heading_deg, before);
}

TEST(Zones, AreSectorsOfRings) {
  ZoneTable zones;
  zones.put(zone(3, 2.0, 4.0, 350.0, 20.0));
  EXPECT_EQ(in(zones, 3.0, 0.0), 4u);
  EXPECT_EQ(in(zones, 3.0, 350.0), 4u);
  EXPECT_EQ(in(zones, 3.0, 20.0), 4u);
  EXPECT_EQ(in(zones, 3.0, 21.0), 0u);
  EXPECT_EQ(in(zones, 3.0, 349.0), 0u);
  EXPECT_EQ(in(zones, 1.9, 0.0), 0u);
  EXPECT_EQ(in(zones, 4.1, 0.0), 0u);
  EXPECT_EQ(in(zones, std::nan(""), 0.0), 0u);
}

TEST(Zones, EqualBearingsAreAllRound) {
  ZoneTable zones;
  zones.put(zone(1, 0.0, 1.0, 77.0, 77.0));
  zones.put(zone(2, 2.0, 3.0, 0.0, 360.0));
  for (double bearing = 0.0; bearing < 360.0; bearing += 7.0) {
    EXPECT_EQ(in(zones, 0.5, bearing), 1u);
    EXPECT_EQ(in(zones, 2.5, bearing), 2u);
  }
}

TEST(Zones, RelativeOnesTurnWithTheBow) {
  ZoneTable zones;
  zones.put(zone(1, 1.0, 2.0, 350.0, 10.0, true));
  EXPECT_EQ(in(zones, 1.5, 90.0, 90.0), 1u);
  EXPECT_EQ(in(zones, 1.5, 0.0, 90.0), 0u);
  EXPECT_EQ(in(zones, 1.5, 0.0, std::nullopt), 0u);
  EXPECT_TRUE(zones.areas(std::nullopt).empty());
  const auto areas = zones.areas(355.0);
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_NEAR(areas[0].from_deg, 345.0, 1e-9);
  EXPECT_NEAR(areas[0].to_deg, 5.0, 1e-9);
  EXPECT_NEAR(areas[0].inner_m, kNm, 1e-9);
}

TEST(Zones, WhatExcludesComesFirstAndHidesWhatItCovers) {
  ZoneTable zones;
  zones.put(zone(1, 0.0, 4.0, 0.0, 0.0));
  zones.put(zone(8, 1.0, 2.0, 0.0, 90.0, false, wire::TargetZone::EXCLUDES));
  const auto areas = zones.areas(0.0);
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_EQ(areas[0].acquire, Tracker::Acquire::none);
  EXPECT_EQ(areas[1].acquire, Tracker::Acquire::all);
  EXPECT_EQ(in(zones, 1.5, 45.0), 0u);
  EXPECT_EQ(in(zones, 1.5, 100.0), 1u);
}

TEST(Zones, WhatIsInOneLeavesItOnlyBeyondTheBorder) {
  ZoneTable zones;
  zones.put(zone(1, 2.0, 4.0, 0.0, 20.0));
  for (const double off_nm : {0.04, -0.04}) {  // 74 m
    EXPECT_EQ(in(zones, 4.0 + std::fabs(off_nm), 10.0), 0u);
    EXPECT_EQ(in(zones, 4.0 + std::fabs(off_nm), 10.0, 0.0, 1), 1u);
    EXPECT_EQ(in(zones, 2.0 - std::fabs(off_nm), 10.0, 0.0, 1), 1u);
  }
  EXPECT_EQ(in(zones, 3.0, 22.9, 0.0, 1), 1u);
  EXPECT_EQ(in(zones, 3.0, 357.1, 0.0, 1), 1u);
  EXPECT_EQ(in(zones, 3.0, 23.1, 0.0, 1), 0u);
  EXPECT_EQ(in(zones, 4.06, 10.0, 0.0, 1), 0u);
}

TEST(Zones, AreKeptByNumber) {
  ZoneTable zones;
  zones.put(zone(2, 0.0, 1.0, 0.0, 0.0));
  zones.put(zone(1, 0.0, 1.0, 0.0, 0.0));
  zones.put(zone(2, 0.0, 3.0, 0.0, 0.0));
  ASSERT_EQ(zones.all().size(), 2u);
  EXPECT_EQ(zones.all()[1].outer_nm(), 3.0);
  EXPECT_EQ(zones.take_laid(), 3u);
  EXPECT_EQ(zones.take_laid(), 0u);
  EXPECT_TRUE(zones.remove(2));
  EXPECT_FALSE(zones.remove(2));
  EXPECT_FALSE(zones.has(0));
  EXPECT_FALSE(zones.has(9));
  EXPECT_FALSE(zones.remove(9));
}

}  // namespace
}  // namespace skerry::server
