#include "server/live/live_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "protocol/navico/command.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using navico::Command;
using navico::CommandKind;

constexpr double kDmPerNauticalMile = 18'520.0;
// Antenna speeds of scan speeds 0 .. 3 (protocol/navico/README.md).
constexpr std::array<double, 4> kSpeeds_rpm = {24.0, 30.0, 36.0, 48.0};

std::int32_t level(double percent) {
  return static_cast<std::int32_t>(std::clamp(std::ceil(percent * 2.55 - 1e-6), 0.0, 255.0));
}
std::int32_t step(double percent, int most) {
  return static_cast<std::int32_t>(std::lround(std::clamp(percent, 0.0, 100.0) * most / 100.0));
}
std::uint16_t tenths(double degrees) {
  const auto units = static_cast<std::int32_t>(std::lround(degrees * 10.0)) % 3600;
  return static_cast<std::uint16_t>(units < 0 ? units + 3600 : units);
}

// Takes what it can of a Set, field by field.
class NavicoOrder {
 public:
  NavicoOrder(navico::Model model, const wire::Set& set, const wire::Settings& now)
      : model_(model), rest_(changes_of(set)), now_(now) {}

  Result<std::vector<Bytes>, std::string> commands() {
    if (const auto fault = picture()) return Failure{*fault};
    installation();
    transmission();
    if (const auto lacking = lacking_in(rest_, navico::name_of(model_))) return Failure{*lacking};
    return std::move(out_);
  }

 private:
  void send(const Command& command) {
    out_.push_back(navico::encode_command(command, navico::is_halo(model_)));
  }
  void send(CommandKind kind, std::int32_t value) { send({.kind = kind, .value = value}); }

  std::optional<std::string> picture() {
    if (rest_.has_range_nm()) {
      const double dm = std::floor(rest_.range_nm() * kDmPerNauticalMile + 0.5);
      if (!(dm >= navico::kMinRangeDm && dm <= navico::max_range_dm(model_))) {
        return fmt::format("range: {:g} NM is not one of a {}; allowed: {:.3g} to {:g} NM",
                           rest_.range_nm(), navico::name_of(model_),
                           navico::kMinRangeDm / kDmPerNauticalMile,
                           navico::max_range_dm(model_) / kDmPerNauticalMile);
      }
      send(CommandKind::range, static_cast<std::int32_t>(dm));
      rest_.clear_range_nm();
    }
    if (rest_.has_gain() || rest_.has_gain_auto()) {
      const bool automatic = rest_.has_gain_auto() ? rest_.gain_auto() : now_.gain_auto();
      const double gain = rest_.has_gain() ? rest_.gain() : now_.gain();
      send({.kind = CommandKind::gain, .value = level(gain), .automatic = automatic});
      rest_.clear_gain();
      rest_.clear_gain_auto();
    }
    if (rest_.has_sea() || rest_.has_sea_auto()) sea();
    if (rest_.has_rain()) send(CommandKind::rain, level(rest_.rain()));
    rest_.clear_rain();
    if (rest_.has_side_lobe_suppression() || rest_.has_side_lobe_auto()) {
      const bool automatic =
          rest_.has_side_lobe_auto() ? rest_.side_lobe_auto() : now_.side_lobe_auto();
      const double by_hand = rest_.has_side_lobe_suppression() ? rest_.side_lobe_suppression()
                                                               : now_.side_lobe_suppression();
      send({.kind = CommandKind::side_lobe, .value = level(by_hand), .automatic = automatic});
      rest_.clear_side_lobe_suppression();
      rest_.clear_side_lobe_auto();
    }
    steps();
    return std::nullopt;
  }

  void sea() {
    const bool automatic = rest_.has_sea_auto() ? rest_.sea_auto() : now_.sea_auto();
    const double sea = rest_.has_sea() ? rest_.sea() : now_.sea();
    rest_.clear_sea();
    rest_.clear_sea_auto();
    if (!navico::is_halo(model_)) {
      return send({.kind = CommandKind::sea, .value = level(sea), .automatic = automatic});
    }
    send({.kind = CommandKind::halo_sea_mode, .automatic = automatic});
    if (automatic) {
      send(CommandKind::halo_sea_adjust, static_cast<std::int32_t>(std::lround(sea - 50.0)));
    } else {
      send(CommandKind::halo_sea, static_cast<std::int32_t>(std::lround(sea)));
    }
  }

