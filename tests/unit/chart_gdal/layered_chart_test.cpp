#include "echo/chart/gdal/layered_chart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/open_chart.hpp"
#include "echo/chart/gshhg_reader.hpp"
#include "echo/chart/land_mask.hpp"
#include "echo/kernel/hash.hpp"
#include "tests/unit/chart_gdal/geo_box.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

// A chart of rings as given; shorelines all.
class DrawnChart final : public CoveredChart {
 public:
  DrawnChart(std::vector<Line> land, std::vector<Line> coverage, CoastType type) {
    sheet_.source = "drawn";
    ShoreTable table(sheet_.shores);
    const std::uint16_t shore = table.index_of({type, 0.0f});
    for (const Line& line : land) {
      CoastRing ring;
      for (GeoPoint p : line) {
        p.longitude_deg = wrapped_longitude(p.longitude_deg);
        ring.vertices.push_back(p);
        ring.vertex_ids.push_back(identity_of(p));
      }
      ring.edges.assign(line.size(), EdgeKind::shoreline);
      ring.shores.assign(line.size(), shore);
      sheet_.rings.push_back(std::move(ring));
    }
    for (Line& line : coverage) {
      for (GeoPoint& p : line) p.longitude_deg = wrapped_longitude(p.longitude_deg);
      sheet_.coverage.polygons.push_back({line});
    }
    sheet_.index();
  }
  void add_object(GeoPoint place) {
    ChartObject object;
    object.outline = {place};
    sheet_.objects.push_back(object);
    sheet_.index();
  }
  CoastChart load(GeoPoint centre, Length radius) const override {
    return sheet_.window(centre, radius);
  }
  std::string describe() const override { return sheet_.source; }
  const Coverage& coverage() const override { return sheet_.coverage; }

 private:
  ChartSheet sheet_;
};

std::unique_ptr<DrawnChart> drawn(std::vector<Line> land, std::vector<Line> coverage,
                                  CoastType type = CoastType::rocky) {
  return std::make_unique<DrawnChart>(std::move(land), std::move(coverage), type);
}
LayeredChart over(std::unique_ptr<ChartSource> upper, std::unique_ptr<ChartSource> lower) {
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(std::move(upper));
  charts.push_back(std::move(lower));
  return LayeredChart(std::move(charts));
}

// The count of a ray along the parallel over shorelines and seams: how
// much the winding number falls.
int counted(const CoastChart& chart, GeoPoint from, double to_longitude) {
  int sum = 0;
  for (const CoastRing& ring : chart.rings) {
    for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
      if (ring.edges[i] == EdgeKind::bin_border) continue;
      const GeoPoint a = ring.vertices[i], b = ring.vertices[(i + 1) % n];
      const double ya = a.latitude_deg - from.latitude_deg, yb = b.latitude_deg - from.latitude_deg;
      if ((ya < 0.0) == (yb < 0.0)) continue;
      const double x = a.longitude_deg + (b.longitude_deg - a.longitude_deg) * ya / (ya - yb);
      if (x > from.longitude_deg && x < to_longitude) sum += yb > ya ? 1 : -1;
    }
  }
  return sum;
}

std::map<EdgeKind, int> kinds(const CoastChart& chart) {
  std::map<EdgeKind, int> found;
  for (const CoastRing& ring : chart.rings) {
    EXPECT_EQ(ring.vertices.size(), ring.edges.size());
    EXPECT_EQ(ring.vertices.size(), ring.vertex_ids.size());
    EXPECT_EQ(ring.vertices.size(), ring.shores.size());
    for (const EdgeKind kind : ring.edges) ++found[kind];
  }
  return found;
}

