// Truth as a table: one row for each place of a target at a time.
#pragma once

#include <string_view>

#include "server/plotter/judge/read_notes.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

struct ReadTruth {
  Truth truth;
  ReadNotes notes;
};

// Columns utc_s,id,lat_deg,lon_deg and, if they are there, course_deg,speed_kn (over ground) and
// seen (0 or 1: was there an echo in this turn).  Others are passed over.  The id `own` is own
// ship.  Rows may stand in any order; wrong ones are left out and noted.
// Errors: std::runtime_error with file and line if a column is missing, or no row can be used.
ReadTruth read_truth_csv(std::string_view text, std::string_view file);

}  // namespace skerry::server
