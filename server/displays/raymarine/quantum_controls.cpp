#include "server/displays/raymarine/quantum_controls.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/raymarine/quantum_spoke.hpp"
#include "server/displays/by_hand.hpp"

namespace skerry::server {
namespace {

using raymarine::QuantumCommand;
using raymarine::QuantumControl;
using raymarine::QuantumMode;
using raymarine::QuantumModeControls;

constexpr double kThousandthNm = 1.852;  // m
constexpr double kRejectionStep = 20.0;  // positions 0 .. 5 on 0 .. 100
constexpr double kExpanded = 50.0;

std::uint8_t whole_percent(double setting) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(setting), 0L, 100L));
}

std::optional<QuantumMode> mode_of(wire::PictureMode mode) {
  switch (mode) {
    case wire::HARBOUR:
      return QuantumMode::harbour;
    case wire::OFFSHORE:
      return QuantumMode::offshore;
    case wire::WEATHER:
      return QuantumMode::weather;
    default:
      return std::nullopt;
  }
}

}  // namespace

QuantumControls::QuantumControls() {
  for (const std::uint32_t range : raymarine::kQuantumRanges) {
    ranges_.ranges_m.push_back(range * kThousandthNm);
  }
  ranges_.span_of_range =
      double{raymarine::kQuantumCells} / double{raymarine::kQuantumCellsPerRange};
  // A radar's own, as the capture's was before its knobs were turned.
  controls_ = {{{false, 54, false, 9, false, 0, true, 0},
                {true, 65, false, 27, false, 0, false, 0},
                {false, 85, false, 45, true, 21, false, 0},
                {true, 90, true, 50, true, 0, false, 0}}};
}

double QuantumControls::range_m(const wire::Settings& now) const {
  if (const auto chosen = range_.of(now.range_nm())) return *chosen;
  if (const auto recorded = range_of_rows(ranges_, now)) return *recorded;
  const auto scale = RangeScale::find(now.range_nm());
  return range_shown_m(ranges_, scale.value_or(RangeScale{}));
}

std::optional<wire::Set> QuantumControls::set_of(const QuantumCommand& command,
                                                 const wire::Settings& now) const {
  wire::Set set;
  const std::int32_t value = command.value;
  switch (command.control) {
    case QuantumControl::transmit:
      set.set_transmit(value != 0);
      return set;
    case QuantumControl::range_index:
      set.set_range_nm(
          scale_holding(ranges_.ranges_m[static_cast<std::size_t>(value)]).in_nautical_miles());
      return set;
    case QuantumControl::gain_auto:
      by_hand(set, now);
      set.set_gain_auto(value != 0);
      return set;
    case QuantumControl::gain:
      by_hand(set, now);
      set.set_gain(value);
      return set;
    case QuantumControl::sea_auto:
      by_hand(set, now);
      set.set_sea_auto(value != 0);
      return set;
    case QuantumControl::sea:
      by_hand(set, now);
      set.set_sea(value);
      return set;
    case QuantumControl::rain_on:
      by_hand(set, now);
      set.set_rain(value != 0 ? in_use().rain : 0);
      return set;
    case QuantumControl::rain:
      if (!in_use().rain_on) return std::nullopt;
      by_hand(set, now);
      set.set_rain(value);
      return set;
    case QuantumControl::expansion:
      set.set_echo_stretch(value != 0 ? kExpanded : 0.0);
      return set;
    case QuantumControl::rejection:
      set.set_interference_rejection(value * kRejectionStep);
      return set;
    case QuantumControl::bearing_offset:
      set.set_bearing_alignment_deg(value / 10.0);
      return set;
    case QuantumControl::mode: {
      const QuantumModeControls& wanted = controls_[static_cast<std::size_t>(value)];
      by_hand(set, now);
      set.set_gain_auto(wanted.gain_auto);
      set.set_gain(wanted.gain);
      set.set_sea_auto(wanted.sea_auto);
      set.set_sea(wanted.sea);
      set.set_rain(wanted.rain_on ? wanted.rain : 0);
      return set;
    }
    case QuantumControl::stay_alive:
    case QuantumControl::colour_auto:
    case QuantumControl::colour:
      break;
  }
  return std::nullopt;
}

void QuantumControls::accept(const QuantumCommand& command, const wire::Settings& after) {
  const std::int32_t value = command.value;
  switch (command.control) {
    case QuantumControl::range_index:
      range_.remember(ranges_.ranges_m[static_cast<std::size_t>(value)], after.range_nm());
      break;
    case QuantumControl::colour_auto:
      in_use().colour_auto = value != 0;
      break;
    case QuantumControl::colour:
      in_use().colour = static_cast<std::uint8_t>(value);
      break;
    case QuantumControl::rain_on:
      in_use().rain_on = value != 0;
      break;
    case QuantumControl::rain:
      in_use().rain = static_cast<std::uint8_t>(value);
      break;
    case QuantumControl::expansion:
      expansion_.remember(value, after.echo_stretch());
      break;
    case QuantumControl::rejection:
      rejection_.remember(value, after.interference_rejection());
      break;
    case QuantumControl::bearing_offset:
      bearing_.remember(value, after.bearing_alignment_deg());
      break;
    case QuantumControl::mode:
      mode_ = static_cast<QuantumMode>(value);
      break;
    default:
      break;
  }
  observe(after);
}

void QuantumControls::observe(const wire::Settings& now) {
  range_.observe(now.range_nm());
  expansion_.observe(now.echo_stretch());
  rejection_.observe(now.interference_rejection());
  bearing_.observe(now.bearing_alignment_deg());
  if (const auto mode = mode_of(now.mode())) mode_ = *mode;
  QuantumModeControls& mine = in_use();
  mine.gain_auto = now.gain_auto();
  mine.gain = whole_percent(now.gain());
  mine.sea_auto = now.sea_auto();
  mine.sea = whole_percent(now.sea());
  // Rain that is on at nothing, and off at nothing, are one setting of a view.
  if (now.rain() > 0.0) {
    mine.rain_on = true;
    mine.rain = whole_percent(now.rain());
  } else if (mine.rain > 0) {
    mine.rain_on = false;
  }
}

raymarine::QuantumStatus QuantumControls::status(const wire::Settings& now) const {
  raymarine::QuantumStatus status;
  status.transmits = !now.standby();
  status.bearing_offset = static_cast<std::int16_t>(
      bearing_.of(now.bearing_alignment_deg())
          .value_or(static_cast<std::int32_t>(std::lround(now.bearing_alignment_deg() * 10.0))));
  status.rejection =
      static_cast<std::uint8_t>(rejection_.of(now.interference_rejection())
                                    .value_or(static_cast<std::int32_t>(std::ceil(
                                        now.interference_rejection() / kRejectionStep - 1e-9))));
  status.expansion = static_cast<std::uint8_t>(
      expansion_.of(now.echo_stretch()).value_or(now.echo_stretch() > 0.0 ? 1 : 0));
  status.mode = mode_;
  status.controls = controls_;

  const auto thousandths = static_cast<std::uint32_t>(std::lround(range_m(now) / kThousandthNm));
  const auto found = std::find(status.ranges.begin(), status.ranges.end(), thousandths);
  if (found == status.ranges.end()) status.ranges.back() = thousandths;
  status.range_index = static_cast<std::uint8_t>(std::min<std::ptrdiff_t>(
      found - status.ranges.begin(), static_cast<std::ptrdiff_t>(status.ranges.size()) - 1));
  return status;
}

}  // namespace skerry::server
