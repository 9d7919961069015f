// What hosts of a fleet share of controls: which part of a Set, and all that orders have changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "server/app/control/control_desk.hpp"
#include "server/app/options/radar_config.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {
namespace {

class SharedControls : public testing::Test {
 protected:
  SharedControls()
      : scenario_(parse_scenario("name: s\nown_ships:\n  - {name: F, position: {lat: 60, lon: 5}, "
                                 "radars: [{range_nm: 6}]}\n",
                                 "f")),
        timeline_(World(scenario_)),
        coast_(std::make_unique<OpenSea>(), 1, {}),
        airwaves_(1),
        unit_(radar_config(scenario_.own_ships(0).radars(0), 0, 0, 1), timeline_, coast_, airwaves_,
              0),
        desk_(timeline_, {&unit_}, {}, ChangeLog([](const std::string&) {})) {}

  static wire::Set of_view(std::uint32_t view) {
    wire::Set set;
    set.set_view(view);
    return set;
  }

  scenario::Scenario scenario_;
  Timeline timeline_;
  CoastService coast_;
  Airwaves airwaves_;
  RadarUnit unit_;
  ControlDesk desk_;
};

TEST_F(SharedControls, OfTheSharedViewEverythingIs) {
  wire::Set set = of_view(0);
  set.set_gain(70);
  set.set_token("secret");
  const auto shared = desk_.parts_of(set).shared;
  ASSERT_TRUE(shared);
  EXPECT_EQ(shared->gain(), 70);
  EXPECT_EQ(shared->token(), "") << "no token is written to a log";
}

TEST_F(SharedControls, OfAnOwnViewOnlyWhatIsMoreThanTheView) {
  const auto view = unit_.views().open(0, false, [](VideoChannel&) {})->number;
  wire::Set set = of_view(view);
  set.set_gain(70);
  set.set_range_nm(3);
  EXPECT_FALSE(desk_.parts_of(set).shared);
  EXPECT_TRUE(desk_.parts_of(set).own);
  for (const auto& change : std::vector<void (*)(wire::Set&)>{
           [](wire::Set& s) { s.set_transmit(false); }, [](wire::Set& s) { s.set_transmit(true); },
           [](wire::Set& s) { s.set_rotation_rpm(30); },
           [](wire::Set& s) { s.set_antenna_height_m(20); },
           [](wire::Set& s) { s.set_bearing_alignment_deg(0); },
           [](wire::Set& s) { s.mutable_blanked_sectors(); },
           [](wire::Set& s) { s.set_course_deg(10); }, [](wire::Set& s) { s.set_speed_kn(1); },
           [](wire::Set& s) { s.mutable_con(); }, [](wire::Set& s) { s.mutable_world(); },
           [](wire::Set& s) { s.mutable_exercise(); }, [](wire::Set& s) { s.add_lock("gain"); },
           [](wire::Set& s) { s.add_unlock("gain"); }}) {
    wire::Set more = set;
    change(more);
    const ControlDesk::Parts parts = desk_.parts_of(more);
    ASSERT_TRUE(parts.shared && parts.own) << more.ShortDebugString();
    EXPECT_EQ(parts.shared->view(), 0u) << "there is no such view on other hosts";
    EXPECT_FALSE(parts.shared->has_gain());
    EXPECT_FALSE(parts.shared->has_range_nm());
    EXPECT_EQ(parts.own->SerializeAsString(), set.SerializeAsString());
  }
}

TEST_F(SharedControls, OfAViewThatFollowsTheSharedOneItIsThatOnes) {
  const auto view = unit_.views().open(0, true, [](VideoChannel&) {})->number;
  wire::Set set = of_view(view);
  set.set_gain(70);
  set.set_instrumented_range_m(8000);
  const ControlDesk::Parts parts = desk_.parts_of(set);
  ASSERT_TRUE(parts.shared && parts.own);
  EXPECT_EQ(parts.shared->view(), 0u);
  EXPECT_EQ(parts.shared->gain(), 70);
  EXPECT_FALSE(parts.shared->has_instrumented_range_m());
  EXPECT_EQ(parts.own->view(), view);
  EXPECT_FALSE(parts.own->has_gain());
  EXPECT_EQ(parts.own->instrumented_range_m(), 8000);
  wire::Set own = of_view(view);
  own.set_instrumented_range_m(8000);
  EXPECT_FALSE(desk_.parts_of(own).shared);
}

TEST_F(SharedControls, WhatWouldBeRefusedIsToldWithoutAChange) {
  wire::Set set = of_view(0);
  set.set_gain(170);
  EXPECT_EQ(desk_.refusal_now(set, "x")->code(), wire::Reply::OUT_OF_RANGE);
  set.set_gain(70);
  EXPECT_FALSE(desk_.refusal_now(set, "x"));
  EXPECT_EQ(desk_.settings(0, 0).gain(), 50.0);
}

TEST_F(SharedControls, AllThatOrdersChangedComesBack) {
  const ControlDesk::Kept kept = desk_.kept();
  wire::Set set = of_view(0);
  set.set_gain(70);
  set.set_range_nm(12);
  set.set_transmit(false);
  set.set_instructor(true);
  set.add_lock("rain");
  ASSERT_EQ(desk_.apply(set, "x").code(), wire::Reply::OK);
  desk_.restore(kept);
  EXPECT_EQ(desk_.settings(0, 0).gain(), 50.0);
  EXPECT_EQ(desk_.settings(0, 0).range_nm(), 6.0);
  EXPECT_FALSE(desk_.settings(0, 0).standby());
  EXPECT_TRUE(desk_.settings(0, 0).locked().empty());
}

}  // namespace
}  // namespace skerry::server
