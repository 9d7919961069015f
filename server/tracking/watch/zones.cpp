#include "server/tracking/watch/zones.hpp"

#include <cmath>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::server {
namespace {

bool is_usable(const wire::TargetZone& zone, std::optional<double> heading_deg) {
  return !zone.relative() || heading_deg.has_value();
}

Tracker::Area area_of(const wire::TargetZone& zone, std::optional<double> heading_deg) {
  const double turn = zone.relative() ? *heading_deg : 0.0;
  Tracker::Area area;
  area.inner_m = nautical_miles(zone.inner_nm()).in_metres();
  area.outer_m = nautical_miles(zone.outer_nm()).in_metres();
  area.from_deg = wrapped_degrees(zone.from_deg() + turn);
  area.to_deg = wrapped_degrees(zone.to_deg() + turn);
  area.acquire =
      zone.kind() == wire::TargetZone::EXCLUDES ? Tracker::Acquire::none : Tracker::Acquire::all;
  return area;
}

bool is_in(const Tracker::Area& area, double range_m, double bearing_deg, bool before) {
  const double by_m = before ? ZoneTable::kLeftBy_m : 0.0;
  if (!(range_m >= area.inner_m - by_m && range_m <= area.outer_m + by_m)) return false;
  const double width = wrapped_degrees(area.to_deg - area.from_deg);
  if (width == 0.0) return true;
  const double by_deg = before ? ZoneTable::kLeftBy_deg : 0.0;
  if (width + 2.0 * by_deg >= 360.0) return true;
  return wrapped_degrees(bearing_deg - area.from_deg + by_deg) <= width + 2.0 * by_deg;
}

}  // namespace

void ZoneTable::put(const wire::TargetZone& zone) {
  zones_[zone.number() - 1] = zone;
  laid_ = static_cast<Mask>(laid_ | 1u << (zone.number() - 1));
}

bool ZoneTable::has(std::uint32_t number) const {
  return number >= 1 && number <= kMost && zones_[number - 1].has_value();
}

bool ZoneTable::remove(std::uint32_t number) {
  if (!has(number)) return false;
  zones_[number - 1].reset();
  return true;
}

std::vector<Tracker::Area> ZoneTable::areas(std::optional<double> heading_deg) const {
  std::vector<Tracker::Area> areas;
  for (const auto kind : {wire::TargetZone::EXCLUDES, wire::TargetZone::ACQUIRES}) {
    for (const auto& zone : zones_) {
      if (!zone || zone->kind() != kind || !is_usable(*zone, heading_deg)) continue;
      areas.push_back(area_of(*zone, heading_deg));
    }
  }
  return areas;
}

ZoneTable::Mask ZoneTable::zones_at(double range_m, double bearing_deg,
                                    std::optional<double> heading_deg, Mask before) const {
  unsigned mask = 0;
  for (std::uint32_t k = 0; k < kMost; ++k) {
    if (!zones_[k] || !is_usable(*zones_[k], heading_deg)) continue;
    const bool excludes = zones_[k]->kind() == wire::TargetZone::EXCLUDES;
    const bool was_in = (before >> k & 1u) != 0;
    if (!is_in(area_of(*zones_[k], heading_deg), range_m, bearing_deg, was_in)) continue;
    if (excludes) return 0;
    mask |= 1u << k;
  }
  return static_cast<Mask>(mask);
}

ZoneTable::Mask ZoneTable::take_laid() { return std::exchange(laid_, Mask{0}); }

std::vector<wire::TargetZone> ZoneTable::all() const {
  std::vector<wire::TargetZone> all;
  for (const auto& zone : zones_) {
    if (zone) all.push_back(*zone);
  }
  return all;
}

}  // namespace skerry::server
