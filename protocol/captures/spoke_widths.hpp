// SpokeWidths: how many spokes a turn of CAT240 has.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "protocol/asterix/cat240.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry::captures {

// How many spokes a CAT240 sender has in a turn: by how wide they say they are, or by how far one
// is from the next where they say nothing.
class SpokeWidths {
 public:
  void take(const Cat240Video& video) {
    const std::uint16_t own = static_cast<std::uint16_t>(video.end_azimuth - video.start_azimuth);
    const std::uint16_t step = static_cast<std::uint16_t>(video.start_azimuth - last_);
    if (own > 0 && own < kWidest) add(own, own_);
    if (begun_ && step > 0 && step < kWidest) add(step, steps_);
    last_ = video.start_azimuth;
    begun_ = true;
  }
  std::uint32_t spokes_per_turn() const {
    const Sum& sum = own_.count > 0 ? own_ : steps_;
    if (sum.count == 0) return ScanGeometry::kMinSpokes;
    const double width = static_cast<double>(sum.total) / static_cast<double>(sum.count);
    return static_cast<std::uint32_t>(std::clamp(std::round(kNorthUnits / width),
                                                 double{ScanGeometry::kMinSpokes},
                                                 double{ScanGeometry::kMaxSpokes}));
  }

 private:
  static constexpr std::uint32_t kNorthUnits = 65'536;  // azimuths of CAT240 in a turn
  static constexpr std::uint16_t kWidest = 4096;
  struct Sum {
    std::uint64_t total = 0, count = 0;
  };
  static void add(std::uint16_t width, Sum& sum) {
    sum.total += width;
    ++sum.count;
  }
  Sum own_, steps_;
  std::uint16_t last_ = 0;
  bool begun_ = false;
};

}  // namespace skerry::captures
