// Scenes that a plotter has to stand, as scenarios.
#pragma once

#include <string>
#include <vector>

namespace skerry::bench {

struct PlotterScene {
  std::string name;
  std::string yaml;
  double minutes = 10.0;
  bool all = false;     // also what stays is to be tracked
  bool targets = true;  // false: whatever is tracked is false
};

std::vector<PlotterScene> plotter_scenes();

}  // namespace skerry::bench
