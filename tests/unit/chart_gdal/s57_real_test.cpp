// The NOAA cells: what is known of them (facts of IHO S-57 cells by ogrinfo) is found again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "echo/chart/gdal/s57/s57_chart.hpp"
#include "echo/chart/land_mask.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct Cell {
  const char* name;
  GeoPoint centre;
  int scale;
  const char* described;
};
constexpr Cell kTacoma{"US5WA22M", {47.278, -122.453}, 15000, "ENC US5WA22M edition 40 update 2"};
constexpr Cell kSandusky{"US5OH10M", {41.62, -82.79}, 40000, "ENC US5OH10M edition 25 update 0"};
constexpr Cell kNantucket{
    "US5MA1BO", {41.2875, -70.3125}, 20000, "ENC US5MA1BO edition 2 update 0"};

class S57Real : public testing::TestWithParam<Cell> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(enc_cell(GetParam().name)))
      GTEST_SKIP() << "no chart " << enc_cell(GetParam().name);
  }
};

// Both ends of a straight piece, in units of 1e-7 degrees, in one order.
using Piece = std::array<long long, 4>;
Piece piece(double y0, double x0, double y1, double x1) {
  const auto units = [](double v) { return std::llround(v * 1e7); };
  const Piece there{units(y0), units(x0), units(y1), units(x1)};
  const Piece back{there[2], there[3], there[0], there[1]};
  return std::min(there, back);
}

void add_pieces(const OGRGeometry& geometry, std::set<Piece>& pieces) {
  const auto add = [&](const OGRSimpleCurve& line) {
    for (int i = 0; i + 1 < line.getNumPoints(); ++i)
      pieces.insert(piece(line.getY(i), line.getX(i), line.getY(i + 1), line.getX(i + 1)));
  };
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbLineString:
      add(*geometry.toLineString());
      break;
    case wkbPolygon:
      for (const OGRLinearRing* ring : *geometry.toPolygon()) add(*ring);
      break;
    case wkbMultiLineString:
      for (const OGRLineString* line : *geometry.toMultiLineString()) add(*line);
      break;
    default:
      break;
  }
}

TEST_P(S57Real, IsReadWithoutAWarning) {
  std::vector<std::string> warnings;
  const S57Chart chart = S57Chart::open(enc_cell(GetParam().name), warnings);
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(chart.describe(), GetParam().described);
  EXPECT_EQ(chart.scale(), GetParam().scale);
  EXPECT_EQ(chart.name(), GetParam().name);
}

// An edge is a shoreline where the cell draws a coastline or a construction on it.
TEST_P(S57Real, ShorelinesAreWhereTheCellDrawsThem) {
  std::vector<std::string> warnings;
  const CoastChart chart =
      S57Chart::open(enc_cell(GetParam().name), warnings).load(GetParam().centre, metres(100000));
  GDALAllRegister();
  std::set<Piece> drawn, limit;
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(enc_cell(GetParam().name).c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  ASSERT_TRUE(dataset);
  for (const char* layer_name : {"COALNE", "SLCONS", "PONTON", "LAKARE", "RIVERS", "M_COVR"}) {
    OGRLayer* layer = dataset->GetLayerByName(layer_name);
    if (layer == nullptr) continue;
    for (const auto& feature : *layer) {
      if (feature->GetGeometryRef())
        add_pieces(*feature->GetGeometryRef(), layer_name == std::string("M_COVR") ? limit : drawn);
    }
  }
  int shores = 0, undrawn = 0;
  for (const CoastRing& ring : chart.rings) {
    for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
      const GeoPoint a = ring.vertices[i], b = ring.vertices[(i + 1) % n];
      const Piece one = piece(a.latitude_deg, a.longitude_deg, b.latitude_deg, b.longitude_deg);
      if (ring.edges[i] == EdgeKind::shoreline) {
        ++shores;
        if (!drawn.contains(one)) ++undrawn;
        EXPECT_FALSE(limit.contains(one));
      }
      if (ring.edges[i] == EdgeKind::seam) {
        // Within the 1.7 cm that a limit is wide there may be an edge of a coast that meets it.
        const bool tiny = std::abs(one[0] - one[2]) <= 2 && std::abs(one[1] - one[3]) <= 2;
        EXPECT_TRUE(tiny || !drawn.contains(one));
      }
    }
  }
  std::printf("%s: %d shoreline edges, %d without a line\n", GetParam().name, shores, undrawn);
  EXPECT_LE(undrawn, shores / 100);
}

