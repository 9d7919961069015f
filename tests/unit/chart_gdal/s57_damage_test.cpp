// Cells that are cut short, spoilt, or no cells at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "echo/chart/gdal/s57/cell_file.hpp"
#include "echo/chart/gdal/s57/s57_chart.hpp"
#include "echo/chart/land_mask.hpp"
#include "echo/kernel/hash.hpp"
#include "tests/unit/chart_gdal/geo_box.hpp"
#include "tests/unit/chart_gdal/made_cell.hpp"
#include "tests/unit/chart_gdal/temporary_folder.hpp"

namespace skerry::echo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class S57Damage : public testing::Test {
 protected:
  void SetUp() override {
    MadeCell cell;
    cell.area("M_COVR", {box(50.0, -1.0, 50.1, -0.9)}, {{"CATCOV", "1"}});
    cell.area("LNDARE", {{{50.0, -1.0}, {50.0, -0.97}, {50.1, -0.96}, {50.1, -1.0}}});
    cell.line("COALNE", {{50.0, -0.97}, {50.1, -0.96}}, {{"CATCOA", "3"}});
    cell.point("BOYLAT", {50.05, -0.92}, {{"BOYSHP", "4"}, {"OBJNAM", "No 1"}});
    cell.write(file_);
    bytes_ = bytes_of(file_);
    ASSERT_GT(bytes_.size(), 1000u);
  }
  // The error of opening these bytes.
  std::string refusal(const std::vector<std::uint8_t>& bytes) {
    write_bytes(file_, bytes);
    return complaint_of([&] { S57Chart::open(file_, warnings_); });
  }
  // Opens them; whatever comes out must be sound.
  bool opens(const std::vector<std::uint8_t>& bytes) {
    write_bytes(file_, bytes);
    try {
      const CoastChart chart =
          S57Chart::open(file_, warnings_).load({41.29, -70.31}, metres(2.1e7));
      for (const CoastRing& ring : chart.rings) {
        EXPECT_GE(ring.vertices.size(), 3u);
        EXPECT_EQ(ring.vertices.size(), ring.edges.size());
        EXPECT_EQ(ring.vertices.size(), ring.vertex_ids.size());
        EXPECT_EQ(ring.vertices.size(), ring.shores.size());
        for (const GeoPoint p : ring.vertices)
          EXPECT_TRUE(std::abs(p.latitude_deg) <= 90.0 && std::abs(p.longitude_deg) <= 180.0);
      }
      return true;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("TEST0001.000"));
      return false;
    }
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "TEST0001.000";
  std::vector<std::uint8_t> bytes_;
  std::vector<std::string> warnings_;
};

