#include "protocol/picture/ppi_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "protocol/picture/label_text.hpp"
#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry {
namespace {

PpiOptions bare(int size) {
  return {.size = size, .range_rings = false, .heading_line = false, .labels = false};
}

Rgba pixel(const RgbaImage& image, double from_top_deg, double radius) {
  const double angle = from_top_deg * std::numbers::pi / 180.0;
  return image.at(static_cast<int>(image.width / 2.0 + radius * std::sin(angle)),
                  static_cast<int>(image.height / 2.0 - radius * std::cos(angle)));
}

// Radii at which something brighter than the background stands in that direction, one per stroke.
std::vector<double> bright_radii(const RgbaImage& image, double from_top_deg, double until,
                                 Rgba background) {
  std::vector<double> found;
  double begun = 0.0;
  bool inside = false;
  for (double radius = 2.0; radius < until; radius += 0.25) {
    const bool bright = !(pixel(image, from_top_deg, radius) == background);
    if (bright && !inside) begun = radius;
    if (!bright && inside) found.push_back(0.5 * (begun + radius));
    inside = bright;
  }
  return found;
}

TEST(PpiPicture, DrawsTheRingsOfTheRangeScale) {
  for (const double nm : {0.125, 1.5, 12.0, 96.0}) {
    const RangeScale scale = *RangeScale::find(nm);
    const Scan scan = scan_of(kSmall, 0.0, [&](Spoke& spoke) { spoke.header.range_scale = scale; });
    PpiOptions options = bare(800);
    options.range_rings = true;
    const PpiFrame frame = frame_of(options);
    const auto radii = bright_radii(draw_ppi(scan, options, {}), 17.0, frame.radius - 4.0,
                                    colours_of(options.palette)[0]);
    ASSERT_EQ(radii.size(), static_cast<std::size_t>(scale.ring_count() - 1)) << nm;
    for (std::size_t n = 0; n < radii.size(); ++n) {
      EXPECT_NEAR(radii[n], frame.radius * static_cast<double>(n + 1) / scale.ring_count(), 1.0);
    }
  }
}

TEST(PpiPicture, DrawsTheHeadingLineOverTheBow) {
  const Scan scan = empty_scan(kSmall, 75.0);
  PpiOptions options = bare(600);
  options.heading_line = true;
  const Rgba background = colours_of(options.palette)[0];
  const RgbaImage north = draw_ppi(scan, options, {});
  options.orientation = Orientation::head_up;
  const RgbaImage head = draw_ppi(scan, options, {});
  for (double radius = 10.0; radius < 240.0; radius += 10.0) {
    EXPECT_FALSE(pixel(north, 75.0, radius) == background);
    EXPECT_FALSE(pixel(head, 0.0, radius) == background);
  }
  EXPECT_EQ(pixel(north, 0.0, 200.0), background);
  EXPECT_EQ(pixel(head, 75.0, 200.0), background);
}

TEST(PpiPicture, ColoursEchoesByTheirLevel) {
  const Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    spoke.cells.assign(256, static_cast<std::uint8_t>(spoke.header.index));
  });
  for (const Palette palette : {Palette::amber, Palette::green}) {
    PpiOptions options = bare(600);
    options.palette = palette;
    const RgbaImage image = draw_ppi(scan, options, {});
    for (const std::uint32_t index : {20u, 64u, 200u}) {
      EXPECT_EQ(pixel(image, index * 360.0 / 256.0, 200.0), colours_of(palette)[index]);
    }
  }
}

TEST(PpiPicture, ColoursWhatComesNearerRedAndWhatGoesAwayBlue) {
  const Scan scan = scan_of(kSmall, 0.0, [](Spoke& spoke) {
    spoke.cells.assign(256, 180);
    spoke.doppler.assign(256, static_cast<DopplerClass>(spoke.header.index / 86));
  });
  const RgbaImage image = draw_ppi(scan, bare(600), {});
  const Rgba still = pixel(image, 60.0, 200.0), nearer = pixel(image, 180.0, 200.0),
             away = pixel(image, 300.0, 200.0);
  EXPECT_EQ(still, colours_of(Palette::amber)[180]);
  EXPECT_EQ(nearer, colours_of(DopplerClass::approaching, Palette::amber)[180]);
  EXPECT_EQ(away, colours_of(DopplerClass::receding, Palette::amber)[180]);
  EXPECT_GT(nearer.red, 2 * std::max(nearer.green, nearer.blue));
  EXPECT_GT(away.blue, 1.3 * std::max(away.red, away.green));
}

