#include "echo/receiver/controls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace skerry::echo {
namespace {

TEST(Controls, OrdinaryOnesHaveNoFault) {
  EXPECT_FALSE(fault_of(RadarControls{}));
  EXPECT_FALSE(fault_of(ViewControls{}));
  EXPECT_FALSE(fault_of(ViewControls{.gain = 0.0, .sea = 100.0, .rain = 100.0}));
}

TEST(Controls, EachOutsideItsRangeIsNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double wrong : {-0.001, 100.001, 1e300, nan}) {
    const auto named = [&](const char* name, double ViewControls::*control) {
      ViewControls controls;
      controls.*control = wrong;
      const auto fault = fault_of(controls);
      ASSERT_TRUE(fault) << name;
      EXPECT_EQ(fault->find(name), 0u) << *fault;
      EXPECT_NE(fault->find("0 and 100"), std::string::npos) << *fault;
    };
    named("gain", &ViewControls::gain);
    named("sea", &ViewControls::sea);
    named("rain", &ViewControls::rain);
    named("interference_rejection", &ViewControls::interference_rejection);
    named("echo_stretch", &ViewControls::echo_stretch);
    named("integration", &ViewControls::integration);
    const auto fault = fault_of(RadarControls{.tune = wrong});
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->find("tune"), 0u);
  }
}

// SOURCES.md "Receiver": loss (f - f0)^2.
TEST(Controls, TuningLosesWithTheSquareOfWhatItIsOff) {
  EXPECT_EQ(tune_loss_db({.tune_auto = true, .tune = 3.0}), 0.0);
  const auto by_hand = [](double tune) { return tune_loss_db({.tune_auto = false, .tune = tune}); };
  EXPECT_EQ(by_hand(50.0), 0.0);
  EXPECT_EQ(by_hand(30.0), by_hand(70.0));
  EXPECT_NEAR(by_hand(70.0) / by_hand(60.0), 4.0, 1e-9);
  // Half a bandwidth off is 3 dB.
  EXPECT_NEAR(by_hand(50.0 + 50.0 * 0.5 / kTuningSpan), 3.0, 1e-9);
}

}  // namespace
}  // namespace skerry::echo
