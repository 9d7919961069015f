// Voyages whose instruments are compared with the truth: each goes where a sentence may go wrong.
#pragma once

#include <chrono>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "server/world/scenario.pb.h"
#include "server/world/world.hpp"

namespace skerry::system_test {

struct Voyage {
  // What is ordered at the begin of each scene, on board and of the weather.
  using Scene = std::function<void(server::World& world, int scene, std::mt19937& random)>;

  std::string name = {};
  scenario::Scenario scenario = {};     // own ship 0 and three targets
  std::chrono::sys_days midnight = {};  // in the middle of it
  Scene scene = {};
};

// Of five classes: over the equator and the 180th meridian, astern by a wild rudder in the south
// west, about north in waves, lying still at 0 N 0 E before a current takes her, and in shallow
// water in a storm.
std::vector<Voyage> voyages();

}  // namespace skerry::system_test
