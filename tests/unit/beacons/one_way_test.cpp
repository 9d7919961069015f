#include "echo/beacons/one_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/radar/antenna_pattern.hpp"
#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::model_at;

TEST(OneWayLink, IsTheFriisEquation) {
  // In decibels from the definition: EIRP + G - L/2 - 20 log10(4 pi R / lambda) - 10 log10(kTBF).
  const RadarModel model = model_at(6.0);
  const double path = 20.0 * std::log10(4.0 * M_PI * 9260.0 / model.set.wavelength_m());
  const double noise = 10.0 * std::log10(1.380649e-23 * 290.0 * model.pulse.bandwidth_hz) +
                       model.set.noise_figure_db;
  const double eirp = 10.0 * std::log10(4.0);
  const OneWayLink link(model);
  EXPECT_NEAR(10.0 * std::log10(link.received(4.0, 9260.0)), eirp + 31.0 - 1.5 - path - noise,
              1e-9);
  EXPECT_NEAR(10.0 * std::log10(link.sent_watts(9260.0)),
              10.0 * std::log10(25e3) + 31.0 - 1.5 - path, 1e-9);
}

TEST(OneWayLink, FallsAsTheSquareOfTheRange) {
  const OneWayLink link(model_at(12.0));
  for (double range = 20.0; range < 1e5; range *= 3.0) {
    const double slope = std::log(link.received(1.0, 2.0 * range) / link.received(1.0, range));
    EXPECT_NEAR(slope / std::log(2.0), -2.0, 1e-12);
    EXPECT_NEAR(link.sent_watts(10.0 * range) / link.sent_watts(range), 0.01, 1e-15);
  }
  EXPECT_EQ(link.received(1.0, 0.0), link.received(1.0, OneWayLink::kNearest));
}

TEST(BeamBound, IsNeverBelowThePattern) {
  for (const double width : {0.75, 1.2, 1.9, 5.2}) {
    RadarSet set;
    set.beam_width_deg = width;
    const AntennaPattern pattern(set);
    const BeamBound bound(set);
    for (std::uint64_t off = 0; off < (std::uint64_t{1} << 31); off += 40009) {
      const auto units = static_cast<std::uint32_t>(off);
      ASSERT_LE(pattern.one_way(units), bound.most(units) * 1.0001f)
          << width << " deg wide, " << units * (360.0 / 4294967296.0) << " deg off";
    }
  }
}

TEST(Sector, IsAsFarOffAsItsNearestSpoke) {
  const std::uint32_t degree = (1u << 31) / 180;
  const Sector ahead(0u - 2 * degree, 2 * degree);  // across the plane's north
  EXPECT_EQ(ahead.off(0), 0u);
  EXPECT_EQ(ahead.off(0u - degree), 0u);
  EXPECT_NEAR(ahead.off(5 * degree), 3.0 * degree, 2.0);
  EXPECT_NEAR(ahead.off(0u - 5 * degree), 3.0 * degree, 2.0);
  EXPECT_NEAR(ahead.off(1u << 31), 178.0 * degree, 200.0);
  const Sector back(10 * degree, 6 * degree);  // the ship turns faster than the antenna
  EXPECT_EQ(back.off(8 * degree), 0u);
  EXPECT_NEAR(back.off(12 * degree), 2.0 * degree, 2.0);
}

TEST(BehindLand, IsWhatLiesBelowTheShadow) {
  // A ridge hides 30 m from 5 km on, as seen from 20 m.
  const HiddenHeight ridge = [](std::uint32_t, double range) {
    return range < 5000.0 ? 0.0f : 30.0f;
  };
  const auto behind = [&](double range, double height, double known = 20e3) {
    return behind_land(ridge, {range, 0}, height, 20.0, 10.0, known);
  };
  EXPECT_FALSE(behind(4000.0, 1.0));
  EXPECT_TRUE(behind(6000.0, 29.0));
  EXPECT_FALSE(behind(6000.0, 31.0));
  EXPECT_FALSE(behind(5010.0, 1.0));  // the cells just before do not count
  // Beyond what is known the line from antenna over ridge goes on: 20 + 10 * 4.
  EXPECT_TRUE(behind(24020.0, 59.0, 6000.0));
  EXPECT_FALSE(behind(24020.0, 61.0, 6000.0));
  EXPECT_FALSE(behind_land({}, {6000.0, 0}, 0.0, 20.0, 10.0, 20e3));
}

}  // namespace
}  // namespace skerry::echo
