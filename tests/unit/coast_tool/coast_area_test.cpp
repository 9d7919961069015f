#include "echo/coast_tool/coast_area.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace skerry::echo {
namespace {

using testing::HasSubstr;

std::string refusal_of(const std::string& text) {
  try {
    parse_area(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CoastArea, IsTheSameFromAnyTwoOppositeCorners) {
  for (const char* text :
       {"60,4.6,60.6,5.6", "60.6,5.6,60,4.6", "60.6,4.6,60,5.6", " 60, 4.6, 60.6,5.6"}) {
    const CoastArea area = parse_area(text);
    EXPECT_EQ(area.limits(), "60..60.6 N, 4.6..5.6 E") << text;
    EXPECT_TRUE(area.contains({60.3, 5.0}));
    EXPECT_FALSE(area.contains({60.3, 5.7}));
    EXPECT_FALSE(area.contains({59.9, 5.0}));
    EXPECT_FALSE(area.contains({60.3, 4.5}));
  }
}

TEST(CoastArea, LiesAcrossTheAntimeridianWhenThatIsShorter) {
  const CoastArea area = parse_area("-17,179,-16,-179");
  EXPECT_EQ(area.limits(), "16..17 S, 179 E..179 W");
  EXPECT_TRUE(area.contains({-16.5, 179.5}));
  EXPECT_TRUE(area.contains({-16.5, -179.5}));
  EXPECT_FALSE(area.contains({-16.5, 178.5}));
  EXPECT_FALSE(area.contains({-16.5, 0.0}));
  EXPECT_NEAR(area.centre().longitude_deg, -180.0, 1e-9);
  // Half a degree of latitude and one of longitude at 16 S.
  EXPECT_NEAR(area.radius().in_metres(), 120300.0, 2000.0);
}

TEST(CoastArea, AcrossTheEquatorAndGreenwichNamesBothSides) {
  EXPECT_EQ(parse_area("-0.5,-1,0.5,1").limits(), "0.5 S..0.5 N, 1 W..1 E");
  EXPECT_EQ(parse_area("-55,-70,-54,-68").limits(), "54..55 S, 68..70 W");
}

TEST(CoastArea, SaysWhatIsWrongAndWhatWasExpected) {
  EXPECT_THAT(refusal_of("1,2,3"), HasSubstr("3 numbers; expected two opposite corners"));
  EXPECT_THAT(refusal_of(""), HasSubstr("number 1 cannot be read"));
  EXPECT_THAT(refusal_of("60,4.6,60.6,x"), HasSubstr("number 4 cannot be read"));
  EXPECT_THAT(refusal_of("60,nan,60.6,5"), HasSubstr("number 2 cannot be read"));
  EXPECT_THAT(refusal_of("60;4.6;60.6;5.6"), HasSubstr("\";4.6;60.6;5.6\" after number 1"));
  EXPECT_THAT(refusal_of("60,4.6,60.6,5.6,7"), HasSubstr("after number 4"));
  EXPECT_THAT(refusal_of("95,4.6,60.6,5.6"), HasSubstr("latitude 95 is not between"));
  EXPECT_THAT(refusal_of("60,4.6,60.6,1e9"), HasSubstr("longitude 1000000000 is not between"));
  EXPECT_THAT(refusal_of("60,4.6,60,5.6"), HasSubstr("span no area"));
  EXPECT_THAT(refusal_of("0,0,60,60"), HasSubstr("farther than 200 NM"));
  EXPECT_THAT(refusal_of("-90,-180,90,179"), HasSubstr("farther than 200 NM"));
}

TEST(CoastArea, PlacesAreKnownByName) {
  for (const std::string& name : place_names()) EXPECT_EQ(named_place(name).name, name);
  EXPECT_EQ(named_place("bergen").limits(), "60..60.6 N, 4.6..5.6 E");
  EXPECT_EQ(named_place("BERGEN").name, "bergen");
  try {
    named_place("london");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("known are bergen, plymouth, dalian"));
    EXPECT_THAT(error.what(), HasSubstr("--area"));
  }
}

}  // namespace
}  // namespace skerry::echo
