#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_reports.hpp"
#include "server/live/live_commands.hpp"

namespace skerry::server {
namespace {

using garmin::Type;

constexpr std::string_view kXhd = "Garmin xHD";
constexpr double kFastFrom_rpm = 36.0;  // turns of 24 or 48 a minute
constexpr double kAnglesPerDegree = 32.0;
// Displays call 231.5 m 232 m.
constexpr double kSameXhdRange = 0.01;

std::int64_t hundredths(double percent) { return std::llround(percent * 100.0); }
std::int64_t raw_angle(double degrees) {
  return std::llround(std::remainder(degrees, 360.0) * kAnglesPerDegree);
}
std::int64_t xhd_rejection_of(double percent) {
  return percent <= 0.0 ? 0 : percent <= 50.0 ? 1 : percent <= 75.0 ? 2 : 3;
}

class XhdOrder {
 public:
  XhdOrder(const wire::Set& set, const wire::Settings& now) : rest_(changes_of(set)), now_(now) {}

  Commands commands() {
    if (const auto fault = range()) return Failure{*fault};
    levels();
    if (const auto fault = installation()) return Failure{*fault};
    if (rest_.has_transmit()) send(Type::transmit, 1, rest_.transmit());
    rest_.clear_transmit();
    if (const auto lacking = lacking_in(rest_, kXhd)) return Failure{*lacking};
    return std::move(out_);
  }

 private:
  void send(Type type, int octets, std::int64_t number) {
    out_.push_back(garmin::encode_packet(type, octets, number));
  }

  std::optional<std::string> range() {
    if (!rest_.has_range_nm()) return std::nullopt;
    const double wanted_m = rest_.range_nm() * 1852.0;
    const auto nearest = std::min_element(
        garmin::kRanges.begin(), garmin::kRanges.end(),
        [&](double a, double b) { return std::fabs(a - wanted_m) < std::fabs(b - wanted_m); });
    if (!(std::fabs(*nearest - wanted_m) <= kSameXhdRange * wanted_m)) {
      return fmt::format("range: a {} has no range of {:g} NM; allowed: 1/8 to 48 NM", kXhd,
                         rest_.range_nm());
    }
    send(Type::range, 4, *nearest);
    rest_.clear_range_nm();
    return std::nullopt;
  }

  void levels() {
    if (rest_.has_gain_auto()) send(Type::gain_auto, 1, rest_.gain_auto() ? 2 : 0);
    rest_.clear_gain_auto();
    if (rest_.has_gain()) send(Type::gain, 2, hundredths(rest_.gain()));
    rest_.clear_gain();
    if (rest_.has_sea() || rest_.has_sea_auto()) {
      const bool automatic = rest_.has_sea_auto() ? rest_.sea_auto() : now_.sea_auto();
      const double sea = rest_.has_sea() ? rest_.sea() : now_.sea();
      // By itself: calm, medium or rough for a trim of 25, 50 or 75.
      send(Type::sea_mode, 1, automatic ? 2 : sea > 0.0 ? 1 : 0);
      if (automatic) {
        send(Type::sea_auto_level, 1, std::clamp(std::llround((sea - 25.0) / 25.0), 0LL, 2LL));
      } else if (sea > 0.0) {
        send(Type::sea, 2, hundredths(sea));
      }
      rest_.clear_sea();
      rest_.clear_sea_auto();
    }
    if (rest_.has_rain()) {
      send(Type::rain_on, 1, rest_.rain() > 0.0);
      if (rest_.rain() > 0.0) send(Type::rain, 2, hundredths(rest_.rain()));
    }
    rest_.clear_rain();
    if (rest_.has_interference_rejection()) {
      send(Type::rejection, 1, xhd_rejection_of(rest_.interference_rejection()));
    }
    rest_.clear_interference_rejection();
  }

  std::optional<std::string> installation() {
    if (rest_.has_bearing_alignment_deg()) {
      send(Type::alignment, 4, raw_angle(rest_.bearing_alignment_deg()));
    }
    rest_.clear_bearing_alignment_deg();
    if (rest_.has_rotation_rpm()) {
      send(Type::speed, 1, rest_.rotation_rpm() >= kFastFrom_rpm);
    }
    rest_.clear_rotation_rpm();
    if (!rest_.has_blanked_sectors()) return std::nullopt;
    const auto& sectors = rest_.blanked_sectors().sectors();
    if (sectors.size() > 1) return fmt::format("a {} has one blanked sector", kXhd);
    send(Type::no_transmit_on, 1, !sectors.empty());
    if (!sectors.empty()) {
      send(Type::no_transmit_from, 4, raw_angle(sectors[0].from_deg()));
      send(Type::no_transmit_to, 4, raw_angle(sectors[0].to_deg()));
    }
    rest_.clear_blanked_sectors();
    return std::nullopt;
  }

  wire::Set rest_;
  const wire::Settings& now_;
  std::vector<Bytes> out_;
};

}  // namespace

Commands garmin_commands(const wire::Set& set, const wire::Settings& now) {
  return XhdOrder(set, now).commands();
}

}  // namespace skerry::server
