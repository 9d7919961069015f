#include "server/app/control/con_holders.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

wire::ConOrder take() {
  wire::ConOrder con;
  con.set_take(true);
  return con;
}

wire::ConOrder release() {
  wire::ConOrder con;
  con.set_release(true);
  return con;
}

TEST(ConHolders, AFreeShipTakesOrdersFromAnyone) {
  ConHolders cons(2);
  EXPECT_FALSE(cons.refusal(0, "Frida", nullptr, "a", false));
  wire::ConOrder wheel;
  wheel.set_rudder_deg(5.0);
  EXPECT_FALSE(cons.refusal(0, "Frida", &wheel, "b", false));
  EXPECT_FALSE(cons.change(0, wheel, "b"));
  EXPECT_EQ(cons.holder(0), "");
}

TEST(ConHolders, TheSecondIsToldWhoHasHer) {
  ConHolders cons(2);
  EXPECT_TRUE(cons.change(0, take(), "console A"));
  EXPECT_FALSE(cons.refusal(0, "Frida", nullptr, "console A", false));
  const wire::ConOrder second = take();
  EXPECT_EQ(
      cons.refusal(0, "Frida", &second, "console B", false),
      "console A has the con of Frida; ask for it to be given away, or take it as instructor");
  EXPECT_TRUE(cons.refusal(0, "Frida", nullptr, "console B", false)) << "course and speed too";
  EXPECT_FALSE(cons.refusal(1, "Ymer", &second, "console B", false)) << "the other ship";
}

TEST(ConHolders, IsHandedOverTakenByTheInstructorAndFreeAfterTheEnd) {
  ConHolders cons(1);
  cons.change(0, take(), "console A");
  EXPECT_TRUE(cons.change(0, release(), "console A"));
  EXPECT_TRUE(cons.change(0, take(), "console B"));
  const wire::ConOrder instructors = take();
  EXPECT_FALSE(cons.refusal(0, "Frida", &instructors, "console C", true));
  EXPECT_TRUE(cons.change(0, instructors, "console C"));
  EXPECT_TRUE(cons.leave("console B").empty());
  EXPECT_EQ(cons.holder(0), "console C");
  EXPECT_EQ(cons.leave("console C"), std::vector<std::size_t>{0});
  EXPECT_EQ(cons.holder(0), "");
}

TEST(ConHolders, BothAtOnceIsAnError) {
  const ConHolders cons(1);
  wire::ConOrder both = take();
  both.set_release(true);
  EXPECT_EQ(cons.refusal(0, "Frida", &both, "a", true),
            "con: taken and given away at once; expected one of the two");
}

}  // namespace
}  // namespace skerry::server
