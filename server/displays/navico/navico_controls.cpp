#include "server/displays/navico/navico_controls.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using navico::Command;
using navico::CommandKind;
using navico::Model;

constexpr double kDmPerNauticalMile = 18520.0;
constexpr std::int32_t kTurnTenths = 3600;
// Antenna speeds of scan speeds 0 .. 3.  A HALO24 turns at 23.7, 29.4, .., 51 rpm in the
// recordings.
constexpr std::array<double, 4> kSpeeds_rpm = {24.0, 30.0, 36.0, 48.0};

double from_level(std::int32_t raw) { return raw * 100.0 / 255.0; }
// The smallest level that is at least so much: displays show its whole percent, whether they round
// or cut off, so that all of 0 to 100 come back as they went.
std::uint8_t to_level(double percent) {
  return static_cast<std::uint8_t>(std::clamp(std::ceil(percent * 2.55 - 1e-6), 0.0, 255.0));
}
double from_step(std::int32_t raw, std::int32_t most) { return raw * 100.0 / most; }
std::uint8_t to_step(double percent, std::int32_t most) {
  return static_cast<std::uint8_t>(
      std::clamp(std::floor(percent * most / 100.0 + 0.5), 0.0, static_cast<double>(most)));
}
std::int32_t tenths(double degrees) {
  const auto units = static_cast<std::int32_t>(std::floor(degrees * 10.0 + 0.5)) % kTurnTenths;
  return units < 0 ? units + kTurnTenths : units;
}
double clamped_percent(double value) { return std::clamp(value, 0.0, 100.0); }

std::int32_t most_expansion(Model model) { return navico::is_halo(model) ? 3 : 1; }

wire::BlankedSectors to_wire(const navico::BlankedSectors& sectors) {
  wire::BlankedSectors out;
  for (const navico::BlankedSector& each : sectors) {
    if (!each.on) continue;
    auto* const sector = out.add_sectors();
    sector->set_from_deg(each.from / 10.0);
    sector->set_to_deg(each.to / 10.0);
  }
  return out;
}

bool same(const wire::BlankedSectors& a, const wire::BlankedSectors& b) {
  if (a.sectors_size() != b.sectors_size()) return false;
  for (int i = 0; i < a.sectors_size(); ++i) {
    if (tenths(a.sectors(i).from_deg()) != tenths(b.sectors(i).from_deg()) ||
        tenths(a.sectors(i).to_deg()) != tenths(b.sectors(i).to_deg())) {
      return false;
    }
  }
  return true;
}

}  // namespace

double range_scale_nm(std::uint32_t range_dm) {
  for (const double nm : RangeScale::kNauticalMiles) {
    // Displays say 463 m for 0.25 NM and 231 m for 0.125: half a metre short is the same range.
    if (nm * kDmPerNauticalMile + 10.0 >= range_dm) return nm;
  }
  return RangeScale::kNauticalMiles.back();
}

bool NavicoControls::set_range(const Command& command, wire::Set& set) {
  const auto dm = static_cast<std::uint32_t>(std::max(command.value, 0));
  if (dm < navico::kMinRangeDm || dm > navico::max_range_dm(model_)) return false;
  asked_dm_ = dm;
  asked_scale_nm_ = range_scale_nm(dm);
  set.set_range_nm(asked_scale_nm_);
  return true;
}