TEST(LayeredChart, WhereBothSidesAreLandTheLimitIsABorderElseASeam) {
  // The lower chart's island reaches from 1 to 3 east; the upper one, which covers everything east
  // of 2, has land there only in its southern half.
  const LayeredChart chart =
      over(drawn({box(50.0, 2.0, 50.5, 3.5)}, {box(49.0, 2.0, 52.0, 4.0)}, CoastType::sandy),
           drawn({box(50.0, 1.0, 51.0, 3.0)}, {}));
  const CoastChart window = chart.load({50.5, 2.0}, metres(300000));
  auto found = kinds(window);
  EXPECT_EQ(found[EdgeKind::bin_border], 2) << "from 50.0 to 50.5, on both sides";
  EXPECT_EQ(found[EdgeKind::seam], 1) << "from 50.5 to 51.0, of the lower chart";
  EXPECT_TRUE(is_land(window, {50.75, 1.5}));
  EXPECT_FALSE(is_land(window, {50.75, 2.5}));
  EXPECT_TRUE(is_land(window, {50.25, 3.4}));
  for (const CoastRing& ring : window.rings) {
    for (std::size_t i = 0; i < ring.edges.size(); ++i) {
      if (ring.edges[i] != EdgeKind::shoreline) continue;
      const bool upper = ring.vertices[i].longitude_deg +
                             ring.vertices[(i + 1) % ring.edges.size()].longitude_deg >
                         4.0;
      EXPECT_EQ(shore_of(window, ring, i).type, upper ? CoastType::sandy : CoastType::rocky);
    }
  }
}

TEST(LayeredChart, WhatIsNotCutKeepsItsIdentity) {
  const Line island = box(50.0, 1.0, 51.0, 3.0);
  const LayeredChart chart = over(drawn({}, {box(49.0, 2.0, 52.0, 4.0)}), drawn({island}, {}));
  const CoastChart window = chart.load({50.5, 2.0}, metres(300000));
  std::set<std::uint64_t> ids;
  for (const CoastRing& ring : window.rings)
    ids.insert(ring.vertex_ids.begin(), ring.vertex_ids.end());
  EXPECT_EQ(ids, (std::set<std::uint64_t>{identity_of({50.0, 1.0}), identity_of({51.0, 1.0}),
                                          identity_of({50.0, 2.0}), identity_of({51.0, 2.0})}));
}

TEST(LayeredChart, CoverageInsideLandLeavesAHole) {
  const LayeredChart chart = over(drawn({box(50.4, 2.1, 50.6, 2.2)}, {box(50.3, 2.0, 50.7, 2.5)}),
                                  drawn({box(50.0, 1.0, 51.0, 3.0)}, {}));
  const CoastChart window = chart.load({50.5, 2.0}, metres(300000));
  EXPECT_EQ(kinds(window)[EdgeKind::seam], 4);
  EXPECT_EQ(winding_number(window, {50.1, 2.0}), 1);
  EXPECT_EQ(winding_number(window, {50.35, 2.3}), 0);
  EXPECT_EQ(winding_number(window, {50.5, 2.15}), 1);
}

TEST(LayeredChart, CellsSideBySideShareTheirLimit) {
  std::vector<std::unique_ptr<ChartSource>> charts;
  charts.push_back(drawn({box(50.0, 1.0, 50.5, 2.0)}, {box(49.0, 0.0, 52.0, 2.0)}));
  charts.push_back(drawn({box(50.0, 2.0, 50.5, 3.0)}, {box(49.0, 2.0, 52.0, 4.0)}));
  const CoastChart window = LayeredChart(std::move(charts)).load({50.5, 2.0}, metres(300000));
  auto found = kinds(window);
  EXPECT_EQ(found[EdgeKind::bin_border], 2);
  EXPECT_EQ(found[EdgeKind::seam], 0);
  EXPECT_EQ(found[EdgeKind::shoreline], 6);
}

TEST(LayeredChart, AcrossTheAntimeridian) {
  const LayeredChart chart =
      over(drawn({box(-16.8, 179.8, -16.2, 180.1)}, {box(-17.0, 179.5, -16.0, 180.5)}),
           drawn({box(-18.0, 179.0, -15.0, 181.0)}, {}));
  for (const double centre : {179.9, -179.9}) {
    const CoastChart window = chart.load({-16.5, centre}, metres(200000));
    EXPECT_EQ(winding_number(window, {-16.5, 179.9}), 1);
    EXPECT_EQ(winding_number(window, {-16.5, -179.95}), 1);
    EXPECT_EQ(winding_number(window, {-16.5, -179.7}), 0);
    EXPECT_EQ(winding_number(window, {-16.5, -179.3}), 1);
    EXPECT_EQ(winding_number(window, {-16.5, 179.3}), 1);
    EXPECT_EQ(winding_number(window, {-16.5, 178.9}), 0);
  }
}

