// Cells made for a test: what each object becomes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "echo/chart/gdal/s57/s57_chart.hpp"
#include "echo/chart/land_mask.hpp"
#include "tests/unit/chart_gdal/geo_box.hpp"
#include "tests/unit/chart_gdal/made_cell.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A cell from 50.0 N 1.0 W, a tenth of a degree across; its western third is land.
MadeCell harbour() {
  MadeCell cell;
  cell.area("M_COVR", {box(50.0, -1.0, 50.1, -0.9)}, {{"CATCOV", "1"}});
  cell.area("LNDARE", {{{50.0, -1.0}, {50.0, -0.97}, {50.05, -0.96}, {50.1, -0.97}, {50.1, -1.0}}});
  return cell;
}

class S57Made : public testing::Test {
 protected:
  S57Chart open(const MadeCell& cell) {
    cell.write(folder_ / "TEST0001.000");
    return S57Chart::open(folder_ / "TEST0001.000", warnings_);
  }
  CoastChart load(const MadeCell& cell) { return open(cell).load({50.05, -0.95}, metres(20000)); }
  // The object of that kind, which must be the only one.
  static ChartObject only(const CoastChart& chart, ObjectClass kind) {
    ChartObject found;
    int count = 0;
    for (const ChartObject& object : chart.objects) {
      if (object.kind != kind) continue;
      found = object;
      ++count;
    }
    EXPECT_EQ(count, 1) << "objects of kind " << static_cast<int>(kind);
    return found;
  }

  TemporaryFolder folder_;
  std::vector<std::string> warnings_;
};

// The edge of the chart from one place to another.
struct Found {
  bool is = false;
  EdgeKind kind = EdgeKind::shoreline;
  Shore shore;
};
Found edge(const CoastChart& chart, GeoPoint from, GeoPoint to) {
  for (const CoastRing& ring : chart.rings) {
    for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
      if (ring.vertices[i] == from && ring.vertices[(i + 1) % n] == to)
        return {true, ring.edges[i], shore_of(chart, ring, i)};
    }
  }
  return {};
}

TEST_F(S57Made, LandIsOnTheLeftAndEndsAtTheLimitInASeam) {
  const CoastChart chart = load(harbour());
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_EQ(chart.source, "ENC TEST0001 edition 1 update 0");
  EXPECT_TRUE(is_land(chart, {50.05, -0.99}));
  EXPECT_FALSE(is_land(chart, {50.05, -0.95}));
  EXPECT_EQ(winding_number(chart, {50.05, -0.99}), 1);
  EXPECT_EQ(edge(chart, {50.0, -0.97}, {50.05, -0.96}).kind, EdgeKind::shoreline);
  EXPECT_EQ(edge(chart, {50.05, -0.96}, {50.1, -0.97}).kind, EdgeKind::shoreline);
  EXPECT_EQ(edge(chart, {50.1, -0.97}, {50.1, -1.0}).kind, EdgeKind::seam);
  EXPECT_EQ(edge(chart, {50.1, -1.0}, {50.0, -1.0}).kind, EdgeKind::seam);
  EXPECT_EQ(edge(chart, {50.0, -1.0}, {50.0, -0.97}).kind, EdgeKind::seam);
}

TEST_F(S57Made, ShoresAreAsTheLinesAlongThemSay) {
  MadeCell cell = harbour();
  cell.line("COALNE", {{50.0, -0.97}, {50.05, -0.96}}, {{"CATCOA", "1"}, {"ELEVAT", "12"}});
  cell.line("SLCONS", {{50.05, -0.96}, {50.1, -0.97}}, {{"CATSLC", "6"}, {"HEIGHT", "3.5"}});
  const CoastChart chart = load(cell);
  EXPECT_EQ(edge(chart, {50.0, -0.97}, {50.05, -0.96}).shore, (Shore{CoastType::rocky, 12.0f}));
  EXPECT_EQ(edge(chart, {50.05, -0.96}, {50.1, -0.97}).shore, (Shore{CoastType::artificial, 3.5f}));
  EXPECT_THAT(chart.objects, IsEmpty()) << "a quay along the land is the land's own edge";
}

