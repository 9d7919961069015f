#include "echo/returns/shore_profile.hpp"

#include <algorithm>

namespace skerry::echo {
namespace {

constexpr double kApron = 40.0;               // metres of open quay behind the face
constexpr double kBuiltUp = 300.0;            // metres to where the natural rise begins
constexpr double kApronGamma = 0.0316;        // -15 dB
constexpr double kBuiltUpGamma = 0.316;       // -5 dB: urban
constexpr double kBeachGamma = 0.01;          // -20 dB: flat
constexpr double kBehindBeachGamma = 0.0316;  // -15 dB: farmland
constexpr double kBeachWidth = 150.0;         // metres above high water

// 0 up to `from`, 1 from `to` on.
double ramp(double x, double from, double to) {
  return std::clamp((x - from) / (to - from), 0.0, 1.0);
}

Ground artificial(double face, double inland, double broad, double fine, bool built) {
  const double roofs =
      built ? 6.0 * std::max(0.0, fine + 0.3) * ramp(inland, kApron, kApron + 20.0) : 0.0;
  const double town = 1.0 - ramp(inland, kBuiltUp, 2.0 * kBuiltUp);
  const double rise = land_height(std::max(0.0, inland - kBuiltUp), broad, fine) - kBankHeight;
  const double built_up = ramp(inland, kApron, kApron + 20.0);
  return {std::max(0.5, face + roofs * town + rise),
          kApronGamma + (kBuiltUpGamma - kApronGamma) * built_up +
              (kLandGamma - kBuiltUpGamma) * (1.0 - town)};
}

Ground sandy(double foreshore, double inland, double broad, double fine) {
  const double beach = std::max(0.0, kBeachWidth + foreshore);
  const double behind = std::max(0.0, inland - beach);
  const double rise = 12.0 * behind / (behind + 900.0) * (1.0 + 0.5 * broad);
  const double rough = std::min(0.02 * behind, 2.0);
  const double dry = ramp(inland, 0.0, kWetEdge);
  return {kBeachSlope * std::min(inland, beach) + rise + rough * fine,
          dry * (kBeachGamma + (kBehindBeachGamma - kBeachGamma) * ramp(behind, 0.0, 350.0))};
}

bool is(const ShoreState& state, CoastType type) { return state.shore.type == type; }

}  // namespace

Ground ground_behind(const ShoreState& state, double inland_m, double broad_noise,
                     double fine_noise, bool roofs) {
  if (is(state, CoastType::sandy))
    return sandy(state.foreshore_m, inland_m, broad_noise, fine_noise);
  if (is(state, CoastType::artificial))
    return artificial(face_height(state), inland_m, broad_noise, fine_noise, roofs);
  const double height = land_height(inland_m, broad_noise, fine_noise);
  if (state.shore.height_m <= 0.0f) return {height, kLandGamma};
  return {std::max(0.5, height + (bank_height(state) - kBankHeight)), kLandGamma};
}

double cover_share(const ShoreState& state, double inland_m) {
  if (is(state, CoastType::sandy)) return ramp(inland_m, 0.0, kWetEdge);
  if (is(state, CoastType::artificial)) return ramp(inland_m, kApron, kApron + 20.0);
  return 1.0;
}

double greatest_height(const ShoreState& state, double inland_m) {
  return ground_behind(state, inland_m, 1.0, 1.0).height_m;
}

double face_height(const ShoreState& state) {
  if (!is(state, CoastType::artificial)) return 0.0;
  const double charted = static_cast<double>(state.shore.height_m);
  return std::max(0.5, (charted > 0.0 ? charted : kFaceHeight) - state.water_level_m);
}

double bank_height(const ShoreState& state) {
  if (is(state, CoastType::sandy)) return 0.0;
  if (is(state, CoastType::artificial)) return face_height(state);
  const double charted = static_cast<double>(state.shore.height_m);
  return charted > 0.0 ? charted : kBankHeight;
}

double roughness(const ShoreState& state, double inland_m) {
  return is(state, CoastType::sandy) ? std::min(0.02 * inland_m, 2.0)
                                     : std::min(0.16 * inland_m, 26.0);
}

}  // namespace skerry::echo
