// What consoles of a relay have had done, as log and audit tell it.
#include "server/relay/passed_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/net/kept_audit.hpp"

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;

class PassedLogTest : public testing::Test {
 protected:
  PassedLogTest() { log_.set_audit(&audit_); }
  void turn(const std::string& origin, double gain, milliseconds at) {
    wire::Set set;
    set.set_gain(gain);
    log_.tell({"gain " + std::to_string(static_cast<int>(gain)), origin, {}, knob_of(set)},
              PassedLog::Time(at));
  }
  // "console a: gain 3 x 2"
  std::vector<std::string> told() const {
    std::vector<std::string> lines;
    for (const AuditEntry& entry : audit_.entries()) {
      lines.push_back(entry.from + ": " + entry.what.substr(entry.what.find(": ") + 2) + " x " +
                      std::to_string(entry.times));
    }
    return lines;
  }
  KeptAudit audit_;
  PassedLog log_{"bridge:7410"};
};

TEST_F(PassedLogTest, AKnobIsToldAtOnceAndThenHowOftenItWasTurned) {
  for (int i = 0; i < 5; ++i) turn("console a", 10 + i, milliseconds(100 * i));
  EXPECT_THAT(told(), ElementsAre("console a: gain 10 x 1"));
  log_.tell_late(PassedLog::Time(milliseconds(900)));
  EXPECT_EQ(told().size(), 1u);
  log_.tell_late(PassedLog::Time(milliseconds(1000)));
  EXPECT_THAT(told(), ElementsAre("console a: gain 10 x 1", "console a: gain 14 x 4"));
  log_.tell_late(PassedLog::Time(milliseconds(5000)));
  EXPECT_EQ(told().size(), 2u);
}

TEST_F(PassedLogTest, WhatIsNoKnobIsToldHoweverSoon) {
  turn("console a", 10, milliseconds(0));
  turn("console a", 11, milliseconds(10));
  wire::Set order;
  order.mutable_con()->set_take(true);
  EXPECT_EQ(knob_of(order), "");
  for (int i = 0; i < 2; ++i) {
    log_.tell({"con", "console a", {}, knob_of(order)}, PassedLog::Time(milliseconds(20)));
  }
  EXPECT_THAT(told(), ElementsAre("console a: gain 10 x 1", "console a: gain 11 x 1",
                                  "console a: con x 1", "console a: con x 1"));
}

TEST_F(PassedLogTest, EachIsToldOfWhoDidIt) {
  turn("console a", 10, milliseconds(0));
  turn("console a", 11, milliseconds(10));
  turn("console b", 12, milliseconds(20));
  EXPECT_THAT(told(), ElementsAre("console a: gain 10 x 1", "console a: gain 11 x 1",
                                  "console b: gain 12 x 1"));
}

TEST(KnobOf, NamesControlsAndTheirPlace) {
  wire::Set gain, other, course, locked;
  gain.set_gain(3);
  other.set_gain(7);
  EXPECT_EQ(knob_of(gain), knob_of(other));
  other.set_view(2);
  EXPECT_NE(knob_of(gain), knob_of(other));
  locked.set_gain(3);
  locked.add_lock("gain");
  EXPECT_EQ(knob_of(locked), "");
}

}  // namespace
}  // namespace skerry::server
