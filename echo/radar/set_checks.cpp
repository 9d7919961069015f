#include "echo/radar/set_checks.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/video_stages.hpp"
#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
namespace {

constexpr double kGreatestDuty = 0.01;
constexpr double kGainTolerance = 3.0;  // dB
constexpr std::size_t kMostPulses = 16;
constexpr double kMetresPerMile = 1852.0;

class Faults {
 public:
  bool within(const std::string& name, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return true;
    add("%s: %g is outside %g to %g %s", name, value, low, high, unit);
    return false;
  }
  void band(double frequency_hz) {
    const double ghz = frequency_hz * 1e-9;
    if ((ghz >= 2.85 && ghz <= 3.15) || (ghz >= 9.15 && ghz <= 9.55)) return;
    add("%s: %g GHz is in neither band: S 2.85 to 3.15 GHz, X 9.15 to 9.55 GHz", "frequency_hz",
        ghz);
  }
  void gain(const RadarSet& set) {
    const double by_beams = gain_of_beams_db(set.beam_width_deg, set.vertical_beam_deg);
    const double gain = set.antenna_gain_db;
    if (gain >= by_beams - kGainTolerance && gain <= by_beams + kGainTolerance) return;
    add("%s: %g dB does not go with the beam widths, which make %.1f dB: %.1f to %.1f dB",
        "antenna_gain_db", gain, by_beams, by_beams - kGainTolerance, by_beams + kGainTolerance);
  }
  template <typename... Numbers>
  void add(const char* format, const std::string& name, Numbers... numbers) {
    char text[256];
    std::snprintf(text, sizeof text, format, name.c_str(), numbers...);
    list_.emplace_back(text);
  }
  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

void check_pulse(Faults& faults, const Pulse& pulse, const Pulse* before, std::size_t index) {
  const std::string name = "pulses[" + std::to_string(index) + "]";
  faults.within(name + ".length_s", pulse.length_s, 0.02e-6, 5e-6, "s");
  faults.within(name + ".prf_hz", pulse.prf_hz, 100.0, 20000.0, "Hz");
  faults.within(name + ".up_to_nm", pulse.up_to_nm, 0.125, 96.0, "NM");
  faults.within(name + ".compression_db", pulse.compression_db, -10.0, 40.0, "dB");
  if (before && !(pulse.length_s > before->length_s))
    faults.add("%s: %g s is not longer than the pulse before it, %g s", name + ".length_s",
               pulse.length_s, before->length_s);
  if (before && !(pulse.up_to_nm > before->up_to_nm))
    faults.add("%s: %g NM is not beyond the pulse before it, %g NM", name + ".up_to_nm",
               pulse.up_to_nm, before->up_to_nm);
  if (!(pulse.length_s > 0.0) || !(pulse.prf_hz > 0.0)) return;
  faults.within(name + ".bandwidth_hz", pulse.bandwidth_hz, 0.5 / pulse.length_s,
                8.0 / pulse.length_s, "Hz (0.5 to 8 over the pulse length)");
  faults.within(name + ".prf_hz", pulse.prf_hz, 0.0, kGreatestDuty / pulse.length_s,
                "Hz (a duty of at most 1 %)");
  faults.within(name + ".prf_hz", pulse.prf_hz, 0.0,
                unambiguous_range_m(1.0) / (kMetresPerMile * pulse.up_to_nm),
                "Hz (echoes from up_to_nm must be back before the next pulse)");
}

}  // namespace

double gain_of_beams_db(double beam_width_deg, double vertical_beam_deg) {
  return decibels_from_ratio(26000.0 / (beam_width_deg * vertical_beam_deg));
}

std::vector<std::string> faults_of(const RadarSet& set) {
  Faults faults;
  bool beams = true;
  for (const SetLimit& limit : kSetLimits) {
    if (limit.member == &RadarSet::frequency_hz) {
      faults.band(set.frequency_hz);
    } else if (!faults.within(std::string(limit.name), set.*limit.member, limit.min, limit.max,
                              limit.unit.data())) {
      beams = beams && limit.member != &RadarSet::beam_width_deg &&
              limit.member != &RadarSet::vertical_beam_deg;
    }
  }
  if (beams) faults.gain(set);
  if (set.far_side_lobe_db > set.near_side_lobe_db)
    faults.add("%s: %g dB is above near_side_lobe_db, %g dB", "far_side_lobe_db",
               set.far_side_lobe_db, set.near_side_lobe_db);
  faults.within("video_smoothing", set.video_smoothing, 1.0, kMostSmoothed, "cells");
  if (set.pulses.empty() || set.pulses.size() > kMostPulses)
    faults.add("%s: %zu is outside 1 to %zu pulses", "pulses", set.pulses.size(), kMostPulses);
  for (std::size_t i = 0; i < std::min(set.pulses.size(), kMostPulses); ++i)
    check_pulse(faults, set.pulses[i], i > 0 ? &set.pulses[i - 1] : nullptr, i);
  return faults.take();
}

}  // namespace skerry::echo
