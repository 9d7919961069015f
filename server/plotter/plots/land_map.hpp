// LandMap: where over ground land is, and where echoes come and go, learnt turn by turn.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// A grid that lies still over ground while own ship moves over it: 256 x 256 cells of 50 m, or
// twice that and again until 128 of them reach as far as the radar; what the ship leaves behind
// makes room for what comes.  Each cell keeps
// - how long extended echoes have lain there: half after five turns in a row, full after eleven,
// and
//   forgotten by a sixteenth a turn, half in eleven;
// - the rate of plots there, a mean over about eight turns, at most one a turn.
//
// An extended echo is land, but so are rain and sea that fill a place, as long as they do.
//
// Ground is dead reckoned from own ship's positions: exact to what the Earth's curvature and the
// convergence of meridians make of a few minutes' way (below 1 m in 5 km at 60 degrees).  Positions
// that are not finite move nothing; a step of more than kMostStep, or another size of cells, begins
// anew.  Sums and products only: the same calls give the same bits on every machine.
//
// Memory: 512 KiB.  Thread: one at a time.
class LandMap {
 public:
  static constexpr double kCellM = 50.0, kMostStepM = 2000.0;

  LandMap();

  // The beam goes on by a row of this width (2^32 = one turn) to where own ship is there. `reach_m`
  // is positive: where the video ends.
  void go_on(const GeoPoint& own_ship, std::uint64_t width_units, double reach_m);

  // An extended echo of this turn from one range to another, as wide as a row.
  void add_land(const GeoPoint& own_ship, TrueBearing bearing, double width_rad, double from_m,
                double to_m);
  // A plot that is none.
  void add_plot(const GeoPoint& own_ship, TrueBearing bearing, double range_m);

  struct Marks {
    // 0 to 1: 1 on what has been land for eleven turns, or among at least seven echoes within 300 m
    // that are always there (of three and less, anchored ships, 0).  In the cells beside land half
    // of that: a ship that passes 100 m off is not beside it.
    double on_land = 0.0;
    // 0 to 1: 0 where two plots a turn, or less, come and go within 300 m, as of ships; 1 where
    // eight do.
    double clutter = 0.0;
  };
  // From what is known before; the ranges and bearings are those of add_plot().
  Marks at(const GeoPoint& own_ship, TrueBearing bearing, double range_m) const;

  double cell_m() const { return cell_m_; }

 private:
  static constexpr std::int32_t kSide = 256;
  struct Cell {
    std::uint32_t turn = 0;  // of the values below
    std::uint8_t where = 0;  // which of the places that share this memory
    std::uint8_t seen = 0;   // bits: land and a plot, in that turn
    std::uint8_t land = 0, rate = 0;
  };
  struct Place {
    std::int32_t east = 0, north = 0;
  };

  PlanePoint ground(const GeoPoint& own_ship) const;
  Place place_of(PlanePoint ground) const;
  // As of this turn.
  Cell now(Place place) const;
  void see(Place place, std::uint8_t what);
  void forget();

  std::vector<Cell> cells_;
  double cell_m_ = kCellM;
  GeoPoint own_ship_;
  PlanePoint own_;  // metres from where the map began
  double cos_latitude_ = 1.0;
  bool begun_ = false;
  std::uint64_t swept_ = 0;  // 2^32 = one turn
  std::uint32_t turn_ = 0;
};

}  // namespace skerry::server
