// The echo's rows and the schema of controls agree, and a new control is one line of schema and one
// row.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "echo/receiver/control_row.hpp"
#include "echo/scene/artefacts.hpp"
#include "protocol/signalk/control_table.hpp"
#include "protocol/video/range_scale.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/schema.hpp"
#include "server/app/control/control_ranges.hpp"
#include "server/net/http/controls_page.hpp"
#include "server/radar/control_values.hpp"
#include "tests/unit/app/extra_control.pb.h"

namespace skerry::server {
namespace {

using testing::Contains;
using testing::HasSubstr;
using wire::FieldDescriptor;

const wire::Descriptor& schema() { return *wire::Controls::descriptor(); }

template <typename Rows, typename Controls>
void expect_rows_as_in_schema(const Rows& rows, const Controls& defaults,
                              config::Control::Scope scope) {
  for (const auto& row : rows) {
    SCOPED_TRACE(row.name);
    const FieldDescriptor* field = schema().FindFieldByName(std::string(row.name));
    ASSERT_NE(field, nullptr);
    EXPECT_EQ(wire::control_of(*field).scope(), scope);
    const config::FieldRule& rule = wire::rule_of(*field);
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
      EXPECT_EQ(row.min, rule.min());
      EXPECT_EQ(row.max, rule.max());
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
      EXPECT_EQ(row.max, field->enum_type()->value_count() - 1);
    } else {
      EXPECT_EQ(field->cpp_type(), FieldDescriptor::CPPTYPE_BOOL);
      EXPECT_EQ(row.max, 1.0);
    }
    // Without a default the control is left to the set, which 0 stands for.
    EXPECT_EQ(row.get(defaults), rule.has_default_() ? rule.default_() : 0.0);
    EXPECT_EQ(row.or_zero, !rule.has_default_());
  }
}

TEST(ControlSchema, HasEveryRowOfTheEchoWithItsRangeAndDefault) {
  expect_rows_as_in_schema(echo::kViewControlRows, echo::ViewControls{}, config::Control::VIEW);
  expect_rows_as_in_schema(echo::kRadarControlRows, echo::RadarControls{}, config::Control::RADAR);
}

TEST(ControlSchema, HasNoControlWithoutARow) {
  std::set<std::string> rows = {"range_nm",
                                "blanked_sectors"};  // no numbers: the echo has types for them
  for (const auto& row : echo::kViewControlRows) rows.emplace(row.name);
  for (const auto& row : echo::kRadarControlRows) rows.emplace(row.name);
  std::set<std::string> fields;
  for (const FieldDescriptor* field : wire::fields_of(schema())) fields.insert(field->name());
  EXPECT_EQ(fields, rows);
}

TEST(ControlSchema, HasTheRangeScalesOfTheTable) {
  const auto& allowed = wire::rule_of(*schema().FindFieldByName("range_nm")).one_of();
  EXPECT_TRUE(std::equal(allowed.begin(), allowed.end(), RangeScale::kNauticalMiles.begin(),
                         RangeScale::kNauticalMiles.end()));
}

TEST(ControlSchema, HasEverySwitchOfArtefacts) {
  std::set<std::string> rows, fields;
  for (const auto& row : echo::kArtefactRows) {
    rows.emplace(row.name);
    EXPECT_TRUE(echo::Artefacts{}.*row.on) << row.name;
  }
  for (const FieldDescriptor* field : wire::fields_of(*wire::Artefacts::descriptor())) {
    fields.insert(field->name());
    EXPECT_EQ(wire::rule_of(*field).default_(), 1.0) << field->name();
  }
  EXPECT_EQ(fields, rows);
}

TEST(ControlSchema, SetHasControlsUnderTheirOwnNumbers) {
  int own = 0;
  for (const FieldDescriptor* field : wire::fields_of(schema())) {
    const FieldDescriptor* in_set = wire::Set::descriptor()->FindFieldByName(field->name());
    if (in_set == nullptr) continue;
    EXPECT_EQ(in_set->number(), field->number()) << field->name();
    EXPECT_EQ(in_set->type(), field->type()) << field->name();
    ++own;
  }
  EXPECT_EQ(own, 28);
}

// A new control: its line of schema is in extra_control.proto, and this is its row and its stage.
struct ExtraViewControls {
  double gain = 50.0, echo_trim_db = 0.0;
};
constexpr std::array kExtraRows = {
    echo::knob_row<&ExtraViewControls::gain>("gain"),
    echo::control_row<&ExtraViewControls::echo_trim_db>("echo_trim_db", -6.0, 6.0),
};
double trimmed(double power, const ExtraViewControls& controls) {
  return power * std::pow(10.0, controls.echo_trim_db / 10.0);
}

class NewControl : public testing::Test {
 protected:
  const wire::Descriptor& extra_ = *app_test::ExtraControls::descriptor();
  const FieldDescriptor& field_ = *extra_.FindFieldByName("echo_trim_db");
};

TEST_F(NewControl, ReachesItsStageFromAMessageAndIsToldBack) {
  app_test::ExtraSet set;
  set.set_gain(70.0);
  set.mutable_controls()->set_echo_trim_db(3.0);
  ExtraViewControls controls;
  ASSERT_TRUE(read_controls(kExtraRows, set, controls, extra_));
  EXPECT_EQ(controls.gain, 70.0);
  EXPECT_NEAR(trimmed(1.0, controls), 1.9953, 1e-4);

  app_test::ExtraSet told;
  write_controls(kExtraRows, controls, told, extra_);
  EXPECT_EQ(told.gain(), 70.0);
  EXPECT_EQ(told.controls().echo_trim_db(), 3.0);
  EXPECT_FALSE(told.controls().has_gain()) << "in its own field alone";
}

TEST_F(NewControl, IsRefusedOutOfItsRangeInWords) {
  app_test::ExtraSet set;
  set.mutable_controls()->set_echo_trim_db(6.5);
  const auto refusal = refusal_of_values(set, extra_);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_THAT(refusal->text(), HasSubstr("echo trim: 6.5 is out of range; allowed: -6 to 6 dB"));
  ExtraViewControls controls;
  EXPECT_FALSE(read_controls(kExtraRows, set, controls, extra_));
  set.mutable_controls()->set_echo_trim_db(-6.0);
  EXPECT_FALSE(refusal_of_values(set, extra_));
}

TEST_F(NewControl, IsToldToSignalKDisplaysAndTheConsole) {
  const wire::Descriptor& schema = *app_test::ExtraControls::descriptor();
  const auto definitions = signalk::definitions_of(schema);
  const auto found =
      std::find_if(definitions.begin(), definitions.end(),
                   [](const signalk::ControlDefinition& each) { return each.key == "echoTrim"; });
  ASSERT_NE(found, definitions.end());
  EXPECT_EQ(signalk::definition_document(*found).dump(),
            R"({"id":0,"name":"Echo trim","description":"Makes all echoes stronger or weaker",)"
            R"("category":"advanced","dataType":"number","minValue":-6,"maxValue":6,)"
            R"("stepValue":0.5,"hasAuto":false,"hasAutoAdjustable":false,"isReadOnly":false})");
  EXPECT_THAT(controls_page(schema, *wire::Artefacts::descriptor(), *wire::Faults::descriptor()),
              HasSubstr(R"({"name":"echoTrimDb","field":"echo_trim_db","number":39,)"
                        R"("type":"number","min":-6.0,"max":6.0,"default":0.0,"unit":"dB",)"
                        R"("step":0.5,"label":"Echo trim",)"
                        R"("title":"Makes all echoes stronger or weaker",)"
                        R"("panel":"processing","row":10,"lock":"processing"})"));
}

TEST_F(NewControl, CanBeLockedAndNamedOnACommandLine) {
  EXPECT_THAT(control_names(*app_test::ExtraSet::descriptor(), extra_), Contains("echo_trim_db"));
  EXPECT_EQ(wire::spoken_name(field_), "echo trim");
  EXPECT_EQ(wire::option_name(field_), "echo-trim");
  EXPECT_EQ(wire::control_of(field_).signalk(), "echoTrim");
  EXPECT_EQ(wire::allowed_by(wire::rule_of(field_)), "-6 to 6 dB");
}

}  // namespace
}  // namespace skerry::server
