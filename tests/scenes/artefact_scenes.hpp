// One scene for each artefact and each thing that echoes in a way of its own.
#pragma once

#include <string>
#include <vector>

#include "tests/scenes/scenes.hpp"

namespace skerry::scenes {

// The scene, and the same one without what it shows: its switch off, or its cause taken away.
struct ArtefactScene {
  std::string name;     // at most 24 characters
  std::string caption;  // what to look for, at most 48 characters
  NamedScene with;
  echo::ScenePtr without;
  std::uint32_t scan = 0;  // the turn that is shown
};

// All of them, in the order of the contact sheet: 1024 spokes of 512 cells, head up and north up
// alike.
std::vector<ArtefactScene> artefact_scenes();

// One by its name.  Error: std::out_of_range.
ArtefactScene artefact_scene(const std::string& name);

// Places in these scenes, metres and degrees from the own ship, for the tests.
namespace places {
inline constexpr double kSideLobeShip = 1500.0;
inline constexpr double kParallelShip = 700.0;
inline constexpr double kMastTarget = 2400.0, kMastTargetDeg = 60.0;
inline constexpr double kFarCoastNm = 29.5;
inline constexpr double kCableEast = 1500.0;  // its nearest point, due east
inline constexpr double kStrongTarget = 320.0, kStrongTargetDeg = 45.0;
inline constexpr double kRaconNm = 2.0;
inline constexpr double kFarSartNm = 3.5, kNearSartNm = 0.3;
inline constexpr double kRainEast = 5000.0, kRainNorth = 4000.0, kRainRadius = 3000.0;
inline constexpr double kShadowingShip = 700.0, kShadowedBoat = 1500.0;
inline constexpr double kHiddenShip = 3000.0;
inline constexpr double kSwayBuoy = 500.0;
}  // namespace places

}  // namespace skerry::scenes