TEST_F(S57Made, GroundAlongAShoreCountsWhereTheCoastlineSaysNothing) {
  MadeCell cell = harbour();
  cell.line("COALNE", {{50.0, -0.97}, {50.05, -0.96}});
  cell.line("COALNE", {{50.05, -0.96}, {50.1, -0.97}}, {{"CATCOA", "4"}});
  cell.area("SBDARE", {{{50.0, -0.97}, {50.03, -0.94}, {50.1, -0.97}, {50.05, -0.96}}},
            {{"NATSUR", "4"}});
  const CoastChart chart = load(cell);
  EXPECT_EQ(edge(chart, {50.0, -0.97}, {50.05, -0.96}).shore.type, CoastType::sandy);
  EXPECT_EQ(edge(chart, {50.05, -0.96}, {50.1, -0.97}).shore.type, CoastType::rocky);
}

TEST_F(S57Made, LakesAndHolesAreWaterAndNeighbouringLandIsOnePiece) {
  MadeCell cell;
  cell.area("M_COVR", {box(50.0, -1.0, 50.1, -0.9)}, {{"CATCOV", "1"}});
  cell.area("LNDARE", {box(50.02, -0.98, 50.08, -0.95), box(50.03, -0.97, 50.04, -0.96)});
  cell.area("LNDARE", {box(50.02, -0.95, 50.08, -0.92)});
  cell.area("LAKARE", {box(50.05, -0.94, 50.07, -0.93), box(50.055, -0.938, 50.065, -0.932)});
  const CoastChart chart = load(cell);
  EXPECT_THAT(warnings_, IsEmpty());
  EXPECT_TRUE(is_land(chart, {50.025, -0.975}));
  EXPECT_FALSE(is_land(chart, {50.035, -0.965})) << "in the hole";
  EXPECT_TRUE(is_land(chart, {50.03, -0.94}));
  EXPECT_FALSE(is_land(chart, {50.052, -0.935})) << "in the lake";
  EXPECT_TRUE(is_land(chart, {50.06, -0.935})) << "on its island";
  EXPECT_EQ(edge(chart, {50.02, -0.95}, {50.08, -0.95}).kind, EdgeKind::bin_border);
  EXPECT_EQ(edge(chart, {50.08, -0.95}, {50.02, -0.95}).kind, EdgeKind::bin_border);
  EXPECT_EQ(edge(chart, {50.02, -0.95}, {50.02, -0.92}).kind, EdgeKind::shoreline);
}

TEST_F(S57Made, APierIsAWallWhereItIsNoEdgeOfLand) {
  MadeCell cell = harbour();
  // Along the shore, out into the water, and back along the shore of the other side.
  cell.line("SLCONS", {{50.0, -0.97}, {50.05, -0.96}, {50.05, -0.94}, {50.06, -0.94}},
            {{"CATSLC", "4"}});
  cell.line("SLCONS", {{50.04, -0.99}, {50.05, -0.99}}, {{"CATSLC", "10"}});  // inland
  cell.line("SLCONS", {{50.02, -0.93}, {50.03, -0.93}}, {{"CATSLC", "1"}, {"VERLEN", "4.5"}});
  cell.line("SLCONS", {{50.02, -0.92}, {50.03, -0.92}}, {{"CATSLC", "1"}, {"WATLEV", "3"}});
  cell.area("SLCONS", {box(50.08, -0.95, 50.085, -0.93)}, {{"CATSLC", "16"}});
  const CoastChart chart = load(cell);
  ASSERT_EQ(chart.objects.size(), 3u);
  const ChartObject breakwater = only(chart, ObjectClass::breakwater);
  EXPECT_FLOAT_EQ(breakwater.height_m, 4.5f);
  EXPECT_FALSE(breakwater.closed);
  int blocks = 0;
  for (const ChartObject& object : chart.objects) {
    if (object.kind != ObjectClass::pier) continue;
    if (object.closed) {
      ++blocks;
      EXPECT_EQ(object.outline.size(), 4u);
    } else {
      EXPECT_THAT(object.outline, ElementsAre(GeoPoint{50.05, -0.96}, GeoPoint{50.05, -0.94},
                                              GeoPoint{50.06, -0.94}));
      EXPECT_FLOAT_EQ(object.height_m, 2.0f);
    }
  }
  EXPECT_EQ(blocks, 1);
  EXPECT_EQ(edge(chart, {50.0, -0.97}, {50.05, -0.96}).shore.type, CoastType::artificial);
}

