#include "server/tracking/watch/association.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/tracking/watch/vectors.hpp"
#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::Optional;

// Own ship lies still; the target is 4 NM away, bearing 340, on course 090 at 10 kn
// (the scene of the tests of IEC 62388, 11.8, quoted at second hand).
MovingTarget at(PlanePoint off = {}, double course_deg = 90.0, double speed_kn = 10.0) {
  return {vector_of(340.0, 4.0 * kNm) + off, vector_of(course_deg, speed_kn * kKnot)};
}
MovingTarget without_motion(MovingTarget target) {
  target.motion_mps.reset();
  return target;
}

bool are_one(const MovingTarget& tracked, const MovingTarget& ais, const Partners& before = {},
             double widened = 1.0) {
  const std::vector<MovingTarget> ours{tracked}, theirs{ais};
  return associate(ours, theirs, before, {}, widened)[0].has_value();
}

const Partners kWereOne{std::size_t{0}};

// Of the four scenarios there only the third is known here; the others are what its criteria ask
// for.
TEST(Association, OneSamePlaceAndMotionIsOne) {
  EXPECT_TRUE(are_one(at(), at()));
  EXPECT_TRUE(are_one(at(), at({800.0, 0.0}, 100.0, 11.5)));
}

TEST(Association, TwoAnotherPlaceIsAnother) {
  EXPECT_FALSE(are_one(at(), at({1000.0, 0.0})));
  EXPECT_FALSE(are_one(at(), at({0.0, -1000.0})));
}

TEST(Association, ThreeTheSamePlaceOnTheOppositeCourseStaysTwo) {
  EXPECT_FALSE(are_one(at(), at({}, 270.0)));
  EXPECT_FALSE(are_one(at(), at({}, 270.0), {}, 3.0));  // however wide the gates are
  EXPECT_FALSE(are_one(at(), at({}, 106.0)));
  EXPECT_FALSE(are_one(at(), at({}, 90.0, 13.0)));
}

TEST(Association, FourWhatDivergesIsTwoOnlyBeyondAWiderGate) {
  for (const double off_m : {700.0, 1000.0, 1300.0}) {
    EXPECT_TRUE(are_one(at(), at({off_m, 0.0}), kWereOne)) << off_m;
  }
  EXPECT_FALSE(are_one(at(), at({1400.0, 0.0}), kWereOne));
  EXPECT_FALSE(are_one(at(), at({1000.0, 0.0})));  // and then does not come together at once
  EXPECT_TRUE(are_one(at(), at({}, 112.0), kWereOne));
  EXPECT_FALSE(are_one(at(), at({}, 113.0), kWereOne));
  EXPECT_TRUE(are_one(at(), at({}, 90.0, 12.9), kWereOne));
  EXPECT_FALSE(are_one(at(), at({}, 90.0, 13.1), kWereOne));
}

TEST(Association, AMarinerMayWidenTheGates) {
  EXPECT_FALSE(are_one(at(), at({2000.0, 0.0}), {}, 2.0));
  EXPECT_TRUE(are_one(at(), at({2000.0, 0.0}), {}, 3.0));
  EXPECT_TRUE(are_one(at(), at({}, 134.0), {}, 3.0));
  EXPECT_TRUE(are_one(at(), at({}, 157.0), kWereOne, 3.0));
  EXPECT_FALSE(are_one(at(), at({}, 158.0), kWereOne, 3.0));
}

TEST(Association, WhatIsBeingAcquiredIsPairedByItsPlaceAlone) {
  EXPECT_TRUE(are_one(without_motion(at()), at({}, 270.0)));
  EXPECT_FALSE(are_one(without_motion(at()), at({1000.0, 0.0})));
  EXPECT_TRUE(are_one(without_motion(at()), without_motion(at())));
  // AIS that tells no motion cannot agree with one that is known.
  EXPECT_FALSE(are_one(at(), without_motion(at()), kWereOne));
}

TEST(Association, WhatHardlyMovesHasNoCourseToCompare) {
  EXPECT_TRUE(are_one(at({}, 10.0, 0.4), at({}, 200.0, 1.0)));
  EXPECT_TRUE(are_one(at({}, 10.0, 0.4), at({}, 0.0, 0.0)));
  EXPECT_FALSE(are_one(at({}, 10.0, 0.4), at({}, 10.0, 3.0)));
}

TEST(Association, EachIsPairedOnceAndTheNearestFirst) {
  const std::vector<MovingTarget> tracked{at({300.0, 0.0}), at({0.0, 0.0}), at({-5000.0, 0.0})};
  const std::vector<MovingTarget> ais{at({20.0, 0.0}), at({500.0, 0.0}), at({-5100.0, 0.0})};
  EXPECT_THAT(associate(tracked, ais, {}, {}, 1.0),
              ElementsAre(Optional(1u), Optional(0u), Optional(2u)));
  // With one AIS target, the nearest tracked one has it.
  const std::vector<MovingTarget> one{at({200.0, 0.0})};
  EXPECT_THAT(associate(tracked, one, {}, {}, 1.0),
              ElementsAre(Optional(0u), std::nullopt, std::nullopt));
  // A pair stays one, though another is nearer by now.
  const Partners before{std::nullopt, std::size_t{0}, std::nullopt};
  EXPECT_THAT(associate(tracked, one, before, {}, 1.0),
              ElementsAre(std::nullopt, Optional(0u), std::nullopt));
}

TEST(Association, PartnersThatAreNoneAreLeftOut) {
  const std::vector<MovingTarget> tracked{at(), at({100.0, 0.0})}, ais{at()};
  const Partners twice{std::size_t{0}, std::size_t{0}};
  EXPECT_THAT(associate(tracked, ais, twice, {}, 1.0), ElementsAre(Optional(0u), std::nullopt));
  const Partners beyond{std::size_t{7}, std::nullopt, std::size_t{0}};
  EXPECT_THAT(associate(tracked, ais, beyond, {}, 1.0), ElementsAre(Optional(0u), std::nullopt));
  const double nan = std::nan("");
  EXPECT_FALSE(are_one(at(), at({nan, 0.0})));
  EXPECT_FALSE(are_one(at(), at({}, 90.0, nan)));
}

}  // namespace
}  // namespace skerry::server
