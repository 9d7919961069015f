// Which radars and views a recording has, and their numbers when it is played.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

struct RecordedRadar {
  std::uint32_t recorded = 0;        // its number in the file; its place in the list is the played
  std::vector<std::uint32_t> views;  // with spokes, ascending; may lack 0
  wire::RadarInfo info;              // with the played number
  // The recorded view that view 0 shows: 0, or the first there is; none if the radar was in standby
  // throughout.
  std::uint32_t shared_view() const { return views.empty() ? 0 : views.front(); }
};

struct RecordedRadars {
  static constexpr std::size_t kMaxRadars = 64;
  // A console's view has a number of its own each time it is opened; each takes some 100 kB.
  static constexpr std::size_t kMaxViews = 256;      // of a radar
  static constexpr std::size_t kMaxAllViews = 2048;  // of all

  std::vector<RecordedRadar> radars;              // at least one, one of them with views
  std::map<std::uint32_t, std::uint32_t> played;  // by recorded number
  std::string scenario;
  std::string problem;  // what is left out
};

// Radars are numbered from 0 in their order: consoles and outputs begin with radar 0, which a
// recording of some radars may lack.  What Hello does not say is told by the first spokes.
// Error: no spokes of a radar and view that can be played.
Result<RecordedRadars, std::string> radars_of(const recording::RecordingReader& reader);

// The topics that a playback plays (KindRow::is_played): those of the radars and views above, and
// those that have no radar.
std::vector<recording::Topic> played_topics(const recording::Summary& summary,
                                            const RecordedRadars& radars);

}  // namespace skerry::server