  void steps() {
    if (rest_.has_interference_rejection()) {
      send(CommandKind::interference, step(rest_.interference_rejection(), 3));
    }
    rest_.clear_interference_rejection();
    if (rest_.has_echo_stretch()) {
      send(CommandKind::expansion, step(rest_.echo_stretch(), navico::is_halo(model_) ? 3 : 1));
    }
    rest_.clear_echo_stretch();
    if (rest_.has_target_boost()) send(CommandKind::boost, step(rest_.target_boost(), 2));
    rest_.clear_target_boost();
    if (rest_.has_noise_rejection()) {
      send(CommandKind::noise_rejection, step(rest_.noise_rejection(), 3));
    }
    rest_.clear_noise_rejection();
    if (rest_.has_target_separation()) {
      send(CommandKind::target_separation, step(rest_.target_separation(), 3));
    }
    rest_.clear_target_separation();
    if (rest_.has_mode()) send(CommandKind::mode, rest_.mode());
    rest_.clear_mode();
    if (!navico::has_doppler(model_)) return;
    if (rest_.has_doppler()) send(CommandKind::doppler, rest_.doppler());
    rest_.clear_doppler();
    if (rest_.has_doppler_threshold_mps()) {
      send(CommandKind::doppler_threshold,
           static_cast<std::int32_t>(std::lround(rest_.doppler_threshold_mps() * 100.0)));
    }
    rest_.clear_doppler_threshold_mps();
  }

  void installation() {
    if (rest_.has_bearing_alignment_deg()) {
      send(CommandKind::bearing_alignment, tenths(rest_.bearing_alignment_deg()));
    }
    rest_.clear_bearing_alignment_deg();
    if (rest_.has_antenna_height_m()) {
      send(CommandKind::antenna_height,
           static_cast<std::int32_t>(std::lround(rest_.antenna_height_m() * 1000.0)));
    }
    rest_.clear_antenna_height_m();
    if (rest_.has_rotation_rpm()) {
      const auto nearest =
          std::min_element(kSpeeds_rpm.begin(), kSpeeds_rpm.end(), [&](double a, double b) {
            return std::fabs(a - rest_.rotation_rpm()) < std::fabs(b - rest_.rotation_rpm());
          });
      send(CommandKind::scan_speed, static_cast<std::int32_t>(nearest - kSpeeds_rpm.begin()));
    }
    rest_.clear_rotation_rpm();
    if (!rest_.has_blanked_sectors()) return;
    constexpr int kSectors = 4;
    for (int i = 0; i < kSectors; ++i) {
      const bool on = i < rest_.blanked_sectors().sectors_size();
      Command command{.kind = CommandKind::blanking_angles,
                      .value = on,
                      .sector = static_cast<std::uint8_t>(i)};
      if (on) {
        command.from = tenths(rest_.blanked_sectors().sectors(i).from_deg());
        command.to = tenths(rest_.blanked_sectors().sectors(i).to_deg());
      } else {
        command.kind = CommandKind::blanking_on;
      }
      send(command);
    }
    rest_.clear_blanked_sectors();
  }

  // Last: it transmits with what was set.
  void transmission() {
    if (!rest_.has_transmit()) return;
    send(CommandKind::prepare, 1);
    send(CommandKind::transmit, rest_.transmit());
    rest_.clear_transmit();
  }

  const navico::Model model_;
  wire::Set rest_;
  const wire::Settings& now_;
  std::vector<Bytes> out_;
};

}  // namespace

Result<std::vector<Bytes>, std::string> navico_commands(navico::Model model, const wire::Set& set,
                                                        const wire::Settings& now) {
  return NavicoOrder(model, set, now).commands();
}

}  // namespace skerry::server
