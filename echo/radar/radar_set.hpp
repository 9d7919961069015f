// RadarSet: antenna, transmitter and receiver front end, as constants of the equipment.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/video/range_scale.hpp"

namespace skerry::echo {

inline constexpr double kLightSpeed = 299792458.0;  // m/s, exact

// Range of a log amplifier as on ships; small craft's displays are given as little as 6 dB.
inline constexpr double kLogVideoDb = 45.0;

enum class Band : std::uint8_t { x, s };
enum class Polarisation : std::uint8_t { hh, vv };

// One pulse of a set, with the receiver behind it.
struct Pulse {
  double length_s = 0.0;
  double bandwidth_hz = 0.0;  // noise bandwidth of the receiver
  double prf_hz = 1000.0;     // pulses per second
  double up_to_nm = 96.0;     // longest range scale that chooses this pulse by itself
  // Energy over that of the peak power over the length, dB: of a coded pulse or a sweep, of which
  // `length_s` is what it is compressed to.
  double compression_db = 0.0;
  friend bool operator==(const Pulse&, const Pulse&) = default;
};

// A level of 16 that a set's video has, and where it begins: a share of the video's decibels.
struct VideoLevel {
  double from = 0.0;   // 0 to 1
  double shown = 0.0;  // 1 to 15
  friend bool operator==(const VideoLevel&, const VideoLevel&) = default;
};

// What the receiver's filter makes of an echo along range (range_response.hpp), each of the pulse's
// bandwidth.
enum class RangeFilter : std::uint8_t {
  none,       // an echo is as long as the pulse and has sharp ends
  two_poles,  // it rises and decays: tuned amplifiers
  gaussian,   // both its ends are alike: pulses compressed, or sweeps analysed, under a window
};

// Which pulse the operator wants.
enum class PulseChoice : std::uint8_t { automatic, short_pulse, medium_pulse, long_pulse };

// Defaults: a 25 kW X-band set with a 6 ft antenna.  Source: SOURCES.md "Sets" (typical brochures).
struct RadarSet {
  std::string name = "25 kW X";
  double frequency_hz = 9.41e9;
  double peak_power_w = 25e3;
  double antenna_gain_db = 31.0;
  double beam_width_deg = 1.2;       // horizontal, one way, -3 dB
  double vertical_beam_deg = 22.0;   // -3 dB
  double near_side_lobe_db = -28.0;  // one way, highest within 10 deg of the beam
  double far_side_lobe_db = -32.0;   // one way, highest beyond
  Polarisation polarisation = Polarisation::hh;
  double rpm = 24.0;
  double antenna_height_m = 20.0;  // over the water
  double noise_figure_db = 5.0;
  double losses_db = 3.0;               // feeder and radome, both ways
  double video_range_db = kLogVideoDb;  // from the first level of the video to the last
  // Its levels where they are not 16 even ones, ascending; what lies below the first is 0.  8-bit
  // video is joined straight within each level.
  std::vector<VideoLevel> levels;
  RangeFilter range_filter = RangeFilter::none;
  // Cells over which it averages its video along range, twice (smooth_video()); 1: not at all.
  std::uint32_t video_smoothing = 1;
  // What the set's processing always integrates, 0 to 100 % of the two-way beam's spokes as the
  // view's control has it (azimuth_memory.hpp); the larger of the two holds.
  double integration = 0.0;
  // Shortest first; up_to_nm grows.
  std::vector<Pulse> pulses = {{0.08e-6, 20e6, 3000.0, 1.5},
                               {0.25e-6, 10e6, 1800.0, 3.0},
                               {0.5e-6, 5e6, 1000.0, 12.0},
                               {1.0e-6, 3e6, 600.0, 96.0}};

  Band band() const { return frequency_hz < 6e9 ? Band::s : Band::x; }
  double wavelength_m() const { return kLightSpeed / frequency_hz; }

  // The pulse of a range scale: by itself, or the shortest, middle or longest one as chosen, or the
  // nearest longer one whose echoes from the end of the scale are back before the next pulse.
  // Requires at least one pulse.
  const Pulse& pulse_for(RangeScale scale, PulseChoice choice = PulseChoice::automatic) const {
    const auto at_least = [&](std::size_t wanted) -> const Pulse& {
      while (wanted + 1 < pulses.size() &&
             0.5 * kLightSpeed / pulses[wanted].prf_hz < scale.length().in_metres()) {
        ++wanted;
      }
      return pulses[wanted];
    };
    switch (choice) {
      case PulseChoice::short_pulse:
        return at_least(0);
      case PulseChoice::medium_pulse:
        return at_least(pulses.size() / 2);
      case PulseChoice::long_pulse:
        return pulses.back();
      case PulseChoice::automatic:
        break;
    }
    const auto fits = std::find_if(pulses.begin(), pulses.end(), [&](const Pulse& p) {
      return scale.in_nautical_miles() <= p.up_to_nm;
    });
    return fits == pulses.end() ? pulses.back() : *fits;
  }
};

}  // namespace skerry::echo
