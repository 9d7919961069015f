// Tracks as `skerry track -o tracks.csv` writes them, and others may.
#pragma once

#include <string_view>
#include <vector>

#include "server/plotter/judge/read_notes.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

struct ReadTracks {
  std::vector<Told> told;  // one for each radar, if the table has a column of that name
  ReadNotes notes;
};

// Columns utc_s,track,status,lat_deg,lon_deg and, if they are there, radar, course_deg,speed_kn
// (over ground), cpa_nm and tcpa_min.  Others are passed over.  status: tentative, tracked or lost.
// Rows may stand in any order; wrong ones are left out and noted.  A table without rows is a
// tracker that told nothing.
// Errors: std::runtime_error with file and line if a column is missing.
ReadTracks read_tracks_csv(std::string_view text, std::string_view file);

}  // namespace skerry::server
