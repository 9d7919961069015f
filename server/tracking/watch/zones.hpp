// ZoneTable: areas around own ship in which targets are acquired, or are not.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/wire/targets.pb.h"
#include "server/plotter/tracks/tracker.hpp"

namespace skerry::server {

// At most eight, each under its number.  An area that excludes goes before all others: a place in
// one is in no zone that acquires.
class ZoneTable {
 public:
  static constexpr std::uint32_t kMost = 8;
  // What is in a zone has left it once it is so far outside: a target on the border, whose place
  // wanders by its errors and with the bow's yaw, is not new again and again.
  static constexpr double kLeftBy_m = 100.0, kLeftBy_deg = 3.0;

  // Of zones that acquire: bit n - 1 for number n.
  using Mask = std::uint8_t;

  // All values are within their ranges, and the inner distance is below the outer one.
  void put(const wire::TargetZone& zone);
  bool remove(std::uint32_t number);  // false: there is none
  bool has(std::uint32_t number) const;
  void clear() { zones_ = {}; }

  // As a tracker takes them; those from the bow are left out where the heading is not known.
  std::vector<Tracker::Area> areas(std::optional<double> heading_deg) const;
  // In which zones a target is that was in `before`.
  Mask zones_at(double range_m, double bearing_deg, std::optional<double> heading_deg,
                Mask before) const;
  // Zones that were put since the last call: what is in them by then has not entered them.
  Mask take_laid();
  // By number.
  std::vector<wire::TargetZone> all() const;

 private:
  std::array<std::optional<wire::TargetZone>, kMost> zones_;
  Mask laid_ = 0;
};

}  // namespace skerry::server
