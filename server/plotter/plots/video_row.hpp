// VideoRow: some consecutive spokes of a radar as one, about as wide as a quarter of its beam.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "protocol/video/spoke.hpp"

namespace skerry::server {

// What an echo is looked for in.  Averaging spokes that one beam covers takes nothing from an echo
// and leaves a quarter of the cells.
struct VideoRow {
  // The middle of its spokes: where the antenna pointed then, and the ship was.
  TrueBearing bearing;
  GeoPoint own_ship;
  ScenarioTime time{};
  UtcTime utc{};
  std::uint64_t number = 0;  // of its place: turns since the radar started, times rows a turn
  double width_rad = 0.0;    // of a row, from its middle to the next one's
  double cell_m = 0.0;       // length of its cells
  // The row before this one is the one before it in the turn, and was cut in the same way.
  bool follows = false;
  std::span<const std::uint8_t> levels;  // mean video, 0 to 255 also of 4-bit video
};

// Spokes in, rows out.  Spokes that are lost leave a row with fewer of them, or none; spokes that
// come twice, or late by less than a turn, are left out.  Another range, another geometry, a jump
// back by a turn or more: what follows is a new beginning.
//
// Thread: one at a time.
class RowMaker {
 public:
  // Widths that a row has at most, but for radars whose spokes or cells are larger themselves.
  struct Grain {
    double width_deg = 0.36;
    double cell_m = 7.5;
  };
  RowMaker() : RowMaker(Grain{}) {}
  explicit RowMaker(const Grain& grain) : grain_(grain) {}

  // True if row() is a new one, which ends with the spoke before this one.  Spokes whose geometry
  // is not valid(), or that have another number of cells than it says, are left out and counted.
  bool add(const Spoke& spoke);
  // True if row() is a new one: what there is of the row that has begun.
  bool flush();
  // Stays until the next call.
  const VideoRow& row() const { return row_; }

  std::uint64_t left_out() const { return left_out_; }

 private:
  bool belongs(const SpokeHeader& header) const;
  void begin(const SpokeHeader& header);
  void sum(const Spoke& spoke);
  bool close();

  Grain grain_;
  // Of the present cut.
  ScanGeometry geometry_;
  double reach_m_ = 0.0;
  std::uint32_t spokes_a_row_ = 1, cells_a_cell_ = 1, rows_a_turn_ = 0;
  std::uint64_t next_ = 0;  // place of the spoke after the last one
  bool begun_ = false;
  // Of the row that has begun.
  std::uint64_t number_ = 0;
  std::uint32_t spokes_ = 0;  // so many have been added to sums_
  std::vector<std::uint16_t> sums_;
  SpokeHeader middle_;
  // Of the last one that was closed.
  bool any_before_ = false;
  std::uint64_t before_ = 0;
  std::vector<std::uint8_t> levels_;
  VideoRow row_;
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server
