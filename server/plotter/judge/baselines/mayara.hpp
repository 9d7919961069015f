// A tracker after the published rules of mayara-server of 2026, to compare with.
#pragma once

#include <vector>

#include "server/plotter/judge/scans_jsonl.hpp"

namespace skerry::server {

// Written from a description of its rules, not from its source.
//
// Its own: the middle of each echo; the nearest track within the greater of 50 m and 1.5 times the
// way at the greatest speed takes it, else it begins one; promoted at 4 echoes; lost after 3 turns
// without one, after 10 if it lies still (below 0.5 m/s after 5 updates); of two tracks within 100
// m and 30 deg of course the younger goes; an echo more than 90 deg off the course of a track above
// 5 m/s is not its own.  Three filters of constant velocity with noise 0.01, 0.05 and 0.15, mixed
// (IMM) with transitions .90 .05 .05, .10 .80 .10, .05 .15 .80 from .6 .2 .2.
//
// Assumed: the greatest speed is 20 m/s; noise is the variance of a white acceleration, (m/s2)2; a
// measured place has 25 m2 as in its version of 2025, a new track 25 m2 and 100 (m/s)2; a track
// takes one echo a turn, echoes go first come first served; courses are compared only of tracks
// that do not lie still, as others have none; an echo within 5 m does not show a course; at most
// 100 tracks; the bounds on an echo's size (25 pixels, 5 to 1000 m) say nothing of plots.
struct MayaraRule {
  double most_speed_mps = 20.0;
  std::size_t most_targets = 100;
};
Told baseline_mayara(const std::vector<DetectionScan>& scans, const MayaraRule& rule = {});

}  // namespace skerry::server
