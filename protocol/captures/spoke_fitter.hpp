// SpokeFitter: captured spokes of one picture into spokes of the native protocol.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "protocol/captures/captured_spoke.hpp"
#include "protocol/captures/ship_track.hpp"
#include "protocol/captures/turn_counter.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::captures {

// The smallest range scale that holds `nominal` and at least half of `reach`; `nominal` 0: not
// known.  Nothing where the native protocol cannot say such a reach: below 14.5 m (a sixteenth of
// the smallest scale) or above 192 NM.
std::optional<RangeScale> scale_of(Length nominal, Length reach);

struct FittedCounts {
  std::uint64_t spokes = 0;         // given
  std::uint64_t missing = 0;        // from the capture itself
  std::uint64_t range_unknown = 0;  // given with the range of the spokes next to them
  std::uint64_t refused = 0;        // of a reach that cannot be said
  std::uint64_t padded = 0;         // of fewer than 128 cells: zeros follow
  std::uint64_t thinned = 0;        // of more than 4096 cells: peaks are kept
  bool magnetic = false;            // headings are
  std::map<std::int64_t, std::uint64_t> at_reach_dm;  // spokes, by their reach in 0.1 m
};

// Cells stand as they were decoded; where there are fewer than the protocol has, zeros of the same
// size follow.  A spoke whose packets tell no range waits for the next one that has it, and then
// has the same; later ones have the last.  Bearings from north become bearings from the bow where
// the heading is known: error of the heading half a spoke, of the bearing none.
// Memory: at most kMaxWaiting spokes wait, of at most 4096 cells each.  Thread: one at a time.
class SpokeFitter {
 public:
  static constexpr std::size_t kMaxWaiting = 4096;
  // The range of spokes that never learn theirs.
  static constexpr double kAssumedRangeNm = 1.0;

  SpokeFitter(std::uint32_t radar, Duration turn, UtcTime begin)
      : radar_(radar), turn_(turn), begin_(begin) {}

  // Appends the spokes that can be given now.
  void take(CapturedSpoke spoke, const ShipTrack& ship, std::vector<Spoke>& out);
  // Those that still wait.
  void finish(std::vector<Spoke>& out);

  const FittedCounts& counts() const { return counts_; }

 private:
  struct Waiting {
    CapturedSpoke spoke;
    std::optional<GeoPoint> position;
  };
  void give_waiting(std::vector<Spoke>& out);
  void fit(CapturedSpoke& from, const std::optional<GeoPoint>& position, std::vector<Spoke>& out);
  void thin(CapturedSpoke& from);
  void pad(CapturedSpoke& from);

  std::uint32_t radar_;
  Duration turn_;
  UtcTime begin_;
  TurnCounter turns_;
  std::deque<Waiting> waiting_;
  Length reach_{}, nominal_{};  // known last
  std::uint64_t sequence_ = 0;
  FittedCounts counts_;
};

}  // namespace skerry::captures
