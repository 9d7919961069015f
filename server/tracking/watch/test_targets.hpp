// TestTargets: eight targets without an echo, whose motion is known.
#pragma once

#include <array>
#include <cstdint>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

// In relative motion, so that what a display shows of CPA and TCPA can be checked whatever own ship
// does.  The first three move as those of the scenarios of A.823(19) do (the fourth there moves as
// the third).  After kTestTargetsLast they begin anew.
struct TestTarget {
  double range_nm, bearing_deg;  // when it begins
  double course_deg, speed_kn;   // relative to own ship
};

inline constexpr std::array<TestTarget, 8> kTestTargets{{
    {8.0, 0.0, 180.0, 20.0},
    {1.0, 0.0, 90.0, 10.0},
    {8.0, 45.0, 225.0, 20.0},
    {6.0, 60.0, 240.0, 12.0},
    {5.0, 300.0, 90.0, 15.0},   // passes 2.5 NM ahead
    {3.0, 200.0, 20.0, 8.0},    // overtakes
    {4.0, 120.0, 0.0, 0.0},     // keeps its place
    {2.0, 270.0, 270.0, 25.0},  // goes away
}};

inline constexpr std::uint32_t kFirstTestTarget = 1'000'001;  // a plotter never counts so far

inline constexpr Duration kTestTargetsLast = std::chrono::minutes(30);

struct TestTargetNow {
  PlanePoint place;         // from own ship, m
  PlanePoint relative_mps;  // to her
};
TestTargetNow test_target_at(const TestTarget& target, Duration since_begun);

}  // namespace skerry::server
