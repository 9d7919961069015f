// MSC.192(79) table 2: each target is seen at its range, clutter free, antenna 15 m, in 8 of 10
// scans or better with a probability of false alarm of 1e-4.  Cross-sections: SOURCES.md "Rules".
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <string>
#include <tuple>

#include "echo/radar/shipped_sets.hpp"
#include "tests/validation/table2_targets.hpp"
#include "tests/validation/target_trial.hpp"

namespace skerry::validation {
namespace {

constexpr std::uint32_t kScans = 200;

class Table2 : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(Table2, TargetIsSeenAtItsRange) {
  const auto [set_name, target_name] = GetParam();
  const echo::RadarSet set = echo::find_set(set_name);
  const Table2Target target = table2_target(target_name);
  const double range = nautical_miles(target.range_nm(set.band())).in_metres();
  TargetTrial trial({.set = set, .scale = scale_for(range)},
                    [&](echo::Scene& scene) { target.put(scene, range, 40.0); });
  const double seen = trial.detected(range, 40.0, kScans);
  std::printf("%-24s %-28s %5.1f NM: seen in %5.1f %% of %u scans\n", set_name.c_str(),
              target_name.c_str(), target.range_nm(set.band()), 100.0 * seen, kScans);
  EXPECT_GE(seen, 0.8);
}

INSTANTIATE_TEST_SUITE_P(Msc192, Table2,
                         ::testing::Combine(::testing::Values("25 kW X", "30 kW S"),
                                            ::testing::ValuesIn(table2_names())),
                         [](const auto& param) {
                           std::string name =
                               std::get<0>(param.param) + "_" + std::get<1>(param.param);
                           for (char& c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name;
                         });

TEST(FalseAlarms, AreOneInTenThousandAtTheGainOfTheTrials) {
  TargetTrial trial({.set = echo::find_set("25 kW X"), .scale = *RangeScale::find(12.0)},
                    [](echo::Scene&) {});
  const auto video = trial.video(0, 0, 2048);
  const auto on = std::count_if(video.begin(), video.end(), [](std::uint8_t v) { return v > 0; });
  const double share = static_cast<double>(on) / static_cast<double>(video.size());
  // 2.1e6 cells, correlated over the bandwidth: 210 expected, sd below 25.
  EXPECT_NEAR(share, 1e-4, 0.4e-4);
}

}  // namespace
}  // namespace skerry::validation