namespace {

// The range whose spokes reach as far as the view's rows do by themselves: of a recording of such a
// radar, say. A header says a reach in steps of up to 10 m (4G), 2.5 dm (HALO): a range that
// displays have is looked for first.
std::optional<std::uint32_t> range_of_rows(navico::Model model, const wire::Settings& settings) {
  const double reach_m = settings.instrumented_range_m();
  if (!(reach_m > 0.0)) return std::nullopt;
  const double ratio = navico::spoke_range(model, 100'000).reach.in_metres() / 10'000.0;
  const double wanted_dm = reach_m / ratio * 10.0;
  const auto fits = [&](double dm) {
    if (dm < navico::kMinRangeDm || dm > navico::max_range_dm(model)) return false;
    const double reach =
        navico::spoke_range(model, static_cast<std::uint32_t>(dm)).reach.in_metres();
    return std::fabs(reach - reach_m) <= 1e-3 * reach_m;
  };
  constexpr double kEighthNm = kDmPerNauticalMile / 8.0;
  for (const double step : {kEighthNm, 500.0, 1.0}) {
    const double dm = std::floor(std::floor(wanted_dm / step + 0.5) * step + 0.5);
    if (fits(dm)) return static_cast<std::uint32_t>(dm);
  }
  // Short ones are coarse: the header's step is more than the ratio tells.
  constexpr int kCoarseDm = 100;
  for (int off = 1; off <= kCoarseDm; ++off) {
    for (const double dm : {std::floor(wanted_dm) - off, std::floor(wanted_dm) + off}) {
      if (fits(dm)) return static_cast<std::uint32_t>(dm);
    }
  }
  return std::nullopt;
}

}  // namespace

std::uint32_t NavicoControls::range_dm(const wire::Settings& settings) const {
  if (asked_dm_ != 0 && std::fabs(settings.range_nm() - asked_scale_nm_) < 1e-6) return asked_dm_;
  if (const auto recorded = range_of_rows(model_, settings)) return *recorded;
  const double dm = std::floor(settings.range_nm() * kDmPerNauticalMile + 0.5);
  return static_cast<std::uint32_t>(std::clamp(dm, static_cast<double>(navico::kMinRangeDm),
                                               static_cast<double>(navico::max_range_dm(model_))));
}

bool NavicoControls::set_sector(const Command& command, const wire::Settings& settings,
                                wire::Set& set) {
  const bool angles = command.kind == CommandKind::blanking_angles;
  if (command.sector >= asked_sectors_.size() || command.value > 1 || command.value < 0 ||
      (angles && (command.from >= kTurnTenths || command.to >= kTurnTenths))) {
    return false;
  }
  asked_sectors_ = sectors(settings);
  navico::BlankedSector& sector = asked_sectors_[command.sector];
  sector.on = command.value == 1;
  if (angles) {
    sector.from = command.from;
    sector.to = command.to;
  }
  *set.mutable_blanked_sectors() = to_wire(asked_sectors_);
  return true;
}

navico::BlankedSectors NavicoControls::sectors(const wire::Settings& settings) const {
  if (same(settings.blanked_sectors(), to_wire(asked_sectors_))) return asked_sectors_;
  navico::BlankedSectors sectors;
  const int count = std::min<int>(settings.blanked_sectors().sectors_size(), sectors.size());
  for (int i = 0; i < count; ++i) {
    const auto& each = settings.blanked_sectors().sectors(i);
    sectors[i] = {true, static_cast<std::uint16_t>(tenths(each.from_deg())),
                  static_cast<std::uint16_t>(tenths(each.to_deg()))};
  }
  return sectors;
}

bool NavicoControls::set_sea(const Command& command, wire::Set& set) {
  const bool halo = navico::is_halo(model_);
  bool is_auto = false;
  switch (command.kind) {
    case CommandKind::sea:
      if (command.automatic > 2) return false;
      is_auto = command.automatic > 0;
      if (is_auto) sea_auto_ = command.automatic;
      sea_by_hand_ = from_level(command.value);
      break;
    case CommandKind::halo_sea_mode:
      if (!halo || command.automatic > 1) return false;
      is_auto = command.automatic == 1;
      break;
    case CommandKind::halo_sea:
      if (!halo || command.value > 100) return false;
      sea_by_hand_ = command.value;
      break;
    case CommandKind::halo_sea_adjust:
      if (!halo || command.value < -50 || command.value > 50) return false;
      is_auto = true;
      sea_adjust_ = command.value;
      break;
    default:
      return false;
  }
  set.set_sea_auto(is_auto);
  set.set_sea(is_auto ? 50.0 + sea_adjust_ : sea_by_hand_);
  return true;
}

// Those of a few steps: a value beyond the last is the last.
bool NavicoControls::set_step(const Command& command, wire::Set& set) {
  const auto step = [&](std::int32_t most) {
    return from_step(std::clamp(command.value, 0, most), most);
  };
  switch (command.kind) {
    case CommandKind::interference:
      set.set_interference_rejection(step(3));
      return true;
    case CommandKind::expansion:
      set.set_echo_stretch(step(most_expansion(model_)));
      return true;
    case CommandKind::boost:
      set.set_target_boost(step(2));
      return true;
    case CommandKind::noise_rejection:
      set.set_noise_rejection(step(3));
      return true;
    case CommandKind::target_separation:
      set.set_target_separation(step(3));
      return true;
    case CommandKind::scan_speed:
      set.set_rotation_rpm(kSpeeds_rpm[static_cast<std::size_t>(std::clamp(command.value, 0, 3))]);
      return true;
    case CommandKind::mode:
      if (!wire::PictureMode_IsValid(command.value)) return false;
      set.set_mode(static_cast<wire::PictureMode>(command.value));
      return true;
    case CommandKind::doppler:
      if (!navico::has_doppler(model_) || !wire::DopplerMode_IsValid(command.value)) return false;
      set.set_doppler(static_cast<wire::DopplerMode>(command.value));
      return true;
    case CommandKind::doppler_threshold:
      if (!navico::has_doppler(model_)) return false;
      set.set_doppler_threshold_mps(std::clamp(command.value / 100.0, 0.1, 20.0));
      return true;
    case CommandKind::sea_state:
      sea_state_ = static_cast<std::uint8_t>(std::clamp(command.value, 0, 2));
      return true;
    case CommandKind::local_interference:
      local_interference_ = static_cast<std::uint8_t>(std::clamp(command.value, 0, 3));
      return true;
    default:
      return false;
  }
}

bool NavicoControls::set_installation(const Command& command, wire::Set& set) {
  switch (command.kind) {
    case CommandKind::bearing_alignment: {
      if (command.value >= kTurnTenths) return false;
      const std::int32_t units =
          command.value > kTurnTenths / 2 ? command.value - kTurnTenths : command.value;
      set.set_bearing_alignment_deg(units / 10.0);
      return true;
    }
    case CommandKind::antenna_height:
      set.set_antenna_height_m(std::clamp(command.value / 1000.0, 1.0, 100.0));
      return true;
    case CommandKind::antenna_offset:
      return true;
    case CommandKind::accent_light:
      accent_light_ = static_cast<std::uint8_t>(command.value);
      return true;
    case CommandKind::parking:
      if (command.value >= kTurnTenths) return false;
      parking_ = static_cast<std::uint16_t>(command.value);
      return true;
    default:
      return false;
  }
}

std::optional<wire::Set> NavicoControls::change(const Command& command,
                                                const wire::Settings& settings) {
  wire::Set set;
  bool known = true;
  switch (command.kind) {
    case CommandKind::range:
      known = set_range(command, set);
      break;
    case CommandKind::gain:
      set.set_gain_auto(command.automatic != 0);
      set.set_gain(from_level(command.value));
      break;
    case CommandKind::rain:
      set.set_rain(from_level(command.value));
      break;
    case CommandKind::side_lobe:
      set.set_side_lobe_auto(command.automatic != 0);
      set.set_side_lobe_suppression(from_level(command.value));
      break;
    case CommandKind::blanking_on:
    case CommandKind::blanking_angles:
      known = set_sector(command, settings, set);
      break;
    case CommandKind::sea:
    case CommandKind::halo_sea_mode:
    case CommandKind::halo_sea:
    case CommandKind::halo_sea_adjust:
      known = set_sea(command, set);
      break;
    default:
      known = set_step(command, set) || set_installation(command, set);
  }
  if (!known) return std::nullopt;
  return set;
}

void NavicoControls::observe(const wire::Settings& settings) {
  // Who comes back to that scale later means the scale.
  if (std::fabs(settings.range_nm() - asked_scale_nm_) >= 1e-6) asked_dm_ = 0;
  if (settings.sea_auto()) {
    sea_adjust_ = settings.sea() - 50.0;
  } else {
    sea_by_hand_ = settings.sea();
  }
}

navico::ControlReport NavicoControls::controls(const wire::Settings& settings) const {
  navico::ControlReport report;
  report.range_dm = range_dm(settings);
  report.mode = static_cast<std::uint8_t>(settings.mode());
  report.gain_auto = settings.gain_auto();
  report.gain = to_level(settings.gain());
  report.sea_auto = settings.sea_auto() ? sea_auto_ : std::uint8_t{0};
  // A HALO's own is a whole percent, and the recorded one says the nearest level of it (26 % is
  // 66).
  report.sea = navico::is_halo(model_)
                   ? static_cast<std::uint8_t>(std::lround(clamped_percent(sea_by_hand_) * 2.55))
                   : to_level(sea_by_hand_);
  report.rain = to_level(settings.rain());
  report.interference = to_step(settings.interference_rejection(), 3);
  report.expansion = to_step(settings.echo_stretch(), most_expansion(model_));
  report.boost = to_step(settings.target_boost(), 2);
  return report;
}

navico::AdvancedReport NavicoControls::advanced(const wire::Settings& settings) const {
  navico::AdvancedReport report;
  report.sea_state = sea_state_;
  report.local_interference = local_interference_;
  const double rpm = settings.rotation_rpm();
  if (rpm > 0.0) {
    const auto nearest = std::min_element(
        kSpeeds_rpm.begin(), kSpeeds_rpm.end(),
        [&](double a, double b) { return std::fabs(a - rpm) < std::fabs(b - rpm); });
    report.scan_speed = static_cast<std::uint8_t>(nearest - kSpeeds_rpm.begin());
  }
  report.side_lobe_auto = settings.side_lobe_auto();
  report.side_lobe = to_level(settings.side_lobe_suppression());
  report.noise_rejection = to_step(settings.noise_rejection(), 3);
  report.target_separation = to_step(settings.target_separation(), 3);
  report.halo_sea = static_cast<std::uint8_t>(std::floor(clamped_percent(sea_by_hand_) + 0.5));
  report.halo_sea_adjust =
      static_cast<std::int8_t>(std::floor(std::clamp(sea_adjust_, -50.0, 50.0) + 0.5));
  if (navico::has_doppler(model_)) {
    report.doppler = static_cast<std::uint8_t>(settings.doppler());
    report.doppler_threshold_cms = static_cast<std::uint16_t>(
        std::clamp(std::floor(settings.doppler_threshold_mps() * 100.0 + 0.5), 0.0, 65535.0));
  }
  return report;
}

navico::InstallationReport NavicoControls::installation(const wire::Settings& settings) const {
  navico::InstallationReport report;
  report.bearing_alignment = static_cast<std::uint16_t>(tenths(settings.bearing_alignment_deg()));
  report.parking = parking_;
  report.antenna_height_mm = static_cast<std::uint16_t>(
      std::clamp(std::floor(settings.antenna_height_m() * 1000.0 + 0.5), 0.0, 65535.0));
  report.accent_light = accent_light_;
  report.sectors = sectors(settings);
  return report;
}

}  // namespace skerry::server
