// Senders on the radar's own frequency: racons, SARTs, other radars.  Within the ranges given every
// power is finite; whoever fills these in checks them (the scenario does by its schema).
#pragma once

#include <cstdint>
#include <string>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

struct Racon {
  PlanePoint place;
  double height_m = 10.0;  // 0 to 500
  std::string code = "K";  // Morse letters, 1 to 4 of A-Z
  bool x_band = true, s_band = true;
  double delay_s = 0.7e-6;  // from interrogation to reply, 0 to 10 us
  double length_s = 25e-6;  // of the whole reply, 5 to 100 us
  // Replies during the first on_s of every period: 0 to period_s, 0.5 to 3600 s.
  double on_s = 20.0, period_s = 60.0;
  // Replies to ships seen from it within this sector, clockwise from the plane's north; both 0:
  // all.
  double sector_from_deg = 0.0, sector_to_deg = 0.0;
  double power_w = 1.0, antenna_gain_db = 6.0;  // 0.001 to 100; 0 to 20
  std::uint64_t identity = 0;
  double threshold_dbm = -40.0;       // weakest pulse it answers, at its receiver: -70 to 0
  bool side_lobe_suppression = true;  // answers a radar's main beam alone
};

// Search and rescue transponder, X band only.
struct Sart {
  PlanePoint place;
  PlanePoint velocity;
  double height_m = 1.0;  // 0 to 100
  std::uint64_t identity = 0;
};

// Another radar whose pulses are heard.
struct Emitter {
  PlanePoint place;
  PlanePoint velocity;
  double height_m = 20.0;         // 0 to 500
  double frequency_hz = 9.41e9;   // 1e9 to 40e9
  double power_w = 25e3;          // 0.01 to 1e6
  double antenna_gain_db = 31.0;  // 0 to 50
  double side_lobe_db = -28.0;    // -60 to -10
  double beam_width_deg = 1.2;    // 0.1 to 30
  double pulse_s = 0.5e-6;        // 1e-8 to 1e-4
  double prf_hz = 1000.0;         // 100 to 20000
  double rpm = 24.0;              // 1 to 240
  double bearing_deg = 0.0;       // of its beam from the plane's north, at scenario time 0
  std::uint64_t identity = 0;
  friend bool operator==(const Emitter&, const Emitter&) = default;
};

}  // namespace skerry::echo
