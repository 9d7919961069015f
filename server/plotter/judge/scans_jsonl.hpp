// Scans of a radar's detections with the truth beside them, one JSON object on each line.
#pragma once

#include <string_view>
#include <vector>

#include "server/plotter/judge/read_notes.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

// All detections of one turn, which count as of one time.
struct DetectionScan {
  double utc_s = 0.0;
  GeoPoint own_ship;
  std::vector<PlanePoint> plots;  // m east and north of own ship
};

struct ReadScans {
  std::vector<DetectionScan> scans;  // by time
  Truth truth;                       // with looks: a plot within kSeen_m of the target
  ReadNotes notes;
};

struct ScansRule {
  // Of the plane of `north_east`: that of Autoferry/sensor_fusion_dataset (CC0), Trondheim.
  GeoPoint origin{63.4389029083, 10.39908278};
};
inline constexpr double kSeen_m = 15.0;
inline constexpr std::size_t kMostScans = 100'000, kMostScanPlots = 5'000;

// Of each line: `time` (s since 1970), `own_north_east` (m on the plane), `plots` (m north and east
// of own ship) and `targets` with `id`, `time` and `north_east`; others are passed over.  Wrong
// lines are left out and noted.
// Errors: std::runtime_error with the file if no line is a scan.
ReadScans read_scans_jsonl(std::string_view text, std::string_view file,
                           const ScansRule& rule = {});

}  // namespace skerry::server
