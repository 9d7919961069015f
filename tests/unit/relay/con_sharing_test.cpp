#include "server/relay/con_sharing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::server {
namespace {

constexpr char kYou[] = "console 10.0.0.1:4711";
const ConSharing::Time kNow{};

wire::Set con(bool take, bool release) {
  wire::Set set;
  if (take) set.mutable_con()->set_take(true);
  if (release) set.mutable_con()->set_release(true);
  return set;
}
std::string holder(ConSharing& cons, const std::string& told, ConSharing::Time now = kNow) {
  wire::ConState state;
  state.set_con(told);
  cons.tell("Tern", kYou, now, state);
  return state.con();
}

void grant(ConSharing& cons, const std::string& ship, const wire::Set& set,
           const std::string& origin) {
  cons.asked(ship, set, origin);
  cons.answered(ship, set, origin, true, kNow);
}

TEST(ConSharing, WhoHasItIsNamedInPlaceOfTheRelay) {
  ConSharing cons;
  EXPECT_EQ(holder(cons, "console x"), "console x");
  grant(cons, "Tern", con(true, false), "console a");
  EXPECT_EQ(holder(cons, kYou), "console a");
  EXPECT_EQ(holder(cons, ""), "console a");  // from before it was granted
  grant(cons, "Tern", con(false, true), "console a");
  EXPECT_EQ(holder(cons, ""), "");
}

TEST(ConSharing, ItIsGoneWhenTheOtherServerGivesItToSomebodyElse) {
  ConSharing cons;
  grant(cons, "Tern", con(true, false), "console a");
  EXPECT_EQ(holder(cons, "console x", kNow + std::chrono::seconds(10)), "console x");
  EXPECT_FALSE(cons.refusal("Tern", con(true, false), "console b"));
}

TEST(ConSharing, OthersHereAreRefusedAllButTheInstructor) {
  ConSharing cons;
  grant(cons, "Tern", con(true, false), "console a");
  EXPECT_FALSE(cons.refusal("Tern", con(true, false), "console a"));
  EXPECT_FALSE(cons.refusal("Gannet", con(true, false), "console b"));
  wire::Set order = con(true, false);
  EXPECT_TRUE(cons.refusal("Tern", order, "console b"));
  order.set_instructor(true);
  EXPECT_FALSE(cons.refusal("Tern", order, "console b"));
  wire::Set gain;
  gain.set_gain(3);
  EXPECT_FALSE(cons.refusal("Tern", gain, "console b"));
  wire::Set course;
  course.set_course_deg(3);
  EXPECT_TRUE(cons.refusal("Tern", course, "console b"));
}

TEST(ConSharing, WhoLeavesGivesItBack) {
  ConSharing cons;
  grant(cons, "Tern", con(true, false), "console a");
  grant(cons, "Gannet", con(true, false), "console b");
  EXPECT_THAT(cons.leave("console a"), testing::ElementsAre("Tern"));
  EXPECT_THAT(cons.leave("console a"), testing::IsEmpty());
  EXPECT_TRUE(cons.refusal("Gannet", con(true, false), "console a"));
  cons.begin_anew();
  EXPECT_FALSE(cons.refusal("Gannet", con(true, false), "console a"));
}

// To the other server both are one client, to whom it would grant it twice.
TEST(ConSharing, ItIsTakenByOneAtATime) {
  ConSharing cons;
  const wire::Set take = con(true, false);
  cons.asked("Tern", take, "console a");
  EXPECT_TRUE(cons.refusal("Tern", take, "console b"));
  EXPECT_TRUE(cons.refusal("Tern", take, "console a"));
  EXPECT_FALSE(cons.refusal("Gannet", take, "console b"));
  cons.answered("Tern", take, "console a", false, kNow);
  EXPECT_FALSE(cons.refusal("Tern", take, "console b"));
  EXPECT_EQ(holder(cons, ""), "");
}

TEST(ConSharing, WhatIsGrantedTooLateIsGivenBackUnlessSomebodyHasItOrAsksForIt) {
  const wire::Set take = con(true, false);
  ConSharing cons;
  cons.asked("Tern", take, "console a");
  EXPECT_FALSE(cons.answered("Tern", take, "console a", false, kNow));  // not in time
  EXPECT_TRUE(cons.granted_late("Tern"));
  // It would be taken from who has it.
  grant(cons, "Tern", take, "console b");
  EXPECT_FALSE(cons.granted_late("Tern"));
  cons.leave("console b");
  // Or from who is about to have it.
  cons.asked("Tern", take, "console b");
  EXPECT_FALSE(cons.granted_late("Tern"));
  EXPECT_FALSE(cons.answered("Tern", take, "console b", true, kNow));
  EXPECT_EQ(holder(cons, kYou), "console b");
  cons.leave("console b");
  // Who then does not get it.
  cons.asked("Tern", take, "console c");
  EXPECT_FALSE(cons.granted_late("Tern"));
  EXPECT_TRUE(cons.answered("Tern", take, "console c", false, kNow));
  cons.asked("Tern", take, "console c");
  EXPECT_FALSE(cons.answered("Tern", take, "console c", false, kNow));
}

}  // namespace
}  // namespace skerry::server
