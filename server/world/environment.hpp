// Environment: sea, air, rain and the artefacts let through: what an instructor may change.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "echo/scene/artefacts.hpp"
#include "echo/scene/weather.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/controls.pb.h"
#include "server/world/scenario.pb.h"
#include "server/world/waters/banks.hpp"
#include "server/world/waters/waters.hpp"

namespace skerry::server {

// A rain cell and the way it takes: a rhumb line from where it was.
struct RainCloud {
  std::uint32_t id = 0;  // from 1, never given twice within a run
  GeoPoint from;
  Duration since{};         // when it was there, on the exercise's clock
  double course_deg = 0.0;  // true, whither
  double speed_mps = 0.0;
  double radius_m = 0.0;
  double rate_mm_h = 0.0;
  echo::RainKind kind = echo::RainKind::cell;
};

// By eye, the greatest: clear weather.  As scenario.proto has it.
constexpr double kClearVisibility_nm = 30.0;

// Immutable once in force.  Directions of sea and swell are from true north here.
struct Environment {
  echo::Atmosphere atmosphere;
  echo::SeaSurface sea;
  double wave_height_m = 0.0;     // significant, on the beaches
  std::optional<double> wind_kn;  // absent: the wind that raises the sea state
  double current_set_deg = 0.0;   // whither; besides the tidal streams
  double current_kn = 0.0;
  double depth_m = 1000.0;                     // besides the tide
  double visibility_nm = kClearVisibility_nm;  // by eye: for traffic and people, not for radars
  std::shared_ptr<const Waters> waters = std::make_shared<const Waters>(scenario::Scenario());
  std::shared_ptr<const Banks> banks;  // null: there are none
  std::vector<RainCloud> rain;
  std::uint32_t next_rain_id = 1;
  echo::Artefacts artefacts;
};
using EnvironmentPtr = std::shared_ptr<const Environment>;

// The environment at the scenario's begin.  Its rain cells have the numbers 1, 2, ... in their
// order.
Environment environment_of(const scenario::Scenario& scenario);

// Current and tidal stream together.  The instructor's alone where no stream is known.
struct CurrentHere {
  double set_deg = 0.0;  // whither
  double mps = 0.0;
};
CurrentHere current_at(const Environment& environment, GeoPoint at, Duration time);

// The kinds of the schema and of the echo are the same, in the same order.
echo::RainKind rain_kind(wire::RainKind kind);

// Where the middle of a cell is at a time of the exercise.
GeoPoint place_of(const RainCloud& cloud, Duration time);

}  // namespace skerry::server
