#include "server/app/options/coast_rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "server/app/options/radar_config.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

using echo::CoastMethod;
using echo::CoastType;
using testing::HasSubstr;

echo::CoastRules rules_of(const std::string& coast) {
  return coast_rules(
      parse_scenario("name: Coast\nseed: 11\nown_ships:\n"
                     "  - {name: Tern, position: {lat: 60, lon: 5}, radars: [{}]}\n" +
                         coast,
                     "coast.yaml"));
}

const echo::CoastStyle& style(const echo::CoastRules& rules, CoastType type) {
  return rules.styles[static_cast<std::size_t>(type)];
}

std::string refusal(const std::string& coast) {
  try {
    rules_of(coast);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "taken";
}

TEST(CoastRules, OfAScenarioThatSaysNothingAreTheDefaults) {
  const echo::CoastRules rules = rules_of("");
  EXPECT_EQ(rules.seed, 11u);
  EXPECT_EQ(rules.styles, echo::CoastRules{}.styles);
  EXPECT_TRUE(rules.guess_types);
  EXPECT_TRUE(rules.places.empty());
}

TEST(CoastRules, TakeWhatIsSaidAndLeaveTheRest) {
  const echo::CoastRules rules = rules_of(
      "coast:\n"
      "  rocky: {method: midpoint, dimension: 1.33, amplitude: 0.8}\n"
      "  sandy: {amplitude: 2}\n"
      "  unknown: {method: weierstrass, gamma: 2, phases: alternating}\n"
      "  guess_kinds: false\n");
  EXPECT_EQ(style(rules, CoastType::rocky).method, CoastMethod::midpoint);
  EXPECT_DOUBLE_EQ(style(rules, CoastType::rocky).dimension, 1.33);
  EXPECT_DOUBLE_EQ(style(rules, CoastType::rocky).amplitude, 0.8);
  const echo::CoastStyle plain = style(echo::CoastRules{}, CoastType::sandy);
  EXPECT_EQ(style(rules, CoastType::sandy).method, plain.method);
  EXPECT_DOUBLE_EQ(style(rules, CoastType::sandy).dimension, plain.dimension);
  EXPECT_DOUBLE_EQ(style(rules, CoastType::sandy).amplitude, 2.0);
  EXPECT_EQ(style(rules, CoastType::unknown).method, CoastMethod::weierstrass);
  EXPECT_DOUBLE_EQ(style(rules, CoastType::unknown).gamma, 2.0);
  EXPECT_EQ(style(rules, CoastType::unknown).phases, echo::SeriesPhases::alternating);
  EXPECT_EQ(style(rules, CoastType::artificial), style(echo::CoastRules{}, CoastType::artificial));
  EXPECT_FALSE(rules.guess_types);
}

// The schema and the table of methods name the same ones; the schema's numbers are in files and
// never change.
TEST(CoastRules, KnowEveryMethodByTheSchemasName) {
  const auto* schema = scenario::CoastStyle::Method_descriptor();
  EXPECT_EQ(schema->value_count(), static_cast<int>(echo::coast_methods().size()));
  for (const echo::CoastMethodRow& row : echo::coast_methods()) {
    const std::string name(row.name);
    ASSERT_NE(schema->FindValueByName(name), nullptr) << name;
    const echo::CoastRules rules = rules_of("coast: {rocky: {method: " + name + "}}");
    EXPECT_EQ(style(rules, CoastType::rocky).method, row.method) << name;
  }
  EXPECT_EQ(schema->FindValueByName("random_koch")->number(), 0);
  EXPECT_EQ(schema->FindValueByName("koch")->number(), 1);
  EXPECT_EQ(schema->FindValueByName("midpoint")->number(), 2);
  EXPECT_EQ(schema->FindValueByName("weierstrass")->number(), 3);
  EXPECT_EQ(schema->FindValueByName("straight")->number(), 4);
}

TEST(CoastRules, AStraightMethodBringsItsOwnDimension) {
  const echo::CoastRules rules = rules_of("coast: {rocky: {method: straight}}");
  EXPECT_DOUBLE_EQ(style(rules, CoastType::rocky).dimension, 1.0);
}

TEST(CoastRules, PlacesBuildOnTheStyleOfTheirKind) {
  const echo::CoastRules rules = rules_of(
      "coast:\n"
      "  sandy: {dimension: 1.07}\n"
      "  places:\n"
      "    - {position: {lat: 60.1, lon: 5.1}, radius_nm: 2, kind: sandy, style: {amplitude: 3}}\n"
      "    - {position: {lat: 60.2, lon: 5.2}, kind: artificial}\n");
  ASSERT_EQ(rules.places.size(), 2u);
  EXPECT_DOUBLE_EQ(rules.places[0].radius_m, 3704.0);
  EXPECT_EQ(rules.places[0].type, CoastType::sandy);
  ASSERT_TRUE(rules.places[0].style.has_value());
  EXPECT_DOUBLE_EQ(rules.places[0].style->dimension, 1.07);
  EXPECT_DOUBLE_EQ(rules.places[0].style->amplitude, 3.0);
  EXPECT_EQ(rules.places[1].type, CoastType::artificial);
  EXPECT_FALSE(rules.places[1].style.has_value());
}

TEST(CoastRules, NameTheKeyAndTheRangeOfWhatIsRefused) {
  EXPECT_THAT(refusal("coast: {rocky: {method: koch, dimension: 1.4}}"),
              testing::AllOf(HasSubstr("coast.rocky"), HasSubstr("1.4"), HasSubstr("1.25")));
  EXPECT_THAT(refusal("coast: {rocky: {dimension: 1.6}}"),
              testing::AllOf(HasSubstr("coast.yaml"), HasSubstr("1.6"), HasSubstr("1 to 1.5")));
  EXPECT_THAT(refusal("coast: {rocky: {method: perlin}}"), HasSubstr("midpoint"));
  EXPECT_THAT(refusal("coast: {places: [{radius_nm: 1}]}"), HasSubstr("position"));
  EXPECT_THAT(refusal("coast: {places: [{position: {lat: 1, lon: 2}, style: {method: random_koch, "
                      "dimension: 1.3}}]}"),
              HasSubstr("coast.places[0].style"));
}

TEST(CoastRules, StylesThatCannotBeComeWithAllOtherErrorsOfTheFile) {
  YamlSource source("coast.yaml");
  const scenario::Scenario scenario = read_scenario(
      "name: Coast\nown_ships:\n"
      "  - {name: Tern, position: {lat: 95, lon: 5}, radars: [{locked: [gain, volume]}]}\n"
      "coast:\n  rocky: {method: koch, dimension: 1.4}\n"
      "  sandy: {method: koch, dimension: 9}\n"
      "  places: [{position: {lat: 1, lon: 2}, style: {method: koch, dimension: 1.3}}]\n",
      source);
  check_coast(scenario, source);
  check_locks(scenario, source);
  std::string all;
  try {
    source.require_sound();
  } catch (const ConfigError& error) {
    all = error.what();
  }
  EXPECT_THAT(all, testing::AllOf(
                       HasSubstr("coast.yaml:3:34: own_ships[0].position.lat: 95"),
                       HasSubstr("\ncoast.yaml:3:72: own_ships[0].radars[0].locked[1]: there is no "
                                 "control \"volume\""),
                       HasSubstr("\ncoast.yaml:5:10: coast.rocky: "),
                       HasSubstr("\ncoast.yaml:6:36: coast.sandy.dimension: 9 is out of range"),
                       HasSubstr("\ncoast.yaml:7:48: coast.places[0].style: "),
                       HasSubstr("\ncoast.yaml: 5 errors")));
}

}  // namespace
}  // namespace skerry::server
