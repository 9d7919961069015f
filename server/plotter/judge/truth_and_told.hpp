// Where targets were, and what a tracker told of them: what the judge compares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// Times are seconds since 1970, UTC: as doubles exact to a microsecond.

struct TruthPoint {
  double utc_s = 0.0;
  GeoPoint place;
  // Over ground.  Without both, motion is taken from the places.
  std::optional<double> course_deg = {}, speed_kn = {};
};

// A turn of the antenna over a target: was there a plot where it is?
struct TurnLook {
  double utc_s = 0.0;
  bool seen = false;
};

struct TruthTarget {
  std::string id;
  std::vector<TruthPoint> points;  // by time
  // By time; empty if nobody knows: then the target counts as seen from its first point on.
  std::vector<TurnLook> looks = {};
};

struct Truth {
  std::vector<TruthTarget> targets;
  std::vector<TruthPoint> own_ship = {};  // by time; empty if not known
};

enum class ToldStatus : std::uint8_t {
  tentative,  // not shown to a mariner: not judged
  tracked,
  lost,  // ends the track
};

struct ToldPoint {
  double utc_s = 0.0;
  ToldStatus status = ToldStatus::tracked;
  GeoPoint place;
  std::optional<double> course_deg = {}, speed_kn = {};  // over ground
  std::optional<double> cpa_nm = {}, tcpa_min = {};
};

struct ToldTrack {
  std::string number;             // as the tracker counts; one of its own for each track
  std::vector<ToldPoint> points;  // by time
};

// All that one tracker told.
struct Told {
  std::string name;
  std::vector<ToldTrack> tracks;
};

// What is read of any file, however long: more is left out, and said.
inline constexpr std::size_t kMostTargets = 1'000, kMostTracks = 20'000, kMostPoints = 4'000'000;

}  // namespace skerry::server
