#include "protocol/picture/ppi_raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct PixelPlace {
  int x, y;
};

// The pixel of a direction clockwise from the top and a fraction of the scale, by trigonometry.
PixelPlace pixel_of(const PpiFrame& frame, double from_top_deg, double fraction) {
  return {static_cast<int>(std::floor(frame.size / 2.0 +
                                      frame.radius * fraction * std::sin(from_top_deg * kDegree))),
          static_cast<int>(std::floor(frame.size / 2.0 -
                                      frame.radius * fraction * std::cos(from_top_deg * kDegree)))};
}

std::uint8_t level_at(const PpiRaster& raster, PixelPlace at) {
  return raster.level[static_cast<std::size_t>(at.y) * raster.size + at.x];
}
PixelKind kind_at(const PpiRaster& raster, PixelPlace at) {
  return raster.kind[static_cast<std::size_t>(at.y) * raster.size + at.x];
}

double wrapped(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

// Every pixel by brute force over all spokes and cells, straight from the rule in the header.
std::vector<int> reference(const Scan& scan, const PpiFrame& frame, double heading_deg) {
  const std::uint32_t spokes = scan.geometry.spokes_per_turn, cells = scan.geometry.cells;
  const double step = 360.0 / spokes;
  const double turned = frame.orientation == Orientation::north_up ? heading_deg : 0.0;
  std::vector<int> levels(static_cast<std::size_t>(frame.size) * frame.size, 0);
  for (int y = 0; y < frame.size; ++y) {
    for (int x = 0; x < frame.size; ++x) {
      const double right = x + 0.5 - frame.size / 2.0, up = frame.size / 2.0 - y - 0.5;
      const double fraction = std::sqrt(right * right + up * up) / frame.radius;
      if (fraction > 1.0) continue;
      const double position = wrapped(std::atan2(right, up) / kDegree - turned) / step;
      const double off = std::abs(position - std::floor(position) - 0.5);
      int& level = levels[static_cast<std::size_t>(y) * frame.size + x];
      if (off < 0.006 / step) {
        level = -1;  // on the border between two spokes
        continue;
      }
      const auto index = static_cast<std::uint32_t>(std::floor(position + 0.5)) % spokes;
      const auto cell = static_cast<std::uint32_t>(fraction * cells);
      if (cell < cells) level = scan.spokes[index]->cells[cell];
    }
  }
  for (std::uint32_t i = 0; i < spokes; ++i) {
    for (std::uint32_t n = 0; n < cells; ++n) {
      const PixelPlace at = pixel_of(frame, turned + i * step, (n + 0.5) / cells);
      int& level = levels[static_cast<std::size_t>(at.y) * frame.size + at.x];
      if (level >= 0) level = std::max<int>(level, scan.spokes[i]->cells[n]);
    }
  }
  return levels;
}

void compare_with_reference(int size, const ScanGeometry& geometry, Orientation orientation) {
  std::mt19937 random(12345);
  const double heading = 73.4;
  const Scan scan = scan_of(geometry, heading, [&](Spoke& spoke) {
    for (auto& cell : spoke.cells) cell = static_cast<std::uint8_t>(random() & 0xff);
  });
  const PpiFrame frame{.size = size, .radius = 0.45 * size, .orientation = orientation};
  const PpiRaster raster = rasterise(scan, frame);
  const auto expected = reference(scan, frame, heading);
  int compared = 0, different = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * size + x;
      const double radius = std::hypot(x + 0.5 - size / 2.0, y + 0.5 - size / 2.0);
      if (expected[pixel] < 0 || std::abs(radius - frame.radius) < 1.5) continue;
      ++compared;
      different += raster.level[pixel] != expected[pixel] ? 1 : 0;
    }
  }
  EXPECT_GT(compared, size * size * 9 / 10);
  // Cell centres within rounding of a pixel's border may fall on either side.
  EXPECT_LE(different, compared / 2000);
}

TEST(PpiRaster, AgreesWithBruteForceWhenTheImageIsFiner) {
  compare_with_reference(900, kSmall, Orientation::north_up);
  compare_with_reference(900, kSmall, Orientation::head_up);
}

TEST(PpiRaster, AgreesWithBruteForceWhenTheImageIsCoarser) {
  const ScanGeometry fine{.spokes_per_turn = 1024, .cells = 512, .bits = 8};
  compare_with_reference(150, fine, Orientation::north_up);
  compare_with_reference(150, fine, Orientation::head_up);
}