TEST(PpiPicture, GrowsBrighterWithTheLevel) {
  for (const Palette palette : {Palette::amber, Palette::green}) {
    const auto colours = colours_of(palette);
    for (std::size_t level = 1; level < colours.size(); ++level) {
      const auto sum = [&](std::size_t k) {
        return colours[k].red + colours[k].green + colours[k].blue;
      };
      EXPECT_GE(sum(level), sum(level - 1)) << level;
    }
    EXPECT_GT(colours[255].green, 200);
    EXPECT_LT(colours[0].green, 20);
  }
}

TEST(PpiPicture, WritesLabelsOnlyWhereTheyWereAskedForAndFit) {
  const Scan scan = empty_scan(kSmall, 0.0);
  const auto text_pixels = [&](int size, bool labels) {
    PpiOptions options = bare(size);
    options.labels = labels;
    const RgbaImage image = draw_ppi(scan, options, {.radar = "MAST"});
    const Rgba corner = image.at(0, 0);
    int count = 0;
    for (int y = 0; y < size / 10; ++y) {
      for (int x = 0; x < size / 5; ++x) count += image.at(x, y) == corner ? 0 : 1;
    }
    return count;
  };
  EXPECT_EQ(text_pixels(1024, false), 0);
  EXPECT_GT(text_pixels(1024, true), 300);
  EXPECT_EQ(text_pixels(128, true), 0);
}

TEST(PpiPicture, DrawsEveryPermittedSizeAndAScanWithoutSpokes) {
  Scan scan = empty_scan(kSmall, 0.0);
  for (std::uint32_t i = 0; i < 256; ++i) remove_spoke(scan, i);
  for (const int size : {kMinPictureSize, kLabelSize, 1023}) {
    EXPECT_EQ(draw_ppi(scan, {.size = size}, {}).pixels.size(),
              static_cast<std::size_t>(size) * size);
  }
}

TEST(LabelText, SaysWhatTheScanShows) {
  Scan scan = empty_scan(kSmall, 9.96);
  remove_spoke(scan, 3);
  PpiLabels labels{.radar = "X-BAND\x1b[2J"};
  labels.settings.emplace().set_gain(55);
  labels.own_ship.emplace().set_name("SKARV");
  const LabelText text = label_text(scan, Orientation::head_up, labels);
  EXPECT_EQ(text.top_left[0].text, "X-BAND?[2J");
  EXPECT_EQ(text.top_left[1].text, "RANGE 12 NM");
  EXPECT_EQ(text.top_left[2].text, "RINGS 2 NM");
  EXPECT_EQ(text.top_right[0].text, "SKARV");
  EXPECT_EQ(text.top_right[1].text, "HDG 010.0^");
  EXPECT_EQ(text.bottom_left[0].text, "GAIN 55");
  EXPECT_EQ(text.bottom_right[0].text, "1 OF 256 LOST");
  EXPECT_TRUE(text.bottom_right[0].warning);
  labels.own_ship->set_no_heading(true);
  labels.own_ship->set_no_position(true);
  labels.own_ship->set_no_motion(true);
  const LabelText untold = label_text(scan, Orientation::head_up, labels);
  ASSERT_EQ(untold.top_right.size(), 4u);
  EXPECT_EQ(untold.top_right[1].text, "HDG ---");
  EXPECT_EQ(untold.top_right[2].text, "SPD --- KN");
  EXPECT_EQ(untold.top_right[3].text, "NO POSITION");
  labels.settings.reset();
  labels.formed_of_pulses = true;
  labels.warning = "FAULTS: STALLED";
  const LabelText formed = label_text(scan, Orientation::head_up, labels);
  EXPECT_EQ(formed.bottom_right[0].text, "1 OF 256 EMPTY");
  EXPECT_EQ(formed.bottom_left[0].text, "FAULTS: STALLED");
  EXPECT_TRUE(formed.bottom_left[0].warning);
}

TEST(LabelText, WritesPositionsAndTimesWithoutRoundingErrors) {
  EXPECT_EQ(position_text({60.4, -5.3}), "60^24.000'N 005^18.000'W");
  EXPECT_EQ(position_text({-0.9999999, 179.9999999}), "01^00.000'S 180^00.000'E");
  EXPECT_EQ(bearing_text(359.97), "000.0^");
  EXPECT_EQ(utc_text(UtcTime(std::chrono::milliseconds(1714564800250))),
            "2024-05-01T12:00:00.250Z");
  EXPECT_EQ(utc_text(UtcTime(std::chrono::milliseconds(-250))), "1969-12-31T23:59:59.750Z");
}

}  // namespace
}  // namespace skerry
