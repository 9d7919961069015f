#include "echo/radar/shipped_sets.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

// Of pulses as they come out of compression, and the scale from which they grow no longer.
constexpr double kShortest_s = 0.021e-6, kLongest_s = 1.2e-6, kLongestScale_nm = 12.0;

// A river radar.  All [unverified]: short pulses, a long antenna, turning fast.
RadarSet river_x() {
  RadarSet set;
  set.name = "river X";
  set.peak_power_w = 4e3;
  set.antenna_gain_db = 30.0;
  set.beam_width_deg = 1.0;
  set.vertical_beam_deg = 25.0;
  set.rpm = 40.0;
  set.antenna_height_m = 8.0;
  set.losses_db = 1.0;
  set.pulses = {{0.05e-6, 25e6, 4000.0, 1.5},
                {0.15e-6, 12e6, 3000.0, 3.0},
                {0.3e-6, 6e6, 1500.0, 12.0},
                {0.6e-6, 4e6, 800.0, 96.0}};
  return set;
}

// 30 kW, 12 ft, 21 or 26 rpm [read: Furuno FAR-2137S, SOURCES.md "Sets"]; bandwidths [read: IMO
// SN/Circ.197]; the rest [unverified: table of "Sets"].
RadarSet thirty_kilowatt_s() {
  RadarSet set;
  set.name = "30 kW S";
  set.frequency_hz = 3.05e9;
  set.peak_power_w = 30e3;
  set.antenna_gain_db = 28.0;
  set.beam_width_deg = 1.8;
  set.vertical_beam_deg = 25.0;
  set.near_side_lobe_db = -26.0;
  set.far_side_lobe_db = -30.0;
  set.rpm = 26.0;
  set.antenna_height_m = 22.0;
  set.noise_figure_db = 4.0;
  set.losses_db = 2.0;
  set.pulses = {{0.08e-6, 20e6, 3000.0, 1.5},
                {0.3e-6, 10e6, 1500.0, 3.0},
                {0.6e-6, 5e6, 1000.0, 12.0},
                {1.2e-6, 3e6, 600.0, 96.0}};
  return set;
}

// Domes of small craft send long coded pulses or sweeps of a few watts.  They are modelled as the
// pulse set that is as good: a pulse as long as the compressed one, of the same energy, in a
// receiver of one over its length.  The code's range side lobes, and the near blindness of long
// codes, are left out. Power [computed] from 25 W and codes of 5 to 100 us [unverified]: a
// time-bandwidth product of about 120.
RadarSet dome(std::string name, double peak_power_w, double beam_width_deg, double gain_db,
              double rpm) {
  RadarSet set;
  set.name = std::move(name);
  set.frequency_hz = 9.41e9;
  set.peak_power_w = peak_power_w;
  set.antenna_gain_db = gain_db;
  set.beam_width_deg = beam_width_deg;
  set.vertical_beam_deg = 25.0;
  set.near_side_lobe_db = -23.0;
  set.far_side_lobe_db = -30.0;
  set.rpm = rpm;
  set.antenna_height_m = 4.0;
  set.losses_db = 1.0;
  // [computed]: of a Gaussian beam's echo over the first level by x dB sqrt(x / 6) beam widths are
  // seen; saturated points are from 0.86 of a beam wide, medium ones 0.67, weak ones a quarter
  // (SOURCES.md "Pictures (e)").
  set.video_range_db = 6.0;
  set.pulses = {{0.06e-6, 17e6, 3000.0, 0.5},
                {0.1e-6, 10e6, 3000.0, 1.5},
                {0.2e-6, 5e6, 2000.0, 3.0},
                {0.4e-6, 2.5e6, 1500.0, 12.0},
                {0.8e-6, 1.25e6, 750.0, 96.0}};
  return set;
}