TEST(PpiRaster, PutsATargetOnItsBearingAndRange) {
  const ScanGeometry geometry{.spokes_per_turn = 2048, .cells = 1024, .bits = 8};
  for (const double heading : {0.0, 37.3, 90.0, 180.0, 271.9, 359.9}) {
    for (const double bearing : {0.0, 45.0, 123.4, 250.0, 359.8}) {
      const double relative = wrapped(bearing - heading);
      const auto index = TrueBearing::from(degrees(relative)).nearest_spoke(2048);
      const Scan scan = scan_of(geometry, heading, [&](Spoke& spoke) {
        if (spoke.header.index == index) spoke.cells[700] = 200;
      });
      for (const auto orientation : {Orientation::north_up, Orientation::head_up}) {
        const PpiFrame frame{.size = 600, .radius = 280, .orientation = orientation};
        const PpiRaster raster = rasterise(scan, frame);
        const double up = orientation == Orientation::north_up ? bearing : relative;
        const double x = 300 + 280 * (700.5 / 1024) * std::sin(up * kDegree);
        const double y = 300 - 280 * (700.5 / 1024) * std::cos(up * kDegree);
        int lit = 0;
        for (int py = 0; py < 600; ++py) {
          for (int px = 0; px < 600; ++px) {
            if (raster.level[static_cast<std::size_t>(py) * 600 + px] == 0) continue;
            ++lit;
            EXPECT_LE(std::hypot(px + 0.5 - x, py + 0.5 - y), 1.5)
                << "heading " << heading << ", bearing " << bearing;
          }
        }
        EXPECT_GE(lit, 1);
        EXPECT_LE(lit, 3);
      }
    }
  }
}

TEST(PpiRaster, LosesNoTargetInAnImageCoarserThanTheVideo) {
  const ScanGeometry geometry{.spokes_per_turn = 4096, .cells = 1024, .bits = 8};
  const PpiFrame frame{.size = 128, .radius = 60};
  std::mt19937 random(7);
  Scan scan = empty_scan(geometry, 12.5);
  for (int k = 0; k < 300; ++k) {
    const std::uint32_t index = random() % 4096, cell = random() % 1024;
    scan.spokes[index]->cells[cell] = 255;
    const PpiRaster raster = rasterise(scan, frame);
    EXPECT_EQ(level_at(raster, pixel_of(frame, 12.5 + index * 360.0 / 4096, (cell + 0.5) / 1024)),
              255)
        << "spoke " << index << ", cell " << cell;
    scan.spokes[index]->cells[cell] = 0;
  }
}

TEST(PpiRaster, MarksTheWedgeOfMissingSpokes) {
  Scan scan = scan_of(kSmall, 90.0, [](Spoke& spoke) { spoke.cells.assign(256, 50); });
  for (std::uint32_t i = 64; i < 96; ++i) remove_spoke(scan, i);  // 90 to 135 deg off the bow
  const PpiFrame north{.size = 400, .radius = 190};
  const PpiRaster by_north = rasterise(scan, north);
  EXPECT_EQ(kind_at(by_north, pixel_of(north, 200.0, 0.7)), PixelKind::missing);
  EXPECT_EQ(kind_at(by_north, pixel_of(north, 110.0, 0.7)), PixelKind::video);
  const PpiFrame head{.size = 400, .radius = 190, .orientation = Orientation::head_up};
  const PpiRaster by_head = rasterise(scan, head);
  EXPECT_EQ(kind_at(by_head, pixel_of(head, 110.0, 0.7)), PixelKind::missing);
  EXPECT_EQ(kind_at(by_head, pixel_of(head, 200.0, 0.7)), PixelKind::video);
  EXPECT_EQ(kind_at(by_head, {1, 1}), PixelKind::outside);
  std::size_t missing = 0, all = 0;
  for (const PixelKind kind : by_head.kind) {
    missing += kind == PixelKind::missing ? 1 : 0;
    all += kind != PixelKind::outside ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(missing) / static_cast<double>(all), 32.0 / 256.0, 0.01);
}

TEST(PpiRaster, DrawsACompleteScanWithoutSlivers) {
  for (const std::uint32_t spokes : {256u, 1000u, 3333u, 8192u}) {
    const ScanGeometry geometry{.spokes_per_turn = spokes, .cells = 256, .bits = 8};
    const Scan scan = scan_of(geometry, 211.7, [](Spoke& spoke) { spoke.cells.assign(256, 9); });
    for (const auto orientation : {Orientation::north_up, Orientation::head_up}) {
      const PpiRaster raster =
          rasterise(scan, {.size = 700, .radius = 340, .orientation = orientation});
      for (const PixelKind kind : raster.kind) {
        ASSERT_TRUE(kind == PixelKind::video || kind == PixelKind::outside) << spokes;
      }
    }
  }
}

// The ship turned 6 degrees to port during the turn: the sector between where the bow pointed at
// its end and at its beginning was never swept, and each target stands at its own true bearing.
TEST(PpiRaster, LeavesUnsweptWhatATurningShipDidNotLookAt) {
  const Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    const double heading = 40.0 - 6.0 * spoke.header.index / 256.0;
    spoke.header.heading = TrueBearing::from(degrees(heading));
    spoke.cells.assign(256, 20);
    if (spoke.header.index == 128) spoke.cells[200] = 250;
  });
  const PpiFrame frame{.size = 800, .radius = 390};
  const PpiRaster raster = rasterise(scan, frame);
  EXPECT_EQ(kind_at(raster, pixel_of(frame, 37.0, 0.8)), PixelKind::unswept);
  EXPECT_EQ(kind_at(raster, pixel_of(frame, 41.0, 0.8)), PixelKind::video);
  EXPECT_EQ(kind_at(raster, pixel_of(frame, 32.0, 0.8)), PixelKind::video);
  EXPECT_EQ(level_at(raster, pixel_of(frame, 37.0 + 180.0, 200.5 / 256)), 250);
}