TEST_P(S57Real, WindingIsZeroOrOneEverywhere) {
  std::vector<std::string> warnings;
  const S57Chart cell = S57Chart::open(enc_cell(GetParam().name), warnings);
  const CoastChart chart = cell.load(GetParam().centre, metres(100000));
  const GeoBox box = cell.coverage().box();
  int land = 0;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 60; ++k) {
      const GeoPoint place{box.south_deg + (box.north_deg - box.south_deg) * (i + 0.37) / 60.0,
                           box.west_deg + box.width_deg * (k + 0.41) / 60.0};
      const int winding = winding_number(chart, place);
      EXPECT_TRUE(winding == 0 || winding == 1) << place.latitude_deg << " " << place.longitude_deg;
      land += winding;
      if (!cell.coverage().contains(place)) {
        EXPECT_EQ(winding, 0);
      }
    }
  }
  EXPECT_GT(land, 0);
}

INSTANTIATE_TEST_SUITE_P(Cells, S57Real, testing::Values(kTacoma, kSandusky, kNantucket),
                         [](const auto& cell) { return std::string(cell.param.name); });

std::map<ObjectClass, int> counts(const CoastChart& chart) {
  std::map<ObjectClass, int> found;
  for (const ChartObject& object : chart.objects) ++found[object.kind];
  return found;
}

class S57RealObjects : public testing::Test {
 protected:
  static CoastChart load(const Cell& cell) {
    std::vector<std::string> warnings;
    return S57Chart::open(enc_cell(cell.name), warnings).load(cell.centre, metres(100000));
  }
};

// ogrinfo counts: 3 BOYLAT, 10 BOYSPP and 11 MORFAC of CATMOR 7; 30 BCN*; 582 PONTON and 5 HULKES;
// 358 PILPNT and 103 MORFAC of CATMOR 1; 447 BUISGL and 110 SILTNK; 18 BRIDGE and 1 CONVYR;
// 16 LNDMRK, 2 PYLONS and 6 CRANES.
TEST_F(S57RealObjects, Tacoma) {
  if (!std::filesystem::exists(enc_cell("US5WA22M"))) GTEST_SKIP() << "no chart";
  const CoastChart chart = load(kTacoma);
  auto found = counts(chart);
  EXPECT_EQ(found[ObjectClass::buoy], 24);
  EXPECT_EQ(found[ObjectClass::beacon], 30);
  EXPECT_EQ(found[ObjectClass::pontoon], 587);
  EXPECT_EQ(found[ObjectClass::pile], 461);
  EXPECT_EQ(found[ObjectClass::building], 557);
  EXPECT_EQ(found[ObjectClass::bridge], 19);
  EXPECT_EQ(found[ObjectClass::landmark], 18);
  EXPECT_GT(found[ObjectClass::pier], 300);
  EXPECT_EQ(found[ObjectClass::racon], 0);
  float highest = 0.0f;
  for (const ChartObject& object : chart.objects) {
    EXPECT_FALSE(object.outline.empty());
    EXPECT_GT(object.height_m, 0.0f);
    highest = std::max(highest, object.height_m);
  }
  EXPECT_FLOAT_EQ(highest, 290.4f);  // the charted chimney
}

