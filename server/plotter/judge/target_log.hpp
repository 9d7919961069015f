// Targets of any maker's tracker, out of a log of NMEA 0183 sentences.
#pragma once

#include <string_view>

#include "server/plotter/judge/read_notes.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

struct ReadTargets {
  Told told;
  std::vector<TruthPoint> own_ship;  // as the log has it
  ReadNotes notes;
};

// TTM, TLL and TTD, with whatever stands round the sentences (protocol/nmea/log_line.hpp).
//
// Time: that of the sentence, on the day of the sentences before it; else that of the line; else
// the last that a sentence or line had.  The day comes from RMC, ZDA or the line, before the first
// of them from the truth.
// Own ship's place, for range and bearing: RMC, GGA, GLL and GNS of the log, straight between two;
// where it has none, the truth's own ship.
// Status: Q is tentative, T tracked, L lost.  A number that comes back after L, or a minute after
// it was told last, is another track.  An empty CPA, TCPA, course or speed is not known.
//
// `truth`: of the same scene.  Errors: std::runtime_error with the file if it has no sentence of
// targets that can be used.
ReadTargets read_target_log(std::string_view text, std::string_view file, const Truth& truth);

}  // namespace skerry::server
