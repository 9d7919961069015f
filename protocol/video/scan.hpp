// Scan: one turn of the antenna as a receiver has it, and the ScanAssembler that makes it of
// spokes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/video/spoke.hpp"

namespace skerry {

// The spokes of one turn, some of which may be missing.  Spokes may differ in range scale (somebody
// changed it during the turn) and in heading (the ship turned).
struct Scan {
  std::uint32_t radar = 0;
  std::uint32_t view = 0;
  std::uint32_t number = 0;  // SpokeHeader::scan
  ScanGeometry geometry;
  std::vector<std::optional<Spoke>> spokes;  // by spoke index; geometry.spokes_per_turn of them
  std::uint32_t received = 0;                // how many of them are there

  std::uint32_t missing() const { return geometry.spokes_per_turn - received; }
  bool is_complete() const { return received > 0 && missing() == 0; }
  bool has_one_range_scale() const;

  // The spoke with the highest index, the last one made; nullptr if there is none.
  const Spoke* newest() const;
};

// Sorts the spokes of one view into scans.  A scan is handed out when its last missing spoke comes,
// or, with spokes missing, when a spoke of another scan comes; the scan during which the reception
// began is handed out like any other.  Spokes of a scan already handed out are counted and dropped.
// Memory: one scan.  Thread: one at a time.
class ScanAssembler {
 public:
  // The scan that `spoke` finished, if it did.  Requires a spoke as from_message() gives it, always
  // of the same radar and view.
  std::optional<Scan> feed(Spoke spoke);

  const Scan& unfinished() const { return scan_; }  // received == 0: no scan begun
  std::uint64_t dropped() const { return dropped_; }

 private:
  bool belongs(const SpokeHeader& header) const;
  void begin(const SpokeHeader& header);
  Scan hand_out();

  Scan scan_;
  std::optional<std::uint32_t> last_number_;  // of the scan handed out last
  std::uint64_t dropped_ = 0;
};

}  // namespace skerry