TEST_F(S57Damage, CutAtAnyByteItIsRefused) {
  for (std::size_t size = 0; size < bytes_.size(); ++size) {
    const std::vector<std::uint8_t> part(bytes_.begin(),
                                         bytes_.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(check_cell(part, "x"), std::runtime_error) << size << " bytes";
  }
  EXPECT_NO_THROW(check_cell(bytes_, "x"));
}

TEST_F(S57Damage, TheReasonNamesFileRecordAndByte) {
  std::vector<std::uint8_t> part = bytes_;
  part.resize(part.size() - 10);
  EXPECT_THAT(refusal(part), AllOf(HasSubstr("TEST0001.000"), HasSubstr("record "),
                                   HasSubstr("at byte "), HasSubstr("bytes, the file has")));
  EXPECT_THAT(refusal({}), HasSubstr("no data records"));
}

TEST_F(S57Damage, AMissingRecordIsRefused) {
  // The last record taken out whole: its length stands in its first five digits.
  std::size_t at = 0, last = 0;
  while (at < bytes_.size()) {
    last = at;
    at += std::stoul(std::string(bytes_.begin() + static_cast<std::ptrdiff_t>(at),
                                 bytes_.begin() + static_cast<std::ptrdiff_t>(at) + 5));
  }
  std::vector<std::uint8_t> part = bytes_;
  part.resize(last);
  EXPECT_THAT(refusal(part), HasSubstr("field DSSI states 4 features, the file holds 3"));
}

TEST_F(S57Damage, OtherFilesAreRefused) {
  const auto text = [](std::string_view s) {
    return std::vector<std::uint8_t>(s.begin(), s.end());
  };
  EXPECT_THAT(refusal(text("{\"type\": \"FeatureCollection\", \"features\": []}, and more text")),
              HasSubstr("no S-57 cell"));
  std::vector<std::uint8_t> noise(5000);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<std::uint8_t>(mixed(i));
  EXPECT_THAT(refusal(noise), HasSubstr("no S-57 cell"));
  EXPECT_THAT(complaint_of([&] { S57Chart::open(folder_ / "none.000", warnings_); }),
              HasSubstr("none.000"));
  EXPECT_THAT(complaint_of([&] { S57Chart::open(folder_.path(), warnings_); }),
              HasSubstr("cannot read chart file"));
}

TEST_F(S57Damage, AnyByteOfAMadeCellMayBeSpoilt) {
  int opened = 0, refused = 0;
  for (std::size_t i = 0; i < bytes_.size(); i += 7) {
    std::vector<std::uint8_t> spoilt = bytes_;
    spoilt[i] ^= static_cast<std::uint8_t>(1 + mixed(i) % 255);
    ++(opens(spoilt) ? opened : refused);
  }
  std::printf("of %d spoilt cells %d opened\n", opened + refused, opened);
  EXPECT_GT(opened, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(S57Damage, ARealCellMayBeSpoiltInAnyPlace) {
  if (!std::filesystem::exists(enc_cell("US5MA1BO"))) GTEST_SKIP() << "no chart";
  const std::vector<std::uint8_t> whole = bytes_of(enc_cell("US5MA1BO"));
  int opened = 0, refused = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    std::vector<std::uint8_t> spoilt = whole;
    if (i % 5 == 0) {
      spoilt.resize(mixed(i, 1) % whole.size());
    } else {
      for (std::uint64_t k = 0; k < 1 + i % 3; ++k)
        spoilt[mixed(i, 2, k) % whole.size()] = static_cast<std::uint8_t>(mixed(i, 3, k));
    }
    ++(opens(spoilt) ? opened : refused);
  }
  std::printf("of %d spoilt cells %d opened\n", opened + refused, opened);
  EXPECT_GT(opened, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(S57Damage, AnObjectWithoutItsGeometryIsNamedAndTheRestUsed) {
  // A line (USAG 255) on an edge: made one that does not exist.
  std::vector<std::uint8_t> spoilt = bytes_;
  for (std::size_t i = 0; i + 8 < spoilt.size(); ++i) {
    if (spoilt[i] == 130 && spoilt[i + 2] == 0 && spoilt[i + 5] < 3 && spoilt[i + 6] == 255)
      spoilt[i + 1] = 200;
  }
  write_bytes(file_, spoilt);
  const CoastChart chart = S57Chart::open(file_, warnings_).load({50.05, -0.95}, metres(20000));
  ASSERT_FALSE(warnings_.empty());
  EXPECT_THAT(warnings_[0], AllOf(HasSubstr("TEST0001.000: COALNE 021C"), HasSubstr("left out")));
  EXPECT_TRUE(is_land(chart, {50.05, -0.99}));
  EXPECT_EQ(chart.objects.size(), 1u);
}

TEST_F(S57Damage, AnObjectOfAnUnknownClassIsCounted) {
  // BOYLAT is class 17; made 20017, of no catalogue.
  std::vector<std::uint8_t> spoilt = bytes_;
  const std::vector<std::uint8_t> point = {1, 2, 17, 0};  // PRIM, GRUP, OBJL
  const auto at = std::search(spoilt.begin(), spoilt.end(), point.begin(), point.end());
  ASSERT_NE(at, spoilt.end());
  *(at + 2) = 20017 & 0xFF;
  *(at + 3) = 20017 >> 8;
  write_bytes(file_, spoilt);
  const CoastChart chart = S57Chart::open(file_, warnings_).load({50.05, -0.95}, metres(20000));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_THAT(warnings_[0], HasSubstr("1 objects of the unknown class 20017; left out"));
  EXPECT_TRUE(chart.objects.empty());
}

}  // namespace
}  // namespace skerry::echo
