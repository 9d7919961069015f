#include "echo/beacons/beacon_faults.hpp"

#include <array>
#include <cstdio>
#include <span>

#include "echo/beacons/morse.hpp"

namespace skerry::echo {
namespace {

struct Checked {
  const char* name;
  double value, least, most;
};

std::optional<std::string> first_beacon_fault(std::span<const Checked> all) {
  for (const Checked& c : all) {
    if (c.value >= c.least && c.value <= c.most) continue;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%s must be %g to %g, is %g", c.name, c.least, c.most,
                  c.value);
    return std::string(text.data());
  }
  return std::nullopt;
}

constexpr double kFarthestPlace = 1e6;  // metres from the plane's anchor
constexpr double kFastest = 100.0;      // m/s

}  // namespace

std::optional<std::string> fault_of(const Racon& racon) {
  if (marks_of(racon.code).count == 0)
    return "code must be 1 to 4 letters A to Z, is '" + racon.code.substr(0, 20) + "'";
  const std::array checks = {
      Checked{"place", racon.place.east_m, -kFarthestPlace, kFarthestPlace},
      Checked{"place", racon.place.north_m, -kFarthestPlace, kFarthestPlace},
      Checked{"height_m", racon.height_m, 0.0, 500.0},
      Checked{"delay_s", racon.delay_s, 0.0, 10e-6},
      Checked{"length_s", racon.length_s, 5e-6, 100e-6},
      Checked{"period_s", racon.period_s, 0.5, 3600.0},
      Checked{"on_s", racon.on_s, 0.0, racon.period_s},
      Checked{"sector_from_deg", racon.sector_from_deg, 0.0, 360.0},
      Checked{"sector_to_deg", racon.sector_to_deg, 0.0, 360.0},
      Checked{"power_w", racon.power_w, 0.001, 100.0},
      Checked{"antenna_gain_db", racon.antenna_gain_db, 0.0, 20.0},
      Checked{"threshold_dbm", racon.threshold_dbm, -70.0, 0.0},
  };
  return first_beacon_fault(checks);
}

std::optional<std::string> fault_of(const Sart& sart) {
  const std::array checks = {
      Checked{"place", sart.place.east_m, -kFarthestPlace, kFarthestPlace},
      Checked{"place", sart.place.north_m, -kFarthestPlace, kFarthestPlace},
      Checked{"velocity", sart.velocity.east_m, -kFastest, kFastest},
      Checked{"velocity", sart.velocity.north_m, -kFastest, kFastest},
      Checked{"height_m", sart.height_m, 0.0, 100.0},
  };
  return first_beacon_fault(checks);
}

std::optional<std::string> fault_of(const Emitter& emitter) {
  const std::array checks = {
      Checked{"place", emitter.place.east_m, -kFarthestPlace, kFarthestPlace},
      Checked{"place", emitter.place.north_m, -kFarthestPlace, kFarthestPlace},
      Checked{"velocity", emitter.velocity.east_m, -kFastest, kFastest},
      Checked{"velocity", emitter.velocity.north_m, -kFastest, kFastest},
      Checked{"height_m", emitter.height_m, 0.0, 500.0},
      Checked{"frequency_hz", emitter.frequency_hz, 1e9, 40e9},
      Checked{"power_w", emitter.power_w, 0.01, 1e6},
      Checked{"antenna_gain_db", emitter.antenna_gain_db, 0.0, 50.0},
      Checked{"side_lobe_db", emitter.side_lobe_db, -60.0, -10.0},
      Checked{"beam_width_deg", emitter.beam_width_deg, 0.1, 30.0},
      Checked{"pulse_s", emitter.pulse_s, 1e-8, 1e-4},
      Checked{"prf_hz", emitter.prf_hz, 100.0, 20000.0},
      Checked{"rpm", emitter.rpm, 1.0, 240.0},
      Checked{"bearing_deg", emitter.bearing_deg, -360.0, 360.0},
  };
  return first_beacon_fault(checks);
}

}  // namespace skerry::echo