// A dome whose echoes of points are `metres` long on the range scale of a mile, and longer in
// proportion to the range scale, behind a filter of `bandwidth_by_length` over the pulse's length:
// the resolution that captures show by range.  Fitted, all of it, to SOURCES.md "Pictures".  Its
// pulses have the energy of dome()'s, those of less than 1.5 NM of that for 1.5 NM, as coded pulses
// and sweeps have.
RadarSet resolving(RadarSet set, double metres, double integration, double video_range_db,
                   double bandwidth_by_length = 1.0) {
  const std::vector<Pulse> energies(set.pulses.begin() + 1, set.pulses.end());
  set.pulses.clear();
  for (const double up_to_nm : {0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 6.0, 12.0, 96.0}) {
    const Pulse& energy = *std::find_if(energies.begin(), energies.end(),
                                        [&](const Pulse& p) { return up_to_nm <= p.up_to_nm; });
    const double asked = metres * std::min(up_to_nm, kLongestScale_nm) / (0.5 * kLightSpeed);
    Pulse pulse = energy;
    pulse.length_s = std::clamp(asked, kShortest_s, kLongest_s);
    pulse.bandwidth_hz = bandwidth_by_length / pulse.length_s;
    pulse.up_to_nm = up_to_nm;
    pulse.compression_db = decibels_from_ratio(pulse.bandwidth_hz / energy.bandwidth_hz);
    // A pulse serves every scale that asks for the same length.
    if (!set.pulses.empty() && pulse.length_s <= set.pulses.back().length_s) set.pulses.pop_back();
    set.pulses.push_back(pulse);
  }
  set.range_filter = RangeFilter::gaussian;
  set.integration = integration;
  set.video_range_db = video_range_db;
  return set;
}

// HALO video: edges rise and fall in straight lines over six cells, whatever a cell's length
// [captures: at cells of 3.1 and of 0.39 m].
RadarSet smoothing(RadarSet set) {
  set.video_smoothing = 4;
  return set;
}

// 4G video: twelve even levels, then the highest [captures: levels 13 and 14 do not occur].
RadarSet levels_of_4g(RadarSet set) {
  for (int k = 1; k <= 12; ++k) set.levels.push_back({k / 16.0, 1.0 * k});
  set.levels.push_back({13 / 16.0, 15.0});
  return set;
}

// A magnetron's plain pulse behind a tuned amplifier.
RadarSet magnetron(RadarSet set) {
  set.range_filter = RangeFilter::two_poles;
  return set;
}

// xHD video: 8 bits, of which the weakest echo shows 40 [captures: nothing is 1 to 38, and all from
// 40 to 254 are as frequent].
RadarSet levels_of_xhd(RadarSet set) {
  constexpr double kFirst = 2.5;
  for (int k = 0; k < 14; ++k) set.levels.push_back({k / (16.0 - kFirst), kFirst + k});
  return set;
}

// Sweeps of 165 mW over 1.3 ms, 200 a second [unverified]: the energy of 0.2 us of 1.1 kW
// [computed].
RadarSet sweeping_dome(std::string name, double beam_width_deg, double gain_db, double rpm) {
  RadarSet set = dome(std::move(name), 1.1e3, beam_width_deg, gain_db, rpm);
  for (Pulse& pulse : set.pulses) pulse.prf_hz = 200.0;
  return set;
}

const auto& all() {
  // Turns of the recorded sets [computed: SOURCES.md "Pictures (j)"]; their beams [unverified],
  // which the azimuth extents of saturated points bear out at 1.0 to 1.5 beam widths (SOURCES.md
  // "Pictures (e)").  The 4G's is the beam as its processing sharpens it; its aperture's is 5.2
  // deg.
  static const std::array sets = {
      RadarSet{},
      river_x(),
      thirty_kilowatt_s(),
      dome("broadband dome", 3e3, 4.9, 23.5, 24.0),
      smoothing(resolving(dome("HALO20", 1.2e3, 4.9, 23.5, 22.8), 20.0, 0.0, 4.8, 0.7)),
      smoothing(resolving(dome("HALO24", 1.2e3, 3.9, 24.2, 24.0), 28.0, 20.0, 4.5, 0.7)),
      levels_of_4g(resolving(sweeping_dome("4G", 2.6, 24.5, 23.874), 32.0, 60.0, 6.0, 0.75)),
      resolving(sweeping_dome("3G", 5.2, 23.0, 24.0), 22.0, 70.0, 3.6, 0.7),
      resolving(sweeping_dome("BR24", 5.2, 23.0, 24.0), 15.0, 50.0, 3.6),
      levels_of_xhd(magnetron(resolving(dome("xHD", 4e3, 3.6, 24.6, 24.0), 16.0, 50.0, 12.0))),
      resolving(dome("Quantum 2", 2.4e3, 4.9, 23.5, 24.0), 20.0, 60.0, 6.0),
  };
  return sets;
}

}  // namespace

std::span<const RadarSet> shipped_sets() { return all(); }

RadarSet find_set(std::string_view name) {
  std::string names;
  for (const RadarSet& set : all()) {
    if (set.name == name) return set;
    names += (names.empty() ? "\"" : ", \"") + set.name + "\"";
  }
  throw std::invalid_argument("there is no radar set \"" + std::string(name) + "\"; there are " +
                              names);
}

}  // namespace skerry::echo