TEST_F(S57Made, BuoysAndReflectors) {
  MadeCell cell = harbour();
  cell.point("BOYLAT", {50.01, -0.92}, {{"BOYSHP", "4"}, {"OBJNAM", "No 1"}});
  cell.point("BOYSPP", {50.02, -0.92}, {{"BOYSHP", "3"}});
  cell.point("BOYCAR", {50.03, -0.92}, {{"BOYSHP", "1"}, {"CONRAD", "3"}});
  cell.point("BCNLAT", {50.04, -0.92}, {{"BCNSHP", "3"}, {"HEIGHT", "14"}});
  cell.point("BCNLAT", {50.045, -0.92}, {{"BCNSHP", "2"}});
  cell.point("RADRFL", {50.045, -0.92});
  cell.point("RADRFL", {50.06, -0.92});
  const CoastChart chart = load(cell);
  EXPECT_THAT(warnings_, IsEmpty());
  ASSERT_EQ(chart.objects.size(), 6u);
  const auto at = [&](double latitude) {
    const auto found = std::find_if(
        chart.objects.begin(), chart.objects.end(),
        [&](const ChartObject& o) { return o.outline.front().latitude_deg == latitude; });
    return found == chart.objects.end() ? ChartObject{} : *found;
  };
  EXPECT_EQ(at(50.01).kind, ObjectClass::buoy);
  EXPECT_EQ(at(50.01).name, "No 1");
  EXPECT_FLOAT_EQ(at(50.01).height_m, 3.5f);
  EXPECT_FLOAT_EQ(at(50.01).cross_section_m2, 5.0f);
  EXPECT_FLOAT_EQ(at(50.02).cross_section_m2, 1.0f);
  EXPECT_EQ(at(50.03).kind, ObjectClass::reflector);
  EXPECT_FLOAT_EQ(at(50.03).cross_section_m2, 10.0f);
  EXPECT_EQ(at(50.04).kind, ObjectClass::beacon);
  EXPECT_FLOAT_EQ(at(50.04).height_m, 14.0f);
  EXPECT_FLOAT_EQ(at(50.04).cross_section_m2, 50.0f);
  EXPECT_EQ(at(50.045).kind, ObjectClass::reflector) << "a withy that bears a reflector";
  EXPECT_FLOAT_EQ(at(50.045).height_m, 2.0f);
  EXPECT_FLOAT_EQ(at(50.06).cross_section_m2, 10.0f) << "a reflector by itself";
}

TEST_F(S57Made, Racons) {
  MadeCell cell = harbour();
  cell.point("BOYSAW", {50.01, -0.92}, {{"BOYSHP", "7"}, {"OBJNAM", "Fairway"}});
  cell.point("RTPBCN", {50.01, -0.92},
             {{"CATRTB", "2"}, {"RADWAL", "0.03-X,0.10-S"}, {"SIGGRP", "(Q)"}});
  cell.point("RTPBCN", {50.02, -0.92}, {{"CATRTB", "2"}});
  cell.point("RTPBCN", {50.03, -0.92}, {{"CATRTB", "1"}, {"SIGGRP", "(M)"}});
  const CoastChart chart = load(cell);
  std::vector<std::string> codes;
  for (const ChartObject& object : chart.objects) {
    if (object.kind != ObjectClass::racon) continue;
    codes.push_back(object.racon_code);
    if (object.racon_code == "Q") {
      EXPECT_FLOAT_EQ(object.height_m, 5.0f) << "of the superbuoy it stands on";
      EXPECT_EQ(object.name, "Fairway");
      EXPECT_EQ(object.cross_section_m2, 0.0f);
    }
  }
  EXPECT_THAT(codes, ElementsAre("Q", "K"));
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_THAT(warnings_[0], AllOf(HasSubstr("TEST0001.000: RTPBCN"), HasSubstr("no letters")));
  EXPECT_THAT(warnings_[1], HasSubstr("ramark"));
}

