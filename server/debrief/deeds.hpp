// Who did what in a recorded exercise, by the entries of the audit that the recording holds.
#pragma once

#include <functional>
#include <string>

#include "protocol/recording/reader.hpp"
#include "server/debrief/debrief.hpp"

namespace skerry::server {

// Fills in `deeds`, those up to end_s.  `epoch`: the scenario's time 0; exercise_at: the exercise's
// clock at a time on the air.
constexpr std::size_t kMostDeeds = 100'000;
void read_deeds(const recording::RecordingReader& reader, UtcTime epoch, double end_s,
                const std::function<double(double)>& exercise_at, Debrief& debrief);

// The part of the page, HTML; everything from outside is escaped.  It has names, not addresses.
std::string deeds_section(const Debrief& debrief);
std::string deeds_csv(const Debrief& debrief);

}  // namespace skerry::server
