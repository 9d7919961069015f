#include "server/displays/garmin/xhd_controls.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/garmin/xhd_reports.hpp"
#include "protocol/garmin/xhd_spoke.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/displays/by_hand.hpp"

namespace skerry::server {
namespace {

using garmin::Type;

constexpr double kNormalRpm = 24.0, kFastRpm = 48.0, kFastFrom = 36.0;

double percent_of_hundredths(std::int64_t hundredths) {
  return static_cast<double>(hundredths) / 100.0;
}
std::int64_t hundredths_of(double percent) { return std::llround(percent * 100.0); }

// Positions of a switch that xHD displays show as off and on; some have three.
double rejection_of(std::int64_t position) {
  return position <= 0 ? 0.0 : position == 1 ? 50.0 : position == 2 ? 75.0 : 100.0;
}
std::int64_t position_of(double rejection) {
  return rejection <= 0.0 ? 0 : rejection <= 50.0 ? 1 : rejection <= 75.0 ? 2 : 3;
}

// The trim of automatic sea: calm, medium, rough.
double trim_of(std::int64_t level) { return 25.0 + 25.0 * static_cast<double>(level); }

double degrees_of(std::int64_t raw) { return static_cast<double>(raw) / 32.0; }
std::int64_t raw_angle(double deg) {
  return std::llround((deg > 180.0 ? deg - 360.0 : deg) * 32.0);
}

}  // namespace

XhdControls::XhdControls()
    : ranges_{{garmin::kRanges.begin(), garmin::kRanges.end()}, garmin::kSpanOfRange} {}

double XhdControls::range_m(const wire::Settings& now) const {
  if (const auto chosen = range_.of(now.range_nm())) return *chosen;
  if (const auto recorded = range_of_rows(ranges_, now)) return *recorded;
  const auto scale = RangeScale::find(now.range_nm());
  return range_shown_m(ranges_, scale.value_or(RangeScale{}));
}

std::int64_t XhdControls::sea_mode(const wire::Settings& now) const {
  if (now.sea_auto()) return 2;
  return now.sea() > 0.0 || (sea_by_hand_ && sea_level_ == 0) ? 1 : 0;
}

bool XhdControls::rain_is_on(const wire::Settings& now) const {
  return now.rain() > 0.0 || (rain_on_ && rain_level_ == 0);
}

bool XhdControls::zone_is_ours(const wire::Settings& now) const {
  if (now.blanked_sectors().sectors().empty()) return true;
  const auto& sector = now.blanked_sectors().sectors(0);
  return std::abs(sector.from_deg() - wrapped_degrees(degrees_of(zone_from_))) < 1e-6 &&
         std::abs(sector.to_deg() - wrapped_degrees(degrees_of(zone_to_))) < 1e-6;
}

void XhdControls::add_no_transmit(wire::Set& set, std::int64_t from, std::int64_t to) const {
  auto* sector = set.mutable_blanked_sectors()->add_sectors();
  sector->set_from_deg(wrapped_degrees(degrees_of(from)));
  sector->set_to_deg(wrapped_degrees(degrees_of(to)));
}

std::optional<wire::Set> XhdControls::set_of(const garmin::Command& command,
                                             const wire::Settings& now) const {
  wire::Set set;
  const std::int64_t value = command.value;
  const auto zone_on = [&] { return !now.blanked_sectors().sectors().empty(); };
  switch (command.type) {
    case Type::range: {
      const double range_m = nearest_range_m(ranges_, static_cast<double>(value));
      set.set_range_nm(scale_holding(range_m).in_nautical_miles());
      return set;
    }
    case Type::gain_auto:
      by_hand(set, now);
      set.set_gain_auto(value != 0);
      return set;
    case Type::gain:
      by_hand(set, now);
      set.set_gain(percent_of_hundredths(value));
      return set;
    case Type::alignment:
      set.set_bearing_alignment_deg(degrees_of(value));
      return set;
    case Type::rejection:
    case Type::crosstalk:
    case Type::old_rejection:
      set.set_interference_rejection(rejection_of(value));
      return set;
    case Type::rain_on:
      by_hand(set, now);
      set.set_rain(value != 0 ? percent_of_hundredths(rain_level_) : 0.0);
      return set;
    case Type::rain:
      if (!rain_is_on(now)) return std::nullopt;
      by_hand(set, now);
      set.set_rain(percent_of_hundredths(value));
      return set;
    case Type::sea_mode:
      by_hand(set, now);
      set.set_sea_auto(value == 2);
      set.set_sea(value == 2   ? trim_of(sea_auto_level_)
                  : value == 1 ? percent_of_hundredths(sea_level_)
                               : 0.0);
      return set;
    case Type::sea:
      if (sea_mode(now) != 1) return std::nullopt;
      by_hand(set, now);
      set.set_sea(percent_of_hundredths(value));
      return set;
    case Type::sea_auto_level:
      if (!now.sea_auto()) return std::nullopt;
      set.set_sea(trim_of(value));
      return set;
    case Type::speed:
      set.set_rotation_rpm(value == 0 ? kNormalRpm : kFastRpm);
      return set;
    case Type::no_transmit_on:
      set.mutable_blanked_sectors();
      if (value != 0) add_no_transmit(set, zone_from_, zone_to_);
      return set;
    case Type::no_transmit_from:
      if (!zone_on()) return std::nullopt;
      add_no_transmit(set, value, zone_to_);
      return set;
    case Type::no_transmit_to:
      if (!zone_on()) return std::nullopt;
      add_no_transmit(set, zone_from_, value);
      return set;
    default:
      return std::nullopt;
  }
}

void XhdControls::accept(const garmin::Command& command, const wire::Settings& after) {
  const std::int64_t value = command.value;
  switch (command.type) {
    case Type::range:
      range_.remember(nearest_range_m(ranges_, static_cast<double>(value)), after.range_nm());
      break;
    case Type::rejection:
    case Type::crosstalk:
    case Type::old_rejection:
      rejection_.remember(value, after.interference_rejection());
      break;
    case Type::speed:
      speed_.remember(value, after.rotation_rpm());
      break;
    case Type::gain_auto_level:
      gain_auto_level_ = value;
      break;
    case Type::rain_on:
      rain_on_ = value != 0;
      break;
    case Type::rain:
      rain_level_ = value;
      break;
    case Type::sea_mode:
      sea_by_hand_ = value == 1;
      break;
    case Type::sea:
      sea_level_ = value;
      break;
    case Type::sea_auto_level:
      sea_auto_level_ = value;
      break;
    case Type::no_transmit_from:
      zone_from_ = value;
      break;
    case Type::no_transmit_to:
      zone_to_ = value;
      break;
    case Type::timed_on:
      timed_on_ = value;
      break;
    case Type::timed_idle:
      timed_idle_ = value;
      break;
    case Type::timed_run:
      timed_run_ = value;
      break;
    default:
      break;
  }
  observe(after);
}

void XhdControls::observe(const wire::Settings& now) {
  range_.observe(now.range_nm());
  rejection_.observe(now.interference_rejection());
  speed_.observe(now.rotation_rpm());
  if (now.rain() > 0.0) {
    rain_level_ = hundredths_of(now.rain());
    rain_on_ = true;
  }
  if (!now.sea_auto() && now.sea() > 0.0) {
    sea_level_ = hundredths_of(now.sea());
    sea_by_hand_ = true;
  }
  if (!zone_is_ours(now)) {
    const auto& sector = now.blanked_sectors().sectors(0);
    zone_from_ = raw_angle(sector.from_deg());
    zone_to_ = raw_angle(sector.to_deg());
  }
}

std::optional<std::int64_t> XhdControls::report(Type type, const wire::Settings& now) const {
  switch (type) {
    case Type::range:
      return std::llround(range_m(now));
    case Type::gain_auto:
      return now.gain_auto() ? 2 : 0;
    case Type::gain:
      return hundredths_of(now.gain());
    case Type::gain_auto_level:
      return gain_auto_level_;
    case Type::alignment:
      return std::llround(now.bearing_alignment_deg() * 32.0);
    case Type::rejection:
    case Type::crosstalk:
      return rejection_.of(now.interference_rejection())
          .value_or(position_of(now.interference_rejection()));
    case Type::rain_on:
      return rain_is_on(now) ? 1 : 0;
    case Type::rain:
      return rain_level_;
    case Type::sea_mode:
      return sea_mode(now);
    case Type::sea:
      return sea_level_;
    case Type::sea_auto_level:
      return sea_auto_level_;
    case Type::speed:
      return speed_.of(now.rotation_rpm()).value_or(now.rotation_rpm() > kFastFrom ? 1 : 0);
    case Type::no_transmit_on:
      return now.blanked_sectors().sectors().empty() ? 0 : 1;
    case Type::no_transmit_from:
      return zone_from_;
    case Type::no_transmit_to:
      return zone_to_;
    case Type::timed_on:
      return timed_on_;
    case Type::timed_idle:
      return timed_idle_;
    case Type::timed_run:
      return timed_run_;
    default:
      return std::nullopt;
  }
}

}  // namespace skerry::server
