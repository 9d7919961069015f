// Spoke: the finished video of one azimuth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/length.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry {

// What a spoke says of itself.  A scan is one turn of the antenna relative to the bow, so every
// scan has exactly geometry.spokes_per_turn spokes; spoke 0 points over the bow.
struct SpokeHeader {
  std::uint32_t radar = 0;     // index of the radar in the server
  std::uint32_t view = 0;      // 0 = the shared default view
  std::uint64_t sequence = 0;  // +1 for every spoke of this view, never repeats
  std::uint32_t scan = 0;      // turns since the radar started
  std::uint32_t index = 0;     // azimuth index in the scan, 0 .. spokes_per_turn-1, clockwise
  ScanGeometry geometry;
  RangeScale range_scale;
  // Where the last cell ends; 0 where that is the range scale.  At most twice the range scale.
  Length instrumented_range{};
  TrueBearing heading;  // the bow's true bearing at the spoke's time
  GeoPoint own_ship;    // antenna position at the spoke's time
  ScenarioTime scenario_time{};
  UtcTime utc{};  // when the antenna points there

  RelativeBearing antenna() const {
    return RelativeBearing::of_spoke(index, geometry.spokes_per_turn);
  }
  TrueBearing bearing() const { return to_true(antenna(), heading); }
  Length reach() const {
    return instrumented_range.in_metres() > 0.0 ? instrumented_range : range_scale.length();
  }
  Length cell_size() const { return reach() / geometry.cells; }
};

// How an echo moves along the spoke: what a Doppler radar colours.
enum class DopplerClass : std::uint8_t { none = 0, approaching = 1, receding = 2 };

// Header and cells; nearest cell first, one byte per cell (0..255, or 0..15 with 4 bits); immutable
// once published and shared between threads.
struct Spoke {
  SpokeHeader header;
  std::vector<std::uint8_t> cells;  // size = header.geometry.cells
  // Empty unless the view asks for it; else one of each cell.
  std::vector<DopplerClass> doppler = {};
};
using SpokePtr = std::shared_ptr<const Spoke>;

// Consecutive spokes of one view made and sent together (16 by default).
struct Sector {
  std::vector<SpokePtr> spokes;
};

}  // namespace skerry
