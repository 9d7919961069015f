#include "protocol/picture/ppi_raster.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"

namespace skerry {
namespace {

constexpr std::uint32_t kAzimuths = 65536;
// Who shows in an azimuth: a spoke index, or one of these.
constexpr std::int32_t kUnswept = -1;
constexpr std::int32_t kMissingSpoke = -2;

// Directions of the picture, clockwise from its top, 2^32 = one turn.
std::uint32_t direction_of(const SpokeHeader& header, Orientation orientation) {
  return orientation == Orientation::north_up ? header.bearing().units() : header.antenna().units();
}

std::uint32_t azimuth_of(std::uint32_t direction) { return direction >> 16; }

// The first azimuth whose middle is not before `direction`.
std::uint32_t first_azimuth_from(std::uint32_t direction) { return azimuth_of(direction + 0x7fff); }

// Which spoke shows in each azimuth.
class AzimuthTable {
 public:
  AzimuthTable(const Scan& scan, Orientation orientation)
      : scan_(scan),
        orientation_(orientation),
        count_(scan.geometry.spokes_per_turn),
        step_(static_cast<std::uint32_t>((std::uint64_t{1} << 32) / count_)),
        shown_(kAzimuths, kUnswept) {
    mark_missing();
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (scan_.spokes[i]) mark_received(i);
    }
  }

  std::int32_t operator[](std::uint32_t azimuth) const { return shown_[azimuth]; }

 private:
  void fill(std::uint32_t from, std::uint32_t to, std::int32_t who) {
    const std::uint32_t first = first_azimuth_from(from);
    const std::uint32_t length = (first_azimuth_from(to) - first) % kAzimuths;
    for (std::uint32_t k = 0; k < length; ++k) shown_[(first + k) % kAzimuths] = who;
  }

  // Missing spokes are taken to have had the heading of the last one received before them.
  void mark_missing() {
    SpokeHeader header;
    for (const auto& spoke : scan_.spokes) {
      if (!spoke) continue;
      header = spoke->header;
      break;
    }
    header.geometry = scan_.geometry;
    for (std::uint32_t i = 0; i < count_; ++i) {
      if (scan_.spokes[i]) {
        header.heading = scan_.spokes[i]->header.heading;
        continue;
      }
      header.index = i;
      const std::uint32_t here = direction_of(header, orientation_);
      fill(here - step_ / 2 - 1, here + step_ / 2 + 1, kMissingSpoke);
    }
  }

  void mark_received(std::uint32_t i) {
    const std::uint32_t here = direction_of(scan_.spokes[i]->header, orientation_);
    std::uint32_t back = step_, ahead = step_;
    if (i > 0 && scan_.spokes[i - 1]) {
      back = here - direction_of(scan_.spokes[i - 1]->header, orientation_);
    }
    if (i + 1 < count_ && scan_.spokes[i + 1]) {
      ahead = direction_of(scan_.spokes[i + 1]->header, orientation_) - here;
    }
    fill(here - half(back), here + half(ahead), static_cast<std::int32_t>(i));
  }

  // Half way to a neighbour that lies where neighbours lie, else half the usual way.
  std::uint32_t half(std::uint32_t to_neighbour) const {
    return (to_neighbour <= 2 * step_ ? to_neighbour : step_) / 2;
  }

  const Scan& scan_;
  Orientation orientation_;
  std::uint32_t count_;
  std::uint32_t step_;
  std::vector<std::int32_t> shown_;
};

class Rasteriser {
 public:
  Rasteriser(const Scan& scan, const PpiFrame& frame)
      : scan_(scan),
        frame_(frame),
        shown_(scan, frame.orientation),
        level_factor_(scan.geometry.bits == 4 ? 17 : 1) {
    const auto pixels = static_cast<std::size_t>(frame.size) * frame.size;
    raster_.size = frame.size;
    raster_.level.assign(pixels, 0);
    raster_.kind.assign(pixels, PixelKind::outside);
    if (std::any_of(scan.spokes.begin(), scan.spokes.end(),
                    [](const auto& spoke) { return spoke && !spoke->doppler.empty(); })) {
      raster_.doppler.assign(pixels, DopplerClass::none);
    }
    if (const Spoke* newest = scan.newest()) {
      metres_per_pixel_ = newest->header.range_scale.length().in_metres() / frame.radius;
    }
  }

