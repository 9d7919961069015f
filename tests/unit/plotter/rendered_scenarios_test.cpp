// The four scenarios of A.823(19) on rendered video, in short; rendered_scenarios has 500
// runs of each.
#include <gtest/gtest.h>

#include "tests/unit/plotter/rendered_run.hpp"

namespace skerry::server {
namespace {

TEST(RenderedScenarios, ErrorsOfASetWhosePulseIsKnownAreWithinTheStandards) {
  const RenderedRadar radar;
  for (const StandardScenario& scenario : kStandardScenarios) {
    for (const std::uint64_t seed : {1u, 2u}) {
      const RenderedResult result =
          rendered_run(scenario, 3.0, seed, radar, rule_knowing_the_pulse(scenario, radar));
      ASSERT_EQ(result.track.size(), 6u);
      EXPECT_EQ(result.turns, 73);
      const auto limits = scenario.after_3_min.all();
      for (std::size_t k = 0; k < limits.size(); ++k) {
        if (limits[k] == 0.0) continue;
        EXPECT_LE(result.track[k], limits[k])
            << "scenario of " << scenario.range_nm << " NM and " << scenario.own_speed_kn
            << " kn, seed " << seed << ", " << k;
      }
    }
  }
}

// Learnt from her alone, the pulse would come out longer from turn to turn and her range drift by
// 10 to 20 m a minute: half a knot.
TEST(RenderedScenarios, AShipThatIsAloneDoesNotDriftWhileThePulseIsLearnt) {
  RenderedRadar radar;
  radar.errors = false;
  for (const std::size_t s : {0u, 1u}) {
    const RenderedResult result = rendered_run(kStandardScenarios[s], 3.0, 1, radar, rule_of_all());
    ASSERT_EQ(result.plots.size(), 73u);
    double early_m = 0.0, late_m = 0.0;  // a minute and a half lies between them
    for (std::size_t i = 0; i < 36; ++i) {
      early_m += result.plots[i].far_m / 36.0;
      late_m += result.plots[72 - i].far_m / 36.0;
    }
    EXPECT_LT(std::fabs(late_m - early_m), 6.0) << "scenario " << s + 1;
  }
}

// Of MSC.192 all but the true speed, which asks for as much as the log is wrong.
TEST(RenderedScenarios, ErrorsAreWithinBothStandardsWhileThePulseIsLearnt) {
  const RenderedRadar radar;
  for (const StandardScenario& scenario : kStandardScenarios) {
    const RenderedResult result = rendered_run(scenario, 3.0, 3, radar, rule_of_all());
    ASSERT_EQ(result.track.size(), 6u);
    const auto imo = scenario.after_3_min.all(), msc = msc192_after_3_min(scenario).all();
    for (std::size_t k = 0; k < imo.size(); ++k) {
      const double most = k == 5 ? imo[k] : imo[k] > 0.0 ? std::min(imo[k], msc[k]) : msc[k];
      EXPECT_LE(result.track[k], most) << scenario.own_speed_kn << " kn, " << k;
    }
  }
}

TEST(RenderedScenarios, APlotIsOffByLessThanTheStandardsGlintAndPulse) {
  RenderedRadar radar;
  radar.errors = false;
  for (const StandardScenario& scenario : kStandardScenarios) {
    const RenderedResult result =
        rendered_run(scenario, 1.0, 3, radar, rule_knowing_the_pulse(scenario, radar));
    ASSERT_EQ(result.plots.size(), 25u);
    double far = 0.0, far2 = 0.0;
    for (const PlotError& plot : result.plots) {
      far += plot.far_m / 25.0;
      far2 += plot.far_m * plot.far_m / 25.0;
    }
    // 30 m of glint and 20 m of the pulse; and of the mean a tenth of the hull.
    EXPECT_LT(far2 - far * far, 30.0 * 30.0 + 20.0 * 20.0);
    EXPECT_LT(std::fabs(far), 20.0);
  }
}

}  // namespace
}  // namespace skerry::server
