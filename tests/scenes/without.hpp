// A named scene with one thing changed.
#pragma once

#include <functional>

#include "tests/scenes/scenes.hpp"

namespace skerry::scenes {

NamedScene with(const NamedScene& named, const std::function<void(echo::Scene&)>& change);

void no_sea(echo::Scene& scene);
void no_land(echo::Scene& scene);
void no_rain(echo::Scene& scene);
void no_targets(echo::Scene& scene);

}  // namespace skerry::scenes
