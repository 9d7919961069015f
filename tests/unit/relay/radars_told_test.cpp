// Which servers can be relayed.
#include "server/relay/radars_told.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/relay/other_server.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

std::string why_not(const wire::Hello& hello) {
  return why_not_relayed(hello, "the relay", "192.0.2.7:7410").value_or("");
}

TEST(RadarsTold, AServerAndARelayOfItCanBeRelayed) {
  wire::Hello hello = hello_of(2);
  EXPECT_EQ(why_not(hello), "");
  hello.add_relays()->set_identity("the origin");
  EXPECT_EQ(why_not(hello), "");
}

TEST(RadarsTold, LoopsAndLongRowsAreRefused) {
  EXPECT_THAT(why_not(hello_of(1, "the relay")), HasSubstr("is this server itself"));
  wire::Hello loop = hello_of(1, "another");
  loop.add_relays()->set_identity("a third");
  loop.add_relays()->set_identity("the relay");
  EXPECT_THAT(why_not(loop), HasSubstr("a loop"));
  wire::Hello row = hello_of(1, "another");
  for (int i = 0; i < kMostHops - 1; ++i) row.add_relays()->set_identity(std::to_string(i));
  EXPECT_EQ(why_not(row), "");
  row.add_relays()->set_identity("one more");
  EXPECT_THAT(why_not(row), HasSubstr("at most 8"));
}

TEST(RadarsTold, RadarsMustBeAsHere) {
  EXPECT_THAT(why_not(hello_of(0)), HasSubstr("has no radars"));
  EXPECT_THAT(why_not(hello_of(kMostRadars + 1)), HasSubstr("at most 256"));
  wire::Hello gap = hello_of(2);
  gap.mutable_radars(1)->set_radar(5);
  EXPECT_THAT(why_not(gap), HasSubstr("are not numbered 0 to 1"));
  wire::Hello scales = hello_of(1);
  scales.set_range_scales_nm(3, 7.5);
  EXPECT_THAT(why_not(scales), HasSubstr("other range scales"));
}

TEST(RadarsTold, NumbersAreBroughtIntoRange) {
  wire::Hello hello = hello_of(1);
  hello.mutable_radars(0)->set_spokes_per_turn(4'000'000'000u);
  hello.mutable_radars(0)->set_cells(1);
  hello.mutable_radars(0)->set_bits(77);
  hello.mutable_radars(0)->set_rpm(1e12);
  hello.mutable_radars(0)->set_board(true);
  const auto radars = radars_of(hello);
  EXPECT_EQ(radars[0].spokes_per_turn(), 8192u);
  EXPECT_EQ(radars[0].cells(), 128u);
  EXPECT_EQ(radars[0].bits(), 8u);
  EXPECT_LE(radars[0].rpm(), 1000);
  EXPECT_FALSE(radars[0].board());
}

TEST(RadarsTold, ChangesAreTold) {
  const auto before = radars_of(hello_of(2));
  EXPECT_EQ(changes_told(before, before), "");
  EXPECT_THAT(changes_told(before, radars_of(hello_of(3))), HasSubstr("radar 2 is new"));
  EXPECT_THAT(changes_told(before, radars_of(hello_of(5))), HasSubstr("radars 2 to 4 are new"));
  EXPECT_THAT(changes_told(before, radars_of(hello_of(1))),
              HasSubstr("radar 1, 'radar 1' on Tern, is gone: these are not relayed"));
}

}  // namespace
}  // namespace skerry::server
