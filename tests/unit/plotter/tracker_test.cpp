#include "server/plotter/tracks/tracker.hpp"
#include <gtest/gtest.h>
#include <cstdio>
#include "tests/unit/plotter/made_plots.hpp"
namespace skerry::server {
namespace {
TEST(Tracker, Scratch) {
  MadeSea sea;
  sea.own = straight_way({0, 0}, 0, 10);
  sea.targets = {{straight_way({3000, 3000}, 270, 12)}, {straight_way({-2000, 5000}, 90, 20)}, {straight_way({-4000, -1000}, 0, 0)}};
  sea.false_a_turn = 20;
  Tracker tracker({.acquire = Tracker::Acquire::all});
  sail(sea, tracker, 0, 300, [&](double t) {
    std::printf("%6.1f", t);
    for (const Track& k : tracker.tracks()) {
      const double v = length_of(k.velocity_mps) * 3600 / 1852;
      const double c = std::atan2(k.velocity_mps.east_m, k.velocity_mps.north_m) * kDegreesPerRadian;
      std::printf(" | %u %5.0fm %5.1f %6.1f %5.2f s%.1f %.2f %d/%d", k.number, k.range_m, k.bearing.in_degrees(), c, v, k.place_sigma_m, k.velocity_sigma_mps, k.hits, k.looks);
    }
    std::printf("  f%zu\n", tracker.counts().followed);
  });
}
}  // namespace
}  // namespace skerry::server
