// One turn of a board's sweeps as a scan, so that it is drawn as any other radar video.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/board/spoke_former.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/video/scan.hpp"

namespace skerry::client {

// A turn has whole spokes of at least one pulse each where it can: the largest power of two of
// spokes that is not more than the pulses of a turn, nor than `most`; 256 .. 8192.
std::uint32_t spokes_that_fit(const board::SweepMeta& meta, std::uint32_t most);

// The cells of a spoke: the strongest code that reaches into each, `largest_code` as 255, inverted
// video the right way round; 0 beyond the sweep.
std::vector<std::uint8_t> cells_of(const board::Sweep& sweep, std::size_t channel,
                                   const ScanGeometry& geometry, RangeScale range);

// Forms spokes (board::SpokeFormer) and collects them from bow to bow.
// Thread: one at a time.
class TurnAssembler {
 public:
  // geometry.valid(), with 8 bits.  channel: 0 or 1.
  TurnAssembler(const ScanGeometry& geometry, RangeScale range, std::size_t channel)
      : geometry_(geometry), range_(range), channel_(channel), former_(geometry.spokes_per_turn) {}

  // The first whole turn, once it has come; of sweeps that have the channel.  heading and own_ship
  // are those at the sweep's time.
  std::optional<Scan> feed(const board::Sweep& sweep, TrueBearing heading, GeoPoint own_ship);

  // Spokes of the turn begun, out of geometry.spokes_per_turn; 0 before its beginning has come.
  std::uint32_t received() const { return scan_.received; }
  // FaultBits of all its sweeps, and of the sweep that ended it: that one has the faults found at
  // the ARP.
  std::uint32_t faults() const { return faults_; }

 private:
  void take(const board::Sweep& formed, TrueBearing heading, GeoPoint own_ship);

  ScanGeometry geometry_;
  RangeScale range_;
  std::size_t channel_;
  board::SpokeFormer former_;
  std::optional<std::uint32_t> last_index_;
  bool begun_ = false, whole_ = false;
  std::uint32_t faults_ = 0;
  Scan scan_;
};

}  // namespace skerry::client
