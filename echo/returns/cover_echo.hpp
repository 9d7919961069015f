// How each cover of the land echoes.
#pragma once

#include <array>
#include <cstddef>

#include "echo/chart/land_cover.hpp"

namespace skerry::echo {

// Objects stand on the relief in patches: where a noise of wavelength `grain_m` is above `above`,
// which is so on `share` of the ground.
struct CoverEcho {
  LandCover cover = LandCover::none;
  float gamma = 0.0f;      // of ground and objects: sigma over the area shown across the sight line
  float objects_m = 0.0f;  // their height over the ground
  float grain_m = 0.0f;    // from one patch of objects, or gap, to the next
  float share = 0.0f;
  float above = 0.0f;
};

// Source: gamma -5 (urban), -10 (forest), -15 (farmland) and -20 dB (flat land) are Barton's, read
// in programs (SOURCES.md "Land").  Which of these a cover takes where he names none, -12 dB of
// scrub, -8 dB of rock (as the rocky shore has it here), and ALL heights, grains and shares are
// this project's ASSUMPTIONS: usual sizes.
// `above` is the share's quantile of the noise: CoverRow.ObjectsStandOnTheirShareOfTheGround.
inline constexpr std::array<CoverEcho, kLandCovers> kCoverEchoes = {{
    {LandCover::none, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f},
    {LandCover::built_up, 0.316f, 7.0f, 40.0f, 0.5f, 0.0f},        // -5 dB; houses and streets
    {LandCover::industrial, 0.316f, 12.0f, 120.0f, 0.4f, 0.123f},  // -5; sheds and yards
    {LandCover::forest, 0.1f, 15.0f, 30.0f, 0.85f, -0.484f},       // -10; trees and clearings
    {LandCover::scrub, 0.0631f, 3.0f, 20.0f, 0.7f, -0.256f},       // -12
    {LandCover::grass, 0.0316f, 0.0f, 0.0f, 0.0f, 0.0f},           // -15, as farmland
    {LandCover::farmland, 0.0316f, 6.0f, 150.0f, 0.1f, 0.579f},    // -15; hedges and farms
    {LandCover::marsh, 0.01f, 1.0f, 30.0f, 0.7f, -0.256f},         // -20; reeds
    {LandCover::mangrove, 0.1f, 6.0f, 25.0f, 0.9f, -0.581f},       // -10, as forest
    {LandCover::rock, 0.158f, 0.0f, 0.0f, 0.0f, 0.0f},             // -8
    {LandCover::sand, 0.01f, 0.0f, 0.0f, 0.0f, 0.0f},              // -20
    {LandCover::ice, 0.01f, 1.0f, 30.0f, 0.3f, 0.254f},            // -20, as flat land; blocks
    {LandCover::paved, 0.01f, 0.0f, 0.0f, 0.0f, 0.0f},             // -20, as flat land
}};

inline constexpr float kTallestObject = 15.0f;  // of the table

constexpr const CoverEcho& echo_of(LandCover cover) {
  return kCoverEchoes[static_cast<std::size_t>(cover)];
}

static_assert([] {
  for (std::size_t i = 0; i < kCoverEchoes.size(); ++i) {
    if (kCoverEchoes[i].cover != static_cast<LandCover>(i)) return false;
    if (kCoverEchoes[i].objects_m > kTallestObject) return false;
  }
  return true;
}());

}  // namespace skerry::echo
