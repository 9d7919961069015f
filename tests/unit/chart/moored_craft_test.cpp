// Craft at their berths: where, how many, how large.
#include "echo/chart/moored_craft.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "echo/chart/land_mask.hpp"

namespace skerry::echo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPerLatitude = 111'132.0;
const double kPerLongitude = kPerLatitude * std::cos(50.0 * M_PI / 180.0);

GeoPoint at(double east_m, double north_m) {
  return {50.0 + north_m / kPerLatitude, -1.0 + east_m / kPerLongitude};
}
PlanePoint metres_of(GeoPoint p) {
  return {(p.longitude_deg + 1.0) * kPerLongitude, (p.latitude_deg - 50.0) * kPerLatitude};
}
std::vector<GeoPoint> box_of(double west, double south, double east, double north) {
  return {at(west, south), at(east, south), at(east, north), at(west, north)};
}
ChartObject object_of(ObjectClass kind, std::vector<GeoPoint> outline, float height_m = 0.8f) {
  ChartObject object;
  object.kind = kind;
  object.outline = std::move(outline);
  object.height_m = height_m;
  return object;
}

struct Made {
  std::vector<ChartObject> craft;
  std::vector<std::string> reports;
};
Made make(const Moorings& moorings, const std::vector<ChartObject>& objects,
          const std::vector<CoastRing>& rings = {}) {
  Made made;
  made.craft = moored_craft(moorings, objects, rings, "harbour.geojson", made.reports);
  return made;
}

double least_apart(const std::vector<ChartObject>& craft) {
  double least = 1e9;
  for (std::size_t i = 0; i < craft.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      least = std::min(least,
                       length_of(metres_of(craft[i].outline[0]) - metres_of(craft[k].outline[0])));
  }
  return least;
}

TEST(MooredCraft, LieAlongBothSidesOfAPontoon) {
  const std::vector<ChartObject> pontoon = {
      object_of(ObjectClass::pontoon, {at(0, 0), at(0, 400)})};
  const Made made = make({}, pontoon);
  EXPECT_THAT(made.reports, IsEmpty());
  // 80 berths on each side, 70 % taken.
  EXPECT_NEAR(static_cast<double>(made.craft.size()), 112.0, 20.0);
  for (const ChartObject& craft : made.craft) {
    EXPECT_EQ(craft.kind, ObjectClass::craft);
    EXPECT_NEAR(std::abs(metres_of(craft.outline[0]).east_m), 5.5, 0.05);
    EXPECT_GT(craft.cross_section_m2, 0.04f);
    EXPECT_LT(craft.cross_section_m2, 150.0f);
    EXPECT_GE(craft.height_m, 1.5f);
    EXPECT_LE(craft.height_m, 2.5f);
  }
  EXPECT_GE(least_apart(made.craft), kLeastApart);
  // The same again, in any company.
  std::vector<ChartObject> two = pontoon;
  two.push_back(object_of(ObjectClass::pontoon, {at(100, 0), at(100, 50)}));
  const Made more = make({}, two);
  ASSERT_GT(more.craft.size(), made.craft.size());
  for (std::size_t i = 0; i < made.craft.size(); ++i) {
    EXPECT_EQ(made.craft[i].outline, more.craft[i].outline);
    EXPECT_EQ(made.craft[i].cross_section_m2, more.craft[i].cross_section_m2);
    EXPECT_EQ(made.craft[i].identity, more.craft[i].identity);
  }
}

TEST(MooredCraft, NotAtHulksNorPiersOfNoHarbour) {
  EXPECT_THAT(make({}, {object_of(ObjectClass::pontoon, {at(0, 0), at(0, 100)}, 4.0f),
                        object_of(ObjectClass::pier, {at(0, 0), at(0, 100)}),
                        object_of(ObjectClass::pontoon, {at(0, 0)})})
                  .craft,
              IsEmpty());
  Moorings near;
  near.places.push_back({at(0, 100), true});
  const Made made = make(near, {object_of(ObjectClass::pier, {at(0, 0), at(0, 100), at(0, 200)}),
                                object_of(ObjectClass::pier, {at(900, 0), at(900, 100)})});
  EXPECT_GT(made.craft.size(), 10u);
  for (const ChartObject& craft : made.craft)
    EXPECT_NEAR(std::abs(metres_of(craft.outline[0]).east_m), 7.0, 0.05) << "fishing craft";
}

TEST(MooredCraft, LieOutsideAClosedPontoon) {
  ChartObject pontoon = object_of(ObjectClass::pontoon, box_of(0, 0, 40, 40));
  pontoon.closed = true;
  for (int turn = 0; turn < 2; ++turn) {
    const Made made = make({}, {pontoon});
    EXPECT_GT(made.craft.size(), 10u);
    for (const ChartObject& craft : made.craft) {
      const PlanePoint p = metres_of(craft.outline[0]);
      EXPECT_FALSE(p.east_m > 0 && p.east_m < 40 && p.north_m > 0 && p.north_m < 40);
    }
    std::reverse(pontoon.outline.begin(), pontoon.outline.end());
  }
}

