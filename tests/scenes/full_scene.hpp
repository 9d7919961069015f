// The full scene by which speed is judged.
#pragma once

#include <optional>

#include "tests/scenes/scenes.hpp"

namespace skerry::scenes {

struct Traffic {
  int ships = 40;
  int buoys = 100;
};

// Bergen's coast on 6 NM, the own ship under way at 10 kn, ships and buoys on the water around her,
// sea state 4 and two rain cells, all receiver stages on.  Nothing where no chart is installed.
std::optional<NamedScene> full_scene(const Traffic& traffic = {});

}  // namespace skerry::scenes
