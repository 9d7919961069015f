#include "server/app/load_estimate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <time.h>

#include <cmath>
#include <vector>

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::Not;

double cpu_s() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// A trial of two radars that make 100 sectors a second each and leave out some, while the process
// uses a twentieth of the time that it is given.
TEST(LoadEstimate, IsOfTheTrialWithoutItsBegin) {
  std::vector<RadarPace> radars(2);
  std::vector<milliseconds> waits;
  const LoadEstimate load = estimate_load([&] { return radars; },
                                          [&](milliseconds time) {
                                            waits.push_back(time);
                                            const double end =
                                                cpu_s() + static_cast<double>(time.count()) / 20e3;
                                            while (cpu_s() < end) {
                                            }
                                            radars[0].sectors += time.count() / 10;
                                            radars[1].sectors += time.count() / 10;
                                            radars[1].skipped += time.count() / 20;
                                          });
  EXPECT_EQ(waits, (std::vector{kBefore, kTrial}));
  EXPECT_GE(load.cpu_s, 0.15);
  EXPECT_LT(load.cpu_s, 0.2) << "the begin is not counted";
  EXPECT_EQ(load.sectors, 600u);
  EXPECT_EQ(load.skipped, 150u);
  EXPECT_GE(load.cores, 1u);
}

TEST(LoadEstimate, WhatFitsIsGood) {
  const LoadEstimate load{.cpu_s = 3.0, .ran_s = 3.0, .sectors = 900, .skipped = 0, .cores = 2};
  EXPECT_DOUBLE_EQ(load.needed_cores(), 1.0);
  EXPECT_FALSE(load.is_too_much());
  EXPECT_EQ(load.text(), "in 3 s its radars and its world took 1.00 of 2 cores");
}

TEST(LoadEstimate, TooMuchIsSaidWithWhatWouldHelp) {
  const LoadEstimate full{.cpu_s = 4.5, .ran_s = 3.0, .sectors = 900, .skipped = 0, .cores = 2};
  EXPECT_TRUE(full.is_too_much()) << "three quarters of the cores";
  EXPECT_THAT(full.text(), HasSubstr("Above 70 % sectors are left out: fewer spokes"));
  EXPECT_THAT(full.text(), Not(HasSubstr("would be needed")));
  const LoadEstimate over{.cpu_s = 6, .ran_s = 3, .sectors = 5000, .skipped = 4900, .cores = 2};
  EXPECT_DOUBLE_EQ(over.needed_cores(), 100.0);
  EXPECT_THAT(over.text(), HasSubstr("98 % of the sectors were left out, for all some 100 cores"));
  const LoadEstimate none{.cpu_s = 6, .ran_s = 3, .sectors = 50, .skipped = 50, .cores = 2};
  EXPECT_TRUE(std::isinf(none.needed_cores()));
  EXPECT_TRUE(none.is_too_much());
  EXPECT_THAT(none.text(),
              HasSubstr("100 % of the sectors were left out, for all many more cores"));
}

}  // namespace
}  // namespace skerry::server
