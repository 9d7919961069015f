// Restricted visibility: how ships that are not in sight of one another behave.
//
// Source: COLREG 1972, rule 19.  (a), (b): who cannot be seen for fog goes at a safe speed; rules
// 12 to 18 are not for her.  (d): who is on her way to a close quarters situation with another that
// she has by radar alone takes avoiding action in ample time, whoever the other is; she avoids
// altering to port for one forward of her beam that she is not overtaking, and towards one abeam
// or abaft it.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/length.hpp"

namespace skerry::server {

// With less visibility than this there is fog.  Assumed: the rules give no number.
constexpr double kFog_m = 3.0 * Length::kMetresPerNauticalMile;

// What can be seen of ships, by eye.
struct Visibility {
  double by_eye_m = 30.0 * Length::kMetresPerNauticalMile;

  bool has_fog() const { return by_eye_m < kFog_m; }
  // In fog ships farther apart are not in sight of one another; without it all are.
  bool in_sight(double apart_m) const { return !has_fog() || apart_m <= by_eye_m; }
};

// Another that is not in sight, as seen on the radar.
struct Unseen {
  double relative_deg = 0.0;  // from the bow, -180 .. 180, starboard positive
  bool is_overtaken = false;  // by the ship herself
};

// The sides that rule 19(d) leaves for an alteration of course on account of all of these.
struct OpenSides {
  bool starboard = true, port = true;
};
OpenSides open_sides(std::span<const Unseen> others);

// The speed she makes in fog, m/s: of what she would make, all at 3 NM of visibility and half of it
// at none, evenly in between; but 6 kn if she would make that, to keep steerage way.  Without fog:
// the same speed.  Source: none, rule 6 gives no numbers; the form is this project's choice.
double safe_speed_mps(double speed_mps, const Visibility& visibility);

}  // namespace skerry::server
