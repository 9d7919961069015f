// The controls of a radar and of a view.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "echo/scene/own_rig.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry::echo {

// Controls of the transmitter and antenna, common to all views.
struct RadarControls {
  bool transmit = true;
  PulseChoice pulse = PulseChoice::automatic;
  bool tune_auto = true;
  double tune = 50.0;                       // 0 to 100 by hand; 50 is right on the frequency
  double rotation_rpm = 0.0;                // 10 to 60; 0: as the set turns
  double bearing_alignment_deg = 0.0;       // -180 to 180: how far the picture is turned clockwise
  double antenna_height_m = 0.0;            // 1 to 100; 0: the set's
  std::vector<BlankedSector> blanked = {};  // where the transmitter is off; at most kMostBlanked
  friend bool operator==(const RadarControls&, const RadarControls&) = default;
};

// How a cell that holds several samples combines them.
enum class Decimation : std::uint8_t { peak, mean };

// Which cells are coloured by their radial speed.
enum class DopplerMode : std::uint8_t { off, both, approaching };

// The purpose that the picture is set for; anything but custom decides gain, sea, rain and what
// cleans the picture by itself.
enum class PictureMode : std::uint8_t { custom, harbour, offshore, buoy, weather, bird };

// The longest instrumented range: twice the longest range scale.
inline constexpr double kFarthestShownM =
    2.0 * nautical_miles(RangeScale::kNauticalMiles.back()).in_metres();

// All but the range scale and the switches run from 0 to 100, as on a real set.
struct ViewControls {
  RangeScale range_scale{};
  double gain = 50.0;
  double sea = 20.0;                    // sensitivity time control
  double rain = 0.0;                    // differentiation (fast time constant)
  double interference_rejection = 0.0;  // 0: off
  double echo_stretch = 0.0;            // 0: off; 100: three cells to either side
  double integration = 0.0;             // 0: off; 100: over all spokes of a beam
  bool sea_auto = false;                // follows the clutter by itself; `sea` then trims about 50
  bool stretch_bearing = false;         // echo_stretch acts across spokes too
  Decimation decimation = Decimation::peak;
  bool gain_auto = false;              // gain follows noise and clutter
  double side_lobe_suppression = 0.0;  // 0: off
  bool side_lobe_auto = false;
  double noise_rejection = 0.0;    // 0: off
  double target_separation = 0.0;  // 0: off; sharpens the beam
  double target_boost = 0.0;       // 0: off; small echoes made stronger
  DopplerMode doppler = DopplerMode::off;
  double doppler_threshold_mps = 2.0;  // 0.1 to 20: what is slower is not coloured
  PictureMode mode = PictureMode::custom;
  // Range at which the last cell ends; 0: the range scale.  See reach_of.
  double instrumented_range_m = 0.0;
  friend bool operator==(const ViewControls&, const ViewControls&) = default;
};

// The controls in force where a picture mode or an automatic control decides: `mode` is custom
// then, and side lobe suppression a number.  What is custom and manual stays as it is.  The range
// scale, the instrumented range, decimation and Doppler colours are no mode's affair.
ViewControls effective_controls(const ViewControls& controls);

// The end of a view's last cell: at the range scale, or at its instrumented range as far as
// that lies within a sixteenth of the range scale and twice it; the nearest of the two where not.
Length reach_of(const ViewControls& controls);

// How many cells a radar's rows need, of its own length, for a view of `controls` on a radar on
// `scale`: geometry.cells, or more by quarters of that, up to twice as many.
std::uint32_t row_cells_for(const ScanGeometry& geometry, RangeScale scale,
                            const ViewControls& controls);

// The fault of the controls: the name of the first one outside its range, the range and its value;
// nullopt if all are well.
std::optional<std::string> fault_of(const RadarControls& controls);
std::optional<std::string> fault_of(const ViewControls& controls);

// The loss of an echo by tuning, dB >= 0: a detuned receiver has the echoes on the flank of its
// filter, 12 dB (f - f0)^2 / B^2 as of a Gaussian one (3 dB at half a bandwidth), and the knob
// moves f by kTuningSpan bandwidths to either side of 50.  Nothing for automatic tuning, which
// follows the transmitter at once.  Receiver noise, and what is broader than the filter (SART),
// stay. Source: SOURCES.md "Receiver" for the law; the span is this receiver's own.
inline constexpr double kTuningSpan = 1.5;
double tune_loss_db(const RadarControls& controls);

}  // namespace skerry::echo