TEST(LayeredChart, LandAroundAPoleIsCutToo) {
  Line ice;
  for (int longitude = -180; longitude < 180; longitude += 10)
    ice.push_back({-70.0 + longitude % 20 / 10, 1.0 * longitude});
  std::reverse(ice.begin(), ice.end());  // land to the south
  const LayeredChart chart = over(drawn({}, {box(-75.0, 20.0, -65.0, 30.0)}), drawn({ice}, {}));
  const CoastChart window = chart.load({-70.0, 25.0}, metres(600000));
  EXPECT_EQ(winding_number(window, {-74.0, 25.0}), 0);
  EXPECT_EQ(winding_number(window, {-76.0, 25.0}), 1);
  EXPECT_EQ(winding_number(window, {-74.0, 31.0}), 1);
  EXPECT_EQ(winding_number(window, {-74.0, 19.0}), 1);
  EXPECT_EQ(winding_number(window, {-60.0, 25.0}), 0);
}

TEST(LayeredChart, ObjectsCountWhereTheirChartIsAsked) {
  auto upper = drawn({}, {box(49.0, 2.0, 52.0, 4.0)});
  upper->add_object({50.0, 3.0});
  auto lower = drawn({box(50.0, 1.0, 51.0, 3.0)}, {});
  lower->add_object({50.1, 3.0});
  lower->add_object({50.2, 1.5});
  const CoastChart window =
      over(std::move(upper), std::move(lower)).load({50.5, 2.0}, metres(300000));
  ASSERT_EQ(window.objects.size(), 2u);
  EXPECT_EQ(window.objects[0].outline[0], (GeoPoint{50.0, 3.0}));
  EXPECT_EQ(window.objects[1].outline[0], (GeoPoint{50.2, 1.5}));
}

TEST(LayeredChart, BrokenRingsOfALowerChartDoNotStopIt) {
  // A figure of eight, cut through its middle.
  const Line eight = {{50.0, 1.0}, {51.0, 3.0}, {50.0, 3.0}, {51.0, 1.0}};
  const LayeredChart chart = over(drawn({}, {box(49.0, 2.5, 52.0, 4.0)}), drawn({eight}, {}));
  const CoastChart window = chart.load({50.5, 2.0}, metres(300000));
  for (const CoastRing& ring : window.rings) {
    for (const GeoPoint p : ring.vertices) EXPECT_LE(p.longitude_deg, 2.5);
  }
}

TEST(LayeredChart, NoChartsAreRefused) { EXPECT_THROW(LayeredChart({}), std::invalid_argument); }

struct Place {
  const char* cell;
  GeoPoint centre;
  double reach_deg;
};

class LayeredReal : public testing::TestWithParam<Place> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(enc_cell(GetParam().cell))) GTEST_SKIP() << "no chart";
    try {
      gshhg_file_ = GshhgReader::find_finest();
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
    cell_ = open_chart(enc_cell(GetParam().cell));
    layered_ = open_charts({enc_cell(GetParam().cell), gshhg_file_});
  }
  GeoPoint somewhere(std::uint64_t i) const {
    const double reach = GetParam().reach_deg * (i % 2 == 0 ? 1.0 : 0.3);
    return {GetParam().centre.latitude_deg + reach * (2.0 * as_unit(mixed(i, 1)) - 1.0),
            GetParam().centre.longitude_deg + reach * (2.0 * as_unit(mixed(i, 2)) - 1.0)};
  }

  std::filesystem::path gshhg_file_;
  OpenedChart cell_, layered_;
};

// Independent of the cutting: each chart by itself is asked where it is the highest.
TEST_P(LayeredReal, IsLandWhereTheChartAskedThereIs) {
  const Length reach = nautical_miles(40.0);
  const CoastChart merged = layered_.chart->load(GetParam().centre, reach);
  const CoastChart upper = cell_.chart->load(GetParam().centre, reach);
  const CoastChart lower = GshhgReader::open(gshhg_file_).load(GetParam().centre, reach);
  const Coverage& coverage = dynamic_cast<const CoveredChart&>(*cell_.chart).coverage();
  int land = 0, covered = 0;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    const GeoPoint place = somewhere(i);
    const bool above = coverage.contains(place);
    covered += above;
    const bool expected = is_land(above ? upper : lower, place);
    land += expected;
    ASSERT_EQ(winding_number(merged, place), expected ? 1 : 0)
        << place.latitude_deg << " " << place.longitude_deg << (above ? " covered" : "");
  }
  EXPECT_GT(covered, 500);
  EXPECT_LT(covered, 5500);
  EXPECT_GT(land, 50);
}

