// PointEcho: what a point sends back, on its way into the spokes.
#pragma once

#include <cstdint>
#include <vector>

namespace skerry::echo {

struct PointEcho {
  double range_m = 0.0;             // from the antenna
  std::uint32_t bearing_units = 0;  // clockwise from the plane's north, 2^32 = one turn
  float power = 0.0f;               // signal over noise in the middle of the beam
  float phase = 0.0f;               // turns; points of one body in one cell add as voltages
  std::uint32_t body = 0;           // points with the same number are one body
  float height_m = 0.0f;            // over the water, for shadows
};

// Echoes strong enough to be seen all round: through side lobes, by way of masts and hulls.
struct StrongEchoes {
  std::vector<PointEcho> points;  // of one body together
  std::uint64_t version = 0;      // another one whenever the points are others
};

// Body numbers: the kind above, which one of the scene's below.  Kinds from `false_echo` on are of
// what is not there, or not there where it shows (second trace: far_...).
enum class BodyKind : std::uint32_t {
  ship,
  wake,
  point,
  turbine,
  cable,
  false_echo = 8,
  far_coast = 12,
  far_ship = 13,
  far_point = 14
};
constexpr std::uint32_t body_of(BodyKind kind, std::uint32_t index) {
  return static_cast<std::uint32_t>(kind) << 28 | (index & 0x0FFFFFFFu);
}

// More than any echo: a thousand ships beside the antenna.  Keeps sums of powers below 1e30.
inline constexpr float kMaxPointPower = 1e24f;

// Side lobe echoes weaker than this part of the noise are left out.
inline constexpr double kLeastLobePower = 0.05;

}  // namespace skerry::echo