// 3 BOYCAR, 18 BOYLAT, 13 BOYSPP and 2 LITFLT; 4 BCNLAT and 4 BCNSPP; 34 BUISGL and 5 SILTNK;
// 23 BRIDGE; 15 LNDMRK and 6 PYLONS; 23 LNDARE drawn as points.
TEST_F(S57RealObjects, Sandusky) {
  if (!std::filesystem::exists(enc_cell("US5OH10M"))) GTEST_SKIP() << "no chart";
  auto found = counts(load(kSandusky));
  EXPECT_EQ(found[ObjectClass::buoy], 36);
  EXPECT_EQ(found[ObjectClass::beacon], 8);
  EXPECT_EQ(found[ObjectClass::building], 39);
  EXPECT_EQ(found[ObjectClass::bridge], 23);
  EXPECT_EQ(found[ObjectClass::landmark], 21);
  EXPECT_EQ(found[ObjectClass::pile], 4);
  EXPECT_GE(found[ObjectClass::rock], 23);
}

class S57Updates : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(enc_cell("US5WA22M"))) GTEST_SKIP() << "no chart";
    for (const int update : {0, 1, 2}) {
      std::filesystem::path from = enc_cell("US5WA22M");
      from.replace_extension(ending(update));
      files_.push_back(bytes_of(from));
    }
    write_bytes(cell_, files_[0]);
  }
  static std::string ending(int update) { return ".00" + std::to_string(update); }
  void put(int update, const std::vector<std::uint8_t>& bytes) {
    write_bytes(folder_ / ("US5WA22M" + ending(update)), bytes);
  }
  S57Chart open() { return S57Chart::open(cell_, warnings_); }

  TemporaryFolder folder_;
  std::filesystem::path cell_ = folder_ / "US5WA22M.000";
  std::vector<std::vector<std::uint8_t>> files_;
  std::vector<std::string> warnings_;
};

TEST_F(S57Updates, AreAppliedInTurn) {
  const std::size_t before = open().load(kTacoma.centre, metres(100000)).objects.size();
  EXPECT_EQ(open().describe(), "ENC US5WA22M edition 40 update 0");
  put(1, files_[1]);
  EXPECT_EQ(open().describe(), "ENC US5WA22M edition 40 update 1");
  put(2, files_[2]);
  const S57Chart newest = open();
  EXPECT_EQ(newest.describe(), "ENC US5WA22M edition 40 update 2");
  // Update 1 charts a floating breakwater as an obstruction; update 2 charts an object anew.
  EXPECT_NE(newest.load(kTacoma.centre, metres(100000)).objects.size(), 0u);
  EXPECT_GE(newest.load(kTacoma.centre, metres(100000)).objects.size(), before);
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(S57Updates, AMissingOneIsNamedAndLaterOnesAreNotApplied) {
  put(2, files_[2]);
  EXPECT_EQ(open().describe(), "ENC US5WA22M edition 40 update 0");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("US5WA22M.000: update 1 is missing"));
  EXPECT_THAT(warnings_[0], HasSubstr("put US5WA22M.001 beside it"));
}

TEST_F(S57Updates, ADamagedOneIsNamedAndNoneIsApplied) {
  put(1, files_[1]);
  files_[2].resize(files_[2].size() - 40);
  put(2, files_[2]);
  EXPECT_EQ(open().describe(), "ENC US5WA22M edition 40 update 0");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("US5WA22M.002"));
  EXPECT_THAT(warnings_[0], HasSubstr("no update is applied"));
}

TEST_F(S57Updates, OneOfAnotherNumberOrEditionIsNotApplied) {
  put(1, files_[2]);
  EXPECT_EQ(open().describe(), "ENC US5WA22M edition 40 update 0");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("holds update 2 of edition 40, expected update 1"));
}

TEST_F(S57Updates, OneThatChangesWhatIsNotThereIsNotApplied) {
  // The record that it changes is asked for under another number.
  std::vector<std::uint8_t> update = files_[1];
  const std::string tag = "FSPC0625FSPT0931";
  const auto at = std::search(update.begin(), update.end(), tag.begin(), tag.end());
  ASSERT_NE(at, update.end());
  // Behind the directory: record number (3), FRID (RCNM, then RCID).
  *(at + static_cast<std::ptrdiff_t>(tag.size()) + 1 + 3 + 1 + 2) ^= 0x70;
  put(1, update);
  EXPECT_EQ(open().describe(), "ENC US5WA22M edition 40 update 0");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("its updates do not fit it"));
}

}  // namespace
}  // namespace skerry::echo
