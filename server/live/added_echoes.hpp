// AddedEchoes: a simulated radar's last turn, laid over the spokes of a real one.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "protocol/video/spoke.hpp"

namespace skerry::server {

// Of two echoes in one place the stronger shows.  Places are true bearing and range from the
// antenna, so both radars' own ships must be in one place.
// Bounds: an added echo is at most one turn of the simulated antenna old; it is spread over the
// cells and spokes that it touches, so it is wrong by less than one cell of either radar in range
// and by less than one spoke of either in bearing (AddedEchoesTest).
// Thread: any.
class AddedEchoes {
 public:
  // The simulation's video.  A spoke is added for kHeld; simulated turns take 0.8 to 5 s.
  static constexpr Duration kHeld = std::chrono::seconds(10);
  void take(const Sector& sector);

  // Adds to consecutive spokes of one turn, and marks them.  Without `heading_known` the
  // simulation's heading holds for them.
  void add_to(std::vector<Spoke>& spokes, bool heading_known) const;

 private:
  // What of one simulated spoke lies in `out`'s cells.
  static void lay(const Spoke& simulated, Spoke& out);

  mutable std::mutex mutex_;
  std::vector<SpokePtr> turn_;  // by true bearing, evenly; nullptr: none yet
  std::uint32_t newest_ = 0;    // where the newest lies in it
  TrueBearing heading_;         // of the newest
};

// Writes an S, for "simulated", astern, near the end of the range scale: 4 deg wide, its height 9 %
// of the range.  It reads upright head up.  What lay there is lost.
void mark_as_simulated(Spoke& spoke);

}  // namespace skerry::server
