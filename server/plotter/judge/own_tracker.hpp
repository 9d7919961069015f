// Skerry's own tracker on the plots of scans, beside the baselines.
#pragma once

#include <vector>

#include "server/plotter/judge/scans_jsonl.hpp"
#include "server/plotter/tracks/tracker.hpp"

namespace skerry::server {

// Plots of small boats near by, as the scans of Autoferry/sensor_fusion_dataset have them.
inline constexpr Tracker::Rule kTrackerOfScans{
    .least_speed_kn = 1.0, .fastest_kn = 30.0, .bearing_sigma_deg = 1.0, .range_sigma_m = 4.0};
// All plots of a scan count as of its time; the antenna passes them after it.  What is told after
// each scan is of that scan's time; a target up to 60 deg before north is paired with its plot only
// after the next scan has begun.
Told skerry_tracks(const std::vector<DetectionScan>& scans,
                   const Tracker::Rule& rule = kTrackerOfScans);

}  // namespace skerry::server