TEST_F(S57Made, BridgesBeginAtTheirClearance) {
  MadeCell cell = harbour();
  cell.line("BRIDGE", {{50.02, -0.93}, {50.02, -0.91}}, {{"CATBRG", "1"}, {"VERCLR", "19.5"}});
  const ChartObject fixed = only(load(cell), ObjectClass::bridge);
  EXPECT_FLOAT_EQ(fixed.clearance_m, 19.5f);
  EXPECT_FLOAT_EQ(fixed.height_m, 22.5f);
  MadeCell other = harbour();
  other.area("BRIDGE", {box(50.02, -0.93, 50.021, -0.91)},
             {{"CATBRG", "5"}, {"VERCCL", "2.7"}, {"VERCOP", "42"}});
  const ChartObject opening = only(load(other), ObjectClass::bridge);
  EXPECT_TRUE(opening.closed);
  EXPECT_FLOAT_EQ(opening.clearance_m, 2.7f);
}

TEST_F(S57Made, OnlyWhatStandsOutAtHighWaterIsARock) {
  MadeCell cell = harbour();
  int row = 0;
  for (const char* level : {"1", "2", "3", "4", "5", "7"})
    cell.point("UWTROC", {50.01 + 0.01 * row++, -0.92}, {{"WATLEV", level}});
  cell.point("UWTROC", {50.08, -0.92});
  cell.point("WRECKS", {50.085, -0.92}, {{"CATWRK", "5"}});
  cell.point("WRECKS", {50.086, -0.92}, {{"CATWRK", "2"}, {"WATLEV", "3"}});
  cell.point("LNDARE", {50.09, -0.92});
  const CoastChart chart = load(cell);
  EXPECT_EQ(chart.objects.size(), 5u);
  for (const ChartObject& object : chart.objects) EXPECT_EQ(object.kind, ObjectClass::rock);
}

TEST_F(S57Made, AnAreaThatReachesOutOfTheCellIsLeftOut) {
  MadeCell cell = harbour();
  cell.area("LNDARE", {box(50.06, -0.93, 50.07, -0.2)});
  const CoastChart chart = load(cell);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], AllOf(HasSubstr("TEST0001.000: LNDARE"), HasSubstr("reaches out")));
  EXPECT_FALSE(is_land(chart, {50.065, -0.92}));
  EXPECT_TRUE(is_land(chart, {50.05, -0.99}));
}

TEST_F(S57Made, LandThatCrossesItselfIsMended) {
  MadeCell cell = harbour();
  cell.area("LNDARE", {{{50.06, -0.94}, {50.06, -0.92}, {50.07, -0.94}, {50.07, -0.92}}});
  const CoastChart chart = load(cell);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], AllOf(HasSubstr("LNDARE"), HasSubstr("Self-intersection")));
  EXPECT_TRUE(is_land(chart, {50.061, -0.93}));
  EXPECT_TRUE(is_land(chart, {50.069, -0.93}));
  EXPECT_FALSE(is_land(chart, {50.065, -0.938}));
}

TEST_F(S57Made, WithoutACoverageTheBoxAroundTheLandIsTaken) {
  MadeCell cell;
  cell.area("LNDARE", {{{50.0, -1.0}, {50.0, -0.97}, {50.1, -0.98}}});
  const S57Chart chart = open(cell);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("no coverage"));
  EXPECT_TRUE(chart.coverage().contains({50.05, -0.971}));
  EXPECT_FALSE(chart.coverage().contains({50.05, -0.96}));
}

TEST_F(S57Made, ACellOfNeitherLandNorCoverageIsRefused) {
  MadeCell cell;
  cell.point("BOYLAT", {50.01, -0.92});
  cell.write(folder_ / "TEST0001.000");
  EXPECT_THAT(complaint_of([&] { S57Chart::open(folder_ / "TEST0001.000", warnings_); }),
              AllOf(HasSubstr("TEST0001.000"), HasSubstr("M_COVR")));
}

TEST_F(S57Made, VerticesAreNamedByTheirPlaces) {
  const CoastChart chart = load(harbour());
  MadeCell other = harbour();
  other.area("LNDARE", {{{50.06, -0.93}, {50.05, -0.92}, {50.05, -0.94}}});
  const CoastChart more = load(other);
  ASSERT_EQ(chart.rings.size(), 1u);
  std::vector<std::uint64_t> ids = chart.rings[0].vertex_ids;
  std::vector<std::uint64_t> again;
  for (const CoastRing& ring : more.rings) {
    if (ring.vertices.size() == 5) again = ring.vertex_ids;
  }
  std::sort(ids.begin(), ids.end());
  std::sort(again.begin(), again.end());
  EXPECT_EQ(ids, again);
  EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace
}  // namespace skerry::echo
