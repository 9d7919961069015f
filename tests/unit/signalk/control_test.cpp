// Controls: what displays are told of them, and what they may say of a change.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <set>
#include <string>

#include "protocol/signalk/control_value.hpp"

namespace skerry::signalk {
namespace {

using testing::HasSubstr;

Result<ControlChange, std::string> read(const char* key, const char* body) {
  const auto json = read_json(body);
  if (!json) return Failure{std::string("not JSON")};
  return read_change(*json, *find_control(key));
}

TEST(ControlTable, KeysAndIdsAreOfTheirOwnAndEveryDefinitionIsWhole) {
  std::set<std::string> keys;
  std::set<int> ids;
  const std::set<std::string> categories = {"base",     "targets",      "guardZones", "trails",
                                            "advanced", "installation", "info"};
  for (const ControlDefinition& each : control_definitions()) {
    EXPECT_TRUE(keys.insert(each.key).second) << each.key;
    EXPECT_TRUE(ids.insert(each.id).second) << each.key;
    EXPECT_TRUE(categories.contains(each.category)) << each.key;
    const Json document = definition_document(each);
    for (const char* member : {"id", "name", "description", "category", "dataType", "hasAuto",
                               "hasAutoAdjustable", "isReadOnly"}) {
      EXPECT_TRUE(document.contains(member)) << each.key << " " << member;
    }
    if (each.kind == ControlKind::text) continue;
    EXPECT_LT(each.min, each.max) << each.key;
    EXPECT_GT(each.step, 0.0) << each.key;
  }
  for (const char* base : {"power", "range", "gain", "sea", "rain"}) {
    ASSERT_NE(find_control(base), nullptr);
    EXPECT_EQ(find_control(base)->category, "base") << base;
  }
}

TEST(ControlTable, TheRangeIsOneOfTheTwelveRangeScalesInMetres) {
  const Json range = definition_document(*find_control("range"));
  EXPECT_EQ(range["dataType"], "number");
  EXPECT_EQ(range["units"], "m");
  EXPECT_EQ(range["validValues"].dump(),
            "[232,463,926,1389,2778,5556,11112,22224,44448,88896,133344,177792]");
  EXPECT_EQ(range["descriptions"]["5556"], "3 NM");
}

TEST(ControlTable, PowerCanBePutToStandbyAndTransmitOnly) {
  const Json power = definition_document(*find_control("power"));
  EXPECT_EQ(power["dataType"], "enum");
  EXPECT_EQ(power["validValues"].dump(), "[1,2]");
  EXPECT_EQ(power["descriptions"]["2"], "Transmit");
}

TEST(ControlChange, IsReadFromEveryFormThatDisplaysUse) {
  EXPECT_EQ(read("gain", R"({"value":50})")->value, 50.0);
  EXPECT_EQ(read("gain", R"({"value":"50"})")->value, 50.0);
  EXPECT_EQ(read("gain", "50")->value, 50.0);
  EXPECT_EQ(read("gain", R"({"auto":true})")->automatic, true);
  EXPECT_EQ(read("gain", R"({"auto":true})")->value, std::nullopt);
  const auto both = read("gain", R"({"auto":false,"value":33.5,"autoValue":-3,"more":[1]})");
  ASSERT_TRUE(both.ok());
  EXPECT_EQ(both->automatic, false);
  EXPECT_EQ(both->value, 33.5);
  EXPECT_EQ(read("gain", R"({"value":{"auto":false,"value":20}})")->value, 20.0);
  // Displays send "auto": false with everything.
  for (const ControlDefinition& each : control_definitions()) {
    if (each.kind == ControlKind::text || each.kind == ControlKind::sector) continue;
    const double value = each.choices.empty() ? each.max : each.choices[1].value;
    const auto change = read_change({{"auto", false}, {"value", value}}, each);
    ASSERT_TRUE(change.ok()) << each.key << ": " << change.error();
    EXPECT_EQ(change->value, value) << each.key;
    EXPECT_EQ(change->automatic, each.has_auto ? std::optional(false) : std::nullopt) << each.key;
  }
  EXPECT_EQ(read("gain", R"({"mode":"auto","value":50})")->automatic, true);
  EXPECT_EQ(read("gain", R"({"mode":"manual","value":50})")->automatic, false);
  EXPECT_EQ(read("power", R"({"value":"transmit"})")->value, kPowerTransmit);
  EXPECT_EQ(read("power", R"({"value":1})")->value, kPowerStandby);
  EXPECT_EQ(read("targetExpansionBearing", R"({"value":true})")->value, 1.0);
}

TEST(ControlChange, TakesTheUnitsThatTheInterfaceAllows) {
  EXPECT_EQ(read("range", R"({"value":3,"units":"nm"})")->value, 5556.0);
  EXPECT_EQ(read("range", R"({"value":5.556,"units":"km"})")->value, 5556.0);
  EXPECT_NEAR(*read("dopplerSpeedThreshold", R"({"value":3.6,"units":"kn"})")->value, 1.852, 1e-9);
  EXPECT_NEAR(*read("bearingAlignment", R"({"value":-90,"units":"deg"})")->value,
              -std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(*read("rotationSpeed", R"({"value":24,"units":"rpm"})")->value,
              24 * std::numbers::pi / 30, 1e-12);
  EXPECT_FALSE(read("range", R"({"value":3,"units":"kn"})").ok());
  EXPECT_FALSE(read("gain", R"({"value":3,"units":"m"})").ok());
}

TEST(ControlChange, ARangeIsTheScaleNextToItAndNothingInBetween) {
  EXPECT_EQ(read("range", R"({"value":5560})")->value, 5556.0);
  EXPECT_EQ(read("range", R"({"value":231})")->value, 232.0);
  const auto between = read("range", R"({"value":4000})");
  ASSERT_FALSE(between.ok());
  EXPECT_THAT(between.error(), HasSubstr("5556 (3 NM)"));
}

TEST(ControlChange, ASectorHasTwoEndsAndASwitch) {
  const auto whole = read("noTransmitSector1", R"({"enabled":true,"value":-1.5,"endValue":1.25})");
  ASSERT_TRUE(whole.ok()) << whole.error();
  EXPECT_EQ(whole->value, -1.5);
  EXPECT_EQ(whole->end, 1.25);
  EXPECT_EQ(whole->enabled, true);
  EXPECT_EQ(read("noTransmitSector4", R"({"enabled":false})")->enabled, false);
  EXPECT_FALSE(read("noTransmitSector1", R"({"value":0,"endValue":4})").ok());
}

TEST(ControlChange, WhatIsWrongIsSaidWithWhatIsAllowed) {
  const auto expect = [](const char* key, const char* body, const char* part) {
    const auto change = read(key, body);
    ASSERT_FALSE(change.ok()) << key << " " << body;
    EXPECT_THAT(change.error(), HasSubstr(key));
    EXPECT_THAT(change.error(), HasSubstr(part));
  };
  expect("gain", R"({"value":100.5})", "0 to 100");
  expect("gain", R"({"value":-1})", "0 to 100");
  expect("gain", R"({"value":"loud"})", "no number");
  expect("gain", R"({"value":"nan"})", "no number");
  expect("gain", R"({"value":[1]})", "no number");
  expect("gain", R"({"auto":1})", "neither true nor false");
  expect("gain", "{}", "nothing to set");
  expect("gain", R"({"value":null})", "nothing to set");
  expect("gain", R"({"value":{"value":{"value":1}}})", "within a value");
  expect("rain", R"({"auto":true})", "no automatic");
  expect("rain", R"({"mode":"auto","value":3})", "no automatic");
  expect("rain", R"({"auto":false})", "nothing to set");
  expect("gain", R"({"mode":"loud","value":3})", "neither");
  expect("gain", R"({"mode":"auto","auto":false})", "different");
  expect("power", R"({"value":0})", "1 (Standby), 2 (Transmit)");
  expect("power", R"({"value":"off"})", "no number");
  expect("modelName", R"({"value":"x"})", "read");
}

TEST(ControlState, IsWrittenAsDisplaysExpectIt) {
  const auto text = [](const char* key, const ControlState& state) {
    return text_of(state_document(*find_control(key), state));
  };
  EXPECT_EQ(text("power", {.value = 2}), R"({"value":2})");
  EXPECT_EQ(text("gain", {.value = 50, .automatic = false}), R"({"auto":false,"value":50})");
  EXPECT_EQ(text("gain", {.value = 0.5, .automatic = true, .locked = true}),
            R"({"auto":true,"value":0.5,"allowed":false})");
  EXPECT_EQ(text("noTransmitSector1", {.value = -1.5, .enabled = true, .end = 1}),
            R"({"enabled":true,"value":-1.5,"endValue":1})");
  EXPECT_EQ(text("modelName", {.text = "25 kW X"}), R"({"value":"25 kW X"})");
}

TEST(Json, DeepAndLongDocumentsAreNotRead) {
  EXPECT_TRUE(read_json(std::string(10, '[') + std::string(10, ']')).has_value());
  EXPECT_FALSE(read_json(std::string(60'000, '[')).has_value());
  EXPECT_FALSE(read_json(std::string(100, '[') + std::string(100, ']')).has_value());
  EXPECT_FALSE(read_json(std::string(kMaxText + 1, ' ') + "1").has_value());
  EXPECT_FALSE(read_json("").has_value());
  EXPECT_FALSE(read_json(R"({"a":1} x)").has_value());
}

}  // namespace
}  // namespace skerry::signalk