TEST_P(LayeredReal, RaysOverShoresAndSeamsCountTheSame) {
  const CoastChart merged = layered_.chart->load(GetParam().centre, nautical_miles(40.0));
  for (std::uint64_t i = 0; i < 1500; ++i) {
    const GeoPoint from = somewhere(i);
    const double to = from.longitude_deg + 0.3 * as_unit(mixed(i, 3));
    ASSERT_EQ(winding_number(merged, from) - winding_number(merged, {from.latitude_deg, to}),
              counted(merged, from, to))
        << from.latitude_deg << " " << from.longitude_deg << " to " << to;
  }
}

// An edge met in a small window is there, the same, in a large one and in one aside.
TEST_P(LayeredReal, EveryWindowHasTheSameCoast) {
  const auto edges = [&](GeoPoint centre, double miles) {
    std::set<std::tuple<std::uint64_t, std::uint64_t, int>> found;
    for (const CoastRing& ring : layered_.chart->load(centre, nautical_miles(miles)).rings) {
      for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
        const GeoPoint p = ring.vertices[i];
        if (std::abs(p.latitude_deg - GetParam().centre.latitude_deg) < 0.04 &&
            std::abs(p.longitude_deg - GetParam().centre.longitude_deg) < 0.04)
          found.insert(
              {ring.vertex_ids[i], ring.vertex_ids[(i + 1) % n], static_cast<int>(ring.edges[i])});
      }
    }
    return found;
  };
  const GeoPoint centre = GetParam().centre;
  const auto small = edges(centre, 4.0);
  EXPECT_EQ(small, edges(centre, 40.0));
  EXPECT_EQ(small, edges({centre.latitude_deg + 0.05, centre.longitude_deg - 0.07}, 10.0));
}

INSTANTIATE_TEST_SUITE_P(Places, LayeredReal,
                         testing::Values(Place{"US5WA22M", {47.278, -122.453}, 0.15},
                                         Place{"US5OH10M", {41.62, -82.79}, 0.35},
                                         // The corner where the cell ends and GSHHG begins.
                                         Place{"US5WA22M", {47.3254, -122.3535}, 0.2}),
                         [](const auto& place) {
                           return std::string(place.param.cell) + "_" + std::to_string(place.index);
                         });

TEST(OpenChart, KnowsChartsByTheirNames) {
  TemporaryFolder folder;
  write_text(folder / "chart.txt", "x");
  EXPECT_THAT(complaint_of([&] { open_chart(folder / "chart.txt"); }),
              testing::AllOf(testing::HasSubstr("chart.txt"), testing::HasSubstr(".000")));
  EXPECT_THAT(complaint_of([&] { open_chart(folder.path()); }),
              testing::HasSubstr("no world shoreline"));
  write_text(folder / "isle.json",
             R"({"type": "Polygon", "coordinates": [[[1,1],[2,1],[2,2],[1,1]]]})");
  EXPECT_EQ(open_chart(folder / "isle.json").chart->describe(), "chart isle.json");
}

TEST(OpenChart, ADirectoryIsAllItsCellsLargestScaleFirst) {
  if (!std::filesystem::exists(enc_cell("US5MA1BO"))) GTEST_SKIP() << "no chart";
  const OpenedChart all = open_chart(enc_cell("US5MA1BO").parent_path());
  EXPECT_THAT(all.warnings, testing::IsEmpty());
  EXPECT_EQ(all.chart->describe(),
            "ENC US5WA22M edition 40 update 2 over ENC US5MA1BO edition 2 update 0 over ENC "
            "US5OH10M edition 25 update 0");
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "US5MA1BO");
  std::filesystem::copy_file(enc_cell("US5MA1BO"), folder / "US5MA1BO" / "US5MA1BO.000");
  write_text(folder / "SPOILT.000", "no cell");
  const OpenedChart one = open_chart(folder.path());
  EXPECT_EQ(one.chart->describe(), "ENC US5MA1BO edition 2 update 0");
  ASSERT_EQ(one.warnings.size(), 1u);
  EXPECT_THAT(one.warnings[0], testing::HasSubstr("SPOILT.000"));
}

}  // namespace
}  // namespace skerry::echo