TEST(MooredCraft, FillAMarinaWithoutPontoonsInRowsByItsArea) {
  Moorings moorings;
  moorings.areas.push_back({{box_of(0, 0, 200, 150), box_of(50, 50, 100, 100)}, false, "marina"});
  const Made made = make(moorings, {});
  EXPECT_THAT(made.reports, IsEmpty());
  const double area = 200.0 * 150.0 - 50.0 * 50.0;
  std::printf("one craft for %.0f m2\n", area / static_cast<double>(made.craft.size()));
  EXPECT_NEAR(area / static_cast<double>(made.craft.size()), 129.0, 25.0);
  EXPECT_GE(least_apart(made.craft), kLeastApart);
  for (const ChartObject& craft : made.craft) {
    const PlanePoint p = metres_of(craft.outline[0]);
    EXPECT_TRUE(p.east_m > -0.1 && p.east_m < 200.1 && p.north_m > -0.1 && p.north_m < 150.1);
    EXPECT_FALSE(p.east_m > 50.1 && p.east_m < 99.9 && p.north_m > 50.1 && p.north_m < 99.9);
  }
  const Made with = make(moorings, {object_of(ObjectClass::pontoon, {at(20, 20), at(20, 60)})});
  EXPECT_LT(with.craft.size(), 20u) << "its own pontoon says where they lie";
}

TEST(MooredCraft, NeverLieOnLand) {
  CoastRing land;
  for (const GeoPoint p : box_of(-500, -500, 100, 500)) {
    land.vertices.push_back(p);
    land.edges.push_back(EdgeKind::shoreline);
  }
  Moorings moorings;
  moorings.areas.push_back({{box_of(0, 0, 200, 150)}, false, "marina"});
  const Made made =
      make(moorings, {object_of(ObjectClass::pontoon, {at(100, 200), at(100, 300)})}, {land});
  EXPECT_GT(made.craft.size(), 50u);
  CoastChart chart;
  chart.rings = {land};
  for (const ChartObject& craft : made.craft) EXPECT_FALSE(is_land(chart, craft.outline[0]));

  const Made free = make(moorings, {});
  chart.objects = free.craft;
  chart.objects.push_back(object_of(ObjectClass::pile, {at(50, 50)}));
  remove_craft_ashore(chart);
  EXPECT_LT(chart.objects.size(), free.craft.size());
  EXPECT_EQ(chart.objects.back().kind, ObjectClass::pile) << "other objects stay";
  for (const ChartObject& craft : chart.objects) {
    EXPECT_FALSE(craft.kind == ObjectClass::craft && is_land(chart, craft.outline[0]));
  }
}

TEST(MooredCraft, AreBoundedAndTheRestIsReported) {
  Moorings moorings;
  moorings.areas.push_back({{box_of(0, 0, 60'000, 60'000)}, false, "a.geojson: marina feature 1"});
  Made made = make(moorings, {});
  EXPECT_LE(made.craft.size(), kMostCraftInArea);
  EXPECT_THAT(made.reports, ElementsAre(HasSubstr("marina feature 1: more than the 1000")));

  for (int i = 1; i < 40; ++i)
    moorings.areas.push_back({{box_of(0, 1000 * i, 900, 1000 * i + 900)}, false, "b"});
  moorings.areas.erase(moorings.areas.begin());
  made = make(moorings, {});
  EXPECT_EQ(made.craft.size(), kMostCraft);
  EXPECT_THAT(made.reports.back(), HasSubstr("harbour.geojson: more than the 20000"));

  Moorings odd;
  odd.areas.push_back({{}, false, "nothing"});
  odd.areas.push_back({{{at(0, 0), at(0, 0), at(0, 0)}}, false, "a place"});
  odd.areas.push_back({{{{90.0, 0.0}, {90.0, 120.0}, {90.0, -120.0}}}, false, "the pole"});
  odd.berths.push_back({at(0, 0), at(0, 0)});
  EXPECT_THAT(make(odd, {object_of(ObjectClass::pontoon, {at(0, 0), at(0, 0)}),
                         object_of(ObjectClass::pontoon, {{0.0, 0.0}, {0.0, 179.0}})})
                  .craft,
              IsEmpty());
}

TEST(MooredCraft, CrossSectionsSpreadAboutTheirMedian) {
  Moorings moorings;
  for (int i = 0; i < 15; ++i)
    moorings.areas.push_back({{box_of(0, 400 * i, 300, 400 * i + 300)}, i >= 9, "m"});
  const Made made = make(moorings, {});
  std::vector<double> sections[2];
  for (const ChartObject& craft : made.craft)
    sections[metres_of(craft.outline[0]).north_m > 3590.0].push_back(
        10.0 * std::log10(static_cast<double>(craft.cross_section_m2)));
  for (int fishing = 0; fishing < 2; ++fishing) {
    auto& db = sections[fishing];
    ASSERT_GT(db.size(), 1000u);
    std::sort(db.begin(), db.end());
    double sum = 0.0, squares = 0.0;
    for (const double v : db) sum += v;
    const double mean = sum / static_cast<double>(db.size());
    for (const double v : db) squares += (v - mean) * (v - mean);
    EXPECT_NEAR(db[db.size() / 2], fishing ? 10.0 : 10.0 * std::log10(2.5), 0.6);
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(db.size())), 5.0, 0.4);
  }
}

}  // namespace
}  // namespace skerry::echo
