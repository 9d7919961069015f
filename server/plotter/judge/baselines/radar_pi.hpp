// A tracker after the published rules of radar_pi, the radar plug-in of OpenCPN, to compare with.
#pragma once

#include <vector>

#include "server/plotter/judge/scans_jsonl.hpp"

namespace skerry::server {

// Written from a description of its rules, not from its source.
//
// Its own, of the ARPA of its main branch: a target takes the first echo within 2 pixels of where
// it is expected; those that found none look within 15, twice as far until they are acquired; an
// echo that was taken is gone for all others.  Extended Kalman filter of constant velocity that
// measures range (variance 25 pixels squared) and bearing (100 spokes squared), starts with
// variances 20 m2 and 4 m2/s2 and adds 0.015 a scan, however long the scan is.  Tracked after 6
// scans, lost after more than 3 without an echo or 8 s.  At most 100 targets.  A speed below
// twice its standard deviation is shown as 0.
//
// Assumed, as the rules are on pixels of video and the scans have plots: the plot stands for the
// middle of the contour's box; a pixel is 1/512 of the smallest usual range scale that holds all
// plots, a spoke 1/2048 of a turn; every plot that no target took begins a target (a guard zone
// over all); the nearest is the first that a search finds; the 0.015 is the variance of a white
// acceleration over a scan of one second, so that velocity gets 0.015 (m/s)2; the clamp on speed is
// 15 m/s in the first three updates; contours' sizes say nothing.
struct RadarPiRule {
  double pixel_m = 0.0;  // 0: as above
  std::size_t most_targets = 100;
};
Told baseline_radar_pi(const std::vector<DetectionScan>& scans, const RadarPiRule& rule = {});

}  // namespace skerry::server
