// StaticReturns: land and what is built on it, made seldom and moved between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/moved_row.hpp"
#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/returns/hidden_water.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Mean power of coast, land and structures behind beam and pulse, kept in frames: rows on all
// bearings of the plane as seen from one place (static_frame.hpp).  As the own ship sails on, each
// spoke is put together from the rows that saw its places at the bearings they then had, shifted in
// range (moved_rows.hpp).  Meanwhile the next frame is made, a little in every sector, from where
// she will be when it has been in use for half its time; so the way moved stays within half of what
// she sails during one frame, kFrameCells at most.
//
// Turning costs nothing and changes nothing; a ship that lies still in unchanging water makes one
// frame and no more.  Every range scale and pulse has frames of its own: on another one, and after
// a jump of the own ship, each sector makes the rows it needs.
//
// Waves on sandy shores, the water's level and a new picture of the coast show with the next frame;
// the last two at the latest within kRenewTurns and kPictureTurns, waves as kWaveSeconds has it.
//
// Spokes within kPartsServe of each other share which cells of which rows they are made of.
//
// A pure function of the sequence of (scene, sector), for any number of workers.
// Error, against rows made where the own ship is: bearing 1.7 rows (kMostOff; an eighth of a beam
// of 1.2 deg), and half a row more where two spokes share one; range a twentieth of a cell in the
// mean of an echo, whose two edges show in up to a cell more; p50 0.6 dB, and p90 3 dB beyond what
// the cell and its two neighbours hold.  What stands before what changes with the way moved: p99 is
// that of edges come and gone, tens of dB.  Near the limit of the picture's coast a few cells at
// the range's end may be empty.  Held by MovedRows.FindEachPlaceWhereItWasSeen,
// StaticReturns.MovedRowsAreNearFreshOnes.
class StaticReturns {
 public:
  StaticReturns(const RadarModel& model, ParallelFor parallel);
  ~StaticReturns();
  StaticReturns(StaticReturns&&) noexcept;
  StaticReturns& operator=(StaticReturns&&) noexcept;

  // Makes what spokes first .. first + count - 1 need.  Thread: the radar's.
  void prepare(const Scene& scene, std::uint64_t first, std::uint32_t count);

  // Whether nothing of all this is in the last prepared scene; then the rest does nothing.
  bool empty() const;

  // Adds the echoes of that spoke to power[i], signal-to-noise ratios, and sets `dry` to the runs
  // of cells that show no sea: land, and water hidden behind it; nearest first, apart; none over
  // open water.  dry is that of the middle of the beam.  Returns false, nothing added, where
  // nothing echoes.  Requires power.size() to be the radar's cells.  Thread: any, after prepare().
  bool add(const SpokeAim& aim, std::span<float> power, std::vector<CellRun>& dry) const;
  // How many spokes that follow one another may share what find() finds for the bearing in their
  // middle: 2 where a row is at least as wide as a spoke.  Error: half a spoke in bearing, half a
  // row at most.  Held by StaticReturns.TwoSpokesShareARowNoNarrowerThanOne.
  std::uint32_t spokes_to_a_row() const;
  // The same in two steps: sets `runs` to the echoes, for lay_moved(), and `dry`; both are empty
  // where empty().  The runs are valid until the next prepare().
  void find(const SpokeAim& aim, std::vector<MovedRun>& runs, std::vector<CellRun>& dry) const;

  // Height over the water below which land hides what is at that place, metres; 0 over open water
  // and within sight.  From where the antenna was in the middle of the last sector.  The Earth's
  // own curve apart.  Error: the shadow begins up to 8 cells late.  Thread: any, after prepare().
  float hidden_height(std::uint32_t plane_units, double range_m) const;

  // Counts of the work done, for tests and benches.
  struct Effort {
    std::uint64_t rows = 0;    // made since the beginning
    std::uint64_t frames = 0;  // taken into use
    double moved_m = 0.0;      // the way the rows are moved now
  };
  Effort effort() const;
  std::size_t bytes() const;  // kept

  // A frame is in use for at most as many cells' way of the own ship, at least kLeastFrameCells,
  // and between them for kFrameShare of the distance to the nearest land, whose sight changes most;
  // and for a turn at least.
  static constexpr double kFrameCells = 12.0;
  static constexpr double kLeastFrameCells = 4.0;
  static constexpr double kFrameShare = 0.2;
  // The swash moves the edge of sand to and fro by some cells: from kFullSwash on it is renewed
  // every kWaveSeconds, below more seldom by as much, and below kLeastSwash, or where no sand is in
  // range, not for its own sake.
  static constexpr double kWaveSeconds = 12.0;
  static constexpr double kFullSwash = 2.0, kLeastSwash = 0.5;
  static constexpr double kRenewTurns = 4.0;
  static constexpr double kPictureTurns = 24.0;

 private:
  class Frames;
  std::unique_ptr<Frames> frames_;
};

}  // namespace skerry::echo
