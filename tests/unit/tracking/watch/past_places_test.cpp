#include "server/tracking/watch/past_places.hpp"

#include <gtest/gtest.h>

#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {
namespace {

// A target that goes north over ground, and east from own ship.
WasAt place_at(double t) { return {{50.0 + 1e-5 * t, 3.0}, {10.0 * t, 0.0}}; }

PastPlaces sailed(double seconds) {
  PastPlaces past;
  for (double t = 0.0; t <= seconds; t += 0.5) past.add(utc_at(t), place_at(t));
  return past;
}

TEST(PastPlaces, AreEvenlyApartAndTheNewestFirst) {
  const PastPlaces past = sailed(1000.0);
  const auto told = past.told(utc_at(1000.0), std::chrono::seconds(120));
  ASSERT_EQ(told.size(), 9u);  // at 960, 840 ... 0 s
  for (std::size_t k = 0; k < told.size(); ++k) {
    const WasAt was = place_at(960.0 - 120.0 * static_cast<double>(k));
    EXPECT_NEAR(told[k].place.latitude_deg, was.place.latitude_deg, 1e-9);
    EXPECT_NEAR(told[k].from_own_ship.east_m, was.from_own_ship.east_m, 1e-6);
  }
}

TEST(PastPlaces, StayWhereTheyAreAsTimeGoesOn) {
  PastPlaces past = sailed(300.0);
  const auto before = past.told(utc_at(300.0), std::chrono::seconds(60));
  for (double t = 300.5; t < 360.0; t += 0.5) {
    past.add(utc_at(t), place_at(t));
    const auto now = past.told(utc_at(t), std::chrono::seconds(60));
    ASSERT_EQ(now.size(), before.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      EXPECT_NEAR(now[k].place.latitude_deg, before[k].place.latitude_deg, 1e-9);
    }
  }
}

TEST(PastPlaces, TenAreToldAtEveryIntervalThereIs) {
  const PastPlaces past = sailed(4500.0);
  for (const int seconds : {15, 16, 60, 120, 359, 360}) {
    EXPECT_EQ(past.told(utc_at(4500.0), std::chrono::seconds(seconds)).size(), PastPlaces::kTold)
        << seconds;
  }
  EXPECT_TRUE(past.told(utc_at(4500.0), Duration(0)).empty());
  EXPECT_TRUE(PastPlaces{}.told(utc_at(0.0), std::chrono::seconds(60)).empty());
}

TEST(PastPlaces, GoOverTheDateLine) {
  PastPlaces past;
  for (double t = 0.0; t <= 100.0; t += 10.0) {
    past.add(utc_at(t), {{0.0, wrapped_longitude(179.9975 + 5e-5 * t)}, {}});
  }
  for (const WasAt& was : past.told(utc_at(100.0), std::chrono::seconds(15))) {
    EXPECT_GT(std::fabs(was.place.longitude_deg), 179.99);
  }
}

}  // namespace
}  // namespace skerry::server
