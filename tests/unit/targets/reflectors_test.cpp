#include "echo/targets/echo_parts.hpp"

#include <gtest/gtest.h>

namespace skerry::echo {
namespace {

TEST(Reflectors, AWireEchoesInProportionToItsRange) {
  EXPECT_NEAR(wire_cross_section(0.015, 2000.0) / wire_cross_section(0.015, 500.0), 4.0, 1e-12);
  // 94 m2 for 30 mm at 1 NM or so: the first zone's length sqrt(l R) times the width of a cylinder.
  EXPECT_NEAR(wire_cross_section(0.015, 2000.0), 94.25, 0.01);
}

}  // namespace
}  // namespace skerry::echo
