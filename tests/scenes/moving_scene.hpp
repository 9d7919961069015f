// MovingScene: a scene that goes on in time, as the server's does.
#pragma once

#include "echo/scene/scene.hpp"

namespace skerry::scenes {

// Everything moves on straight from the scene it was made of; the coast's index is laid anew where
// it no longer serves, the coast itself is kept: good for a sail of its slack.
class MovingScene {
 public:
  explicit MovingScene(echo::ScenePtr start);

  // The scene of the tick (100 ms) before `time`; the same pointer within a tick.
  echo::ScenePtr at(ScenarioTime time);

 private:
  echo::ScenePtr start_, now_;
};

}  // namespace skerry::scenes
