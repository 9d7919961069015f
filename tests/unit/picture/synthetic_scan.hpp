// Spokes and scans made for tests.
#pragma once

#include <cstdint>
#include <utility>

#include "protocol/video/scan.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry {

inline constexpr ScanGeometry kSmall{.spokes_per_turn = 256, .cells = 256, .bits = 8};

inline Spoke spoke_of(const ScanGeometry& geometry, std::uint32_t scan, std::uint32_t index,
                      double heading_deg = 0.0) {
  Spoke spoke;
  spoke.header.geometry = geometry;
  spoke.header.scan = scan;
  spoke.header.index = index;
  spoke.header.sequence = std::uint64_t{scan} * geometry.spokes_per_turn + index;
  spoke.header.heading = TrueBearing::from(degrees(heading_deg));
  spoke.header.own_ship = {60.4, -5.3};
  spoke.header.utc = UtcTime(std::chrono::milliseconds(1714564800250));  // 2024-05-01T12:00:00.25
  spoke.cells.assign(geometry.cells, 0);
  return spoke;
}

// A whole scan; `paint` may change each spoke.
template <typename Paint>
Scan scan_of(const ScanGeometry& geometry, double heading_deg, Paint&& paint) {
  Scan scan{.radar = 0,
            .view = 0,
            .number = 7,
            .geometry = geometry,
            .spokes = std::vector<std::optional<Spoke>>(geometry.spokes_per_turn),
            .received = geometry.spokes_per_turn};
  for (std::uint32_t i = 0; i < geometry.spokes_per_turn; ++i) {
    Spoke spoke = spoke_of(geometry, scan.number, i, heading_deg);
    paint(spoke);
    scan.spokes[i] = std::move(spoke);
  }
  return scan;
}

inline Scan empty_scan(const ScanGeometry& geometry, double heading_deg) {
  return scan_of(geometry, heading_deg, [](Spoke&) {});
}

inline void remove_spoke(Scan& scan, std::uint32_t index) {
  if (scan.spokes[index]) --scan.received;
  scan.spokes[index].reset();
}

}  // namespace skerry