// To starboard, the last spokes look where the first ones did: the newer ones show.
TEST(PpiRaster, ShowsTheNewerSpokeWhereTheyOverlap) {
  const Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    const double heading = 40.0 + 6.0 * spoke.header.index / 256.0;
    spoke.header.heading = TrueBearing::from(degrees(heading));
    spoke.cells.assign(256, spoke.header.index < 128 ? 200 : 30);
  });
  const PpiFrame frame{.size = 800, .radius = 390};
  const PpiRaster raster = rasterise(scan, frame);
  EXPECT_EQ(level_at(raster, pixel_of(frame, 42.5, 0.8)), 30);
  EXPECT_EQ(level_at(raster, pixel_of(frame, 60.0, 0.8)), 200);
}

TEST(PpiRaster, DrawsSpokesOfAnotherRangeScaleAtTheirOwnRange) {
  const Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    if (spoke.header.index != 64) return;  // 90 deg; all others have 12 NM
    spoke.header.range_scale = *RangeScale::find(6.0);
    spoke.cells[128] = 240;
  });
  const PpiFrame frame{.size = 400, .radius = 190};
  const PpiRaster raster = rasterise(scan, frame);
  EXPECT_EQ(level_at(raster, pixel_of(frame, 90.0, 0.25 + 0.25 / 256)), 240);
  EXPECT_EQ(level_at(raster, pixel_of(frame, 90.0, 0.5)), 0);
  EXPECT_EQ(level_at(raster, pixel_of(frame, 90.0, 0.9)), 0);
}

TEST(PpiRaster, SpreadsFourBitCellsOverAllLevels) {
  const ScanGeometry geometry{.spokes_per_turn = 256, .cells = 256, .bits = 4};
  const Scan scan = scan_of(geometry, 0.0, [](Spoke& spoke) { spoke.cells.assign(256, 15); });
  const PpiFrame frame{.size = 100, .radius = 45};
  EXPECT_EQ(level_at(rasterise(scan, frame), {70, 50}), 255);
}

TEST(PpiRaster, HasTheDopplerClassOfTheCellThatIsShown) {
  const PpiFrame frame{.size = 64, .radius = 30};  // 8 cells to a pixel
  EXPECT_TRUE(rasterise(empty_scan(kSmall, 0.0), frame).doppler.empty());
  const Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    spoke.cells[100] = 50;
    spoke.cells[102] = 40;
    if (spoke.header.index >= 128) return;  // the port half has none
    spoke.doppler.assign(256, DopplerClass::none);
    spoke.doppler[100] = DopplerClass::receding;
    spoke.doppler[102] = DopplerClass::approaching;
  });
  const PpiRaster raster = rasterise(scan, frame);
  const auto class_at = [&](double degrees) {
    const PixelPlace at = pixel_of(frame, degrees, 100.5 / 256);
    EXPECT_EQ(level_at(raster, at), 50);
    return raster.doppler[static_cast<std::size_t>(at.y) * 64 + at.x];
  };
  EXPECT_EQ(class_at(90.0), DopplerClass::receding) << "the stronger of two in the pixel";
  EXPECT_EQ(class_at(270.0), DopplerClass::none);
}

TEST(PpiRaster, DrawsCellsWithinTheRangeScaleWhereverTheLastOneEnds) {
  for (const double share : {0.5, 1.5, 2.0}) {
    const Scan scan = scan_of(kSmall, 0.0, [&](Spoke& spoke) {
      spoke.header.instrumented_range = spoke.header.range_scale.length() * share;
      spoke.cells.assign(256, 0);
      const auto cell = static_cast<std::size_t>(256 * 0.4 / share);
      spoke.cells[cell] = 200;
    });
    const PpiFrame frame{.size = 200, .radius = 90};
    const PpiRaster raster = rasterise(scan, frame);
    int nearest = 200;
    for (int x = 100; x < 200; ++x) {
      if (level_at(raster, {x, 100}) == 200) nearest = std::min(nearest, x - 100);
    }
    EXPECT_NEAR(nearest, 36, 1) << share;
  }
}

TEST(PpiRaster, ShowsAScanWithoutSpokesAsMissing) {
  Scan scan = empty_scan(kSmall, 0.0);
  for (std::uint32_t i = 0; i < 256; ++i) remove_spoke(scan, i);
  const PpiFrame frame{.size = 100, .radius = 45};
  EXPECT_EQ(kind_at(rasterise(scan, frame), {50, 30}), PixelKind::missing);
}

}  // namespace
}  // namespace skerry
