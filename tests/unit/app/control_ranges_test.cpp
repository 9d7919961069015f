// The bounds of a Set message.
#include "server/app/control/control_ranges.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace skerry::server {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using testing::HasSubstr;

std::string text_of(const wire::Set& set) {
  const auto reply = refusal_of(set);
  return reply ? reply->text() : "";
}

// Every double of a message and of those in it, each time as a Set that holds that one alone.
template <typename Visit>
void for_each_number(Visit visit) {
  const auto of = [&](auto make_inner, const Descriptor& type) {
    for (int i = 0; i < type.field_count(); ++i) {
      const FieldDescriptor& field = *type.field(i);
      if (field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) continue;
      const auto with = [&](double value) {
        wire::Set set;
        Message& inner = *make_inner(set);
        inner.GetReflection()->SetDouble(&inner, &field, value);
        return set;
      };
      visit(field, with);
    }
  };
  of([](wire::Set& set) -> Message* { return &set; }, *wire::Set::descriptor());
  of([](wire::Set& set) -> Message* { return set.mutable_blanked_sectors()->add_sectors(); },
     *wire::BlankedSectors::Sector::descriptor());
  of([](wire::Set& set) -> Message* { return set.mutable_world(); },
     *wire::WorldChange::descriptor());
  of([](wire::Set& set) -> Message* { return set.mutable_con(); }, *wire::ConOrder::descriptor());
  of([](wire::Set& set) -> Message* { return set.mutable_world()->add_rain(); },
     *wire::RainChange::descriptor());
}

TEST(ControlRanges, EveryNumberHasARange) {
  int numbers = 0;
  for_each_number([&](const FieldDescriptor& field, auto with) {
    ++numbers;
    for (const double value : {-1e9, 1e9, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()}) {
      const auto reply = refusal_of(with(value));
      ASSERT_TRUE(reply) << field.full_name() << " = " << value;
      EXPECT_EQ(reply->code(), wire::Reply::OUT_OF_RANGE) << field.full_name();
      EXPECT_THAT(reply->text(), HasSubstr("allowed: ")) << field.full_name();
    }
  });
  EXPECT_EQ(numbers, 46);
}

TEST(ControlRanges, BothEndsOfARangeAreAllowed) {
  wire::Set set;
  set.set_gain(0.0);
  set.set_echo_stretch(100.0);
  set.set_course_deg(360.0);
  set.set_speed_kn(-10.0);
  set.set_range_nm(0.125);
  set.mutable_world()->set_sea_state(6.0);
  set.mutable_world()->set_ducting(0.0);
  set.mutable_world()->set_k_factor(0.8);
  EXPECT_EQ(text_of(set), "");
}

TEST(ControlRanges, ARefusalNamesTheControlTheValueAndTheRange) {
  wire::Set set;
  set.set_interference_rejection(100.5);
  EXPECT_EQ(text_of(set), "interference rejection: 100.5 is out of range; allowed: 0 to 100");
  set.Clear();
  set.mutable_world()->set_swell_period_s(3.0);
  EXPECT_EQ(text_of(set), "swell period: 3 is out of range; allowed: 4 to 25 s");
  set.Clear();
  set.set_range_nm(5.0);
  EXPECT_EQ(text_of(set),
            "range: 5 NM is no range scale; allowed: 0.125, 0.25, 0.5, 0.75, 1.5, 3, "
            "6, 12, 24, 48, 72, 96");
  set.Clear();
  set.set_pulse(static_cast<wire::PulseChoice>(9));
  EXPECT_EQ(text_of(set), "pulse: 9 is out of range; allowed: 0 to 3");
}

TEST(ControlRanges, AnUnknownControlIsNamedWhereverItStands) {
  wire::Set set;
  set.set_gain(50.0);
  set.GetReflection()->MutableUnknownFields(&set)->AddVarint(77, 1);
  EXPECT_EQ(text_of(set), "Set: this server knows no control with field number 77");
  EXPECT_EQ(refusal_of(set)->code(), wire::Reply::UNKNOWN);
  set.Clear();
  wire::RainChange& rain = *set.mutable_world()->add_rain();
  rain.GetReflection()->MutableUnknownFields(&rain)->AddFixed64(40, 1);
  EXPECT_EQ(text_of(set), "RainChange: this server knows no control with field number 40");
}

TEST(ControlRanges, BlankedSectorsAreFourAtMost) {
  wire::Set set;
  for (int i = 0; i < 4; ++i) set.mutable_blanked_sectors()->add_sectors()->set_to_deg(10.0 * i);
  EXPECT_EQ(text_of(set), "");
  set.mutable_blanked_sectors()->add_sectors();
  EXPECT_EQ(text_of(set), "blanked sectors: 5 of them; allowed: at most 4");
}

TEST(ControlRanges, TwoOrdersToTheSameEndAreRefusedAndNoneSilentlyWins) {
  wire::Set set;
  set.set_speed_kn(8.0);
  set.mutable_con()->set_rudder_deg(5.0);
  EXPECT_EQ(text_of(set), "");
  set.mutable_con()->set_engine_percent(50.0);
  EXPECT_EQ(text_of(set), "engine: given together with an ordered speed; expected one of the two");
  EXPECT_EQ(refusal_of(set)->code(), wire::Reply::REFUSED);
  set.Clear();
  set.set_course_deg(90.0);
  set.mutable_con()->set_engine_percent(50.0);
  set.mutable_con()->set_turn_rate_deg_min(20.0);
  EXPECT_EQ(text_of(set), "");
  set.mutable_con()->set_steering(wire::STEERING_TRACK);
  EXPECT_EQ(text_of(set),
            "steering: given together with an ordered course; expected one of the two");
  set.mutable_con()->set_heading_deg(90.0);
  EXPECT_EQ(text_of(set),
            "heading: given together with an ordered course; expected one of the two");
  set.mutable_con()->set_rudder_deg(5.0);
  EXPECT_EQ(text_of(set), "rudder: given together with an ordered course; expected one of the two");
}

TEST(ControlRanges, OnlyTheInstructorLocksAndOnlyControls) {
  wire::Set set;
  set.add_lock("gain");
  EXPECT_EQ(text_of(set), "lock: only the instructor locks and unlocks controls");
  EXPECT_EQ(refusal_of(set)->code(), wire::Reply::REFUSED);
  set.set_instructor(true);
  set.add_unlock("world");
  EXPECT_EQ(text_of(set), "");
  for (const char* name : {"token", "radar", "instructor", "volume", ""}) {
    wire::Set other = set;
    other.add_unlock(name);
    EXPECT_THAT(text_of(other),
                HasSubstr("there is no control \"" + std::string(name) + "\"; allowed: course_deg"))
        << name;
    EXPECT_EQ(refusal_of(other)->code(), wire::Reply::UNKNOWN);
  }
}

TEST(ControlRanges, EveryControlOfASetMayBeLocked) {
  const std::vector<std::string> names = control_names();
  EXPECT_EQ(names.size(), 33u) << "a field of Set that changes nothing belongs to kNotControls";
  for (const std::string& name : names) EXPECT_TRUE(is_control(name)) << name;
}

}  // namespace
}  // namespace skerry::server