  PpiRaster run() {
    for (int y = 0; y < frame_.size; ++y) {
      for (int x = 0; x < frame_.size; ++x) fetch(x, y);
    }
    for (std::uint32_t i = 0; i < scan_.geometry.spokes_per_turn; ++i) {
      if (scan_.spokes[i]) place(*scan_.spokes[i]);
    }
    return std::move(raster_);
  }

 private:
  // The cell under the centre of a pixel.
  void fetch(int x, int y) {
    const double right = x + 0.5 - frame_.centre(), up = frame_.centre() - (y + 0.5);
    const double radius = std::hypot(right, up);
    if (radius > frame_.radius) return;
    const double turns = std::atan2(right, up) / kRadiansPerTurn;
    const auto azimuth =
        static_cast<std::uint32_t>(std::floor((turns + 1.0) * kAzimuths)) % kAzimuths;
    const std::size_t pixel = static_cast<std::size_t>(y) * frame_.size + x;
    const std::int32_t who = shown_[azimuth];
    if (who < 0) {
      raster_.kind[pixel] = who == kMissingSpoke ? PixelKind::missing : PixelKind::unswept;
      return;
    }
    raster_.kind[pixel] = PixelKind::video;
    const Spoke& spoke = *scan_.spokes[who];
    const double cell = radius * metres_per_pixel_ / spoke.header.cell_size().in_metres();
    if (cell < static_cast<double>(spoke.cells.size())) {
      show(spoke, static_cast<std::size_t>(cell), pixel);
    }
  }

  // All cells of a spoke, each into the pixel that holds its centre.
  void place(const Spoke& spoke) {
    const std::uint32_t direction = direction_of(spoke.header, frame_.orientation);
    if (shown_[azimuth_of(direction)] != static_cast<std::int32_t>(spoke.header.index)) return;
    const double angle = RelativeBearing::from_units(direction).in_radians();
    const double per_cell = spoke.header.cell_size().in_metres() / metres_per_pixel_;
    const double dx = std::sin(angle) * per_cell, dy = -std::cos(angle) * per_cell;
    const auto fit = static_cast<std::size_t>(std::max(0.0, frame_.radius / per_cell + 0.5));
    const std::size_t count = std::min(spoke.cells.size(), fit);
    for (std::size_t n = 0; n < count; ++n) {
      if (spoke.cells[n] == 0) continue;
      const double along = static_cast<double>(n) + 0.5;
      const int x = static_cast<int>(std::floor(frame_.centre() + dx * along));
      const int y = static_cast<int>(std::floor(frame_.centre() + dy * along));
      if (x < 0 || y < 0 || x >= frame_.size || y >= frame_.size) continue;
      const std::size_t pixel = static_cast<std::size_t>(y) * frame_.size + x;
      raster_.kind[pixel] = PixelKind::video;
      show(spoke, n, pixel);
    }
  }

  // The pixel shows that cell if it is the strongest so far; of equals one that is coloured.
  void show(const Spoke& spoke, std::size_t cell, std::size_t pixel) {
    const std::uint8_t strength = level(spoke.cells[cell]);
    const DopplerClass motion = spoke.doppler.empty() ? DopplerClass::none : spoke.doppler[cell];
    if (strength < raster_.level[pixel]) return;
    if (!raster_.doppler.empty() &&
        (strength > raster_.level[pixel] || motion != DopplerClass::none)) {
      raster_.doppler[pixel] = motion;
    }
    raster_.level[pixel] = strength;
  }

  std::uint8_t level(std::uint8_t cell) const {
    return static_cast<std::uint8_t>(cell * level_factor_);
  }

  const Scan& scan_;
  const PpiFrame& frame_;
  AzimuthTable shown_;
  int level_factor_;
  double metres_per_pixel_ = 1.0;
  PpiRaster raster_;
};

}  // namespace

PpiRaster rasterise(const Scan& scan, const PpiFrame& frame) {
  return Rasteriser(scan, frame).run();
}

}  // namespace skerry
