#include "protocol/video/scan_geometry.hpp"

#include <gtest/gtest.h>

namespace skerry {
namespace {

TEST(ScanGeometry, AcceptsExactlyItsLimits) {
  EXPECT_TRUE(ScanGeometry{}.valid());
  EXPECT_TRUE((ScanGeometry{128, 128, 4}.valid()));
  EXPECT_TRUE((ScanGeometry{8192, 4096, 8}.valid()));
  EXPECT_FALSE((ScanGeometry{127, 256, 8}.valid()));
  EXPECT_FALSE((ScanGeometry{8193, 256, 8}.valid()));
  EXPECT_FALSE((ScanGeometry{256, 127, 8}.valid()));
  EXPECT_FALSE((ScanGeometry{256, 4097, 8}.valid()));
  for (std::uint32_t bits = 0; bits <= 64; ++bits) {
    EXPECT_EQ((ScanGeometry{256, 256, bits}.valid()), bits == 4 || bits == 8) << bits;
  }
}

TEST(ScanGeometry, CellsFillTheRangeScale) {
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    for (std::uint32_t cells = 256; cells <= 4096; cells += 31) {
      const ScanGeometry geometry{4096, cells, 8};
      ASSERT_NEAR((geometry.cell_size(scale) * cells).in_metres(), scale.length().in_metres(),
                  1e-9 * scale.length().in_metres());
    }
  }
}

}  // namespace
}  // namespace skerry
