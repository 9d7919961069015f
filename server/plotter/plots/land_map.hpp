// LandMap: where over ground land is, and where echoes come and go, learnt turn by turn.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// A grid that lies still over ground while own ship moves over it: 256 x 256 cells of 50 m; of
// half of that, or a quarter, where 32 of those reach as far as the radar, and of twice that, and
// again, until 128 do.  What the ship leaves behind makes room for what comes.  Each cell remembers
// of the last sixteen turns in which there was an echo, and in which it was part of an extended
// one; and of the last eight in which there was a plot, and in which it was a new one: none there
// nor in the four cells beside it the turn before.
//
// Squares of four by four cells have a bar: how far over the threshold a plot must stand there to
// be told.  A new plot that passes it raises it by kRaise levels, and those of the eight squares
// around by a third of that; it falls by half a level a turn.  So wherever the sea comes and goes,
// whatever its spikes are like, a square tells a new plot in some ninety turns, and what is
// stronger or stays.
//
// An extended echo is land, but so are rain and sea that fill a place, as long as they do.
//
// Ground is dead reckoned from own ship's positions: exact to what the Earth's curvature and the
// convergence of meridians make of a few minutes' way (below 1 m in 5 km at 60 degrees).  Positions
// that are not finite move nothing; a step of more than kMostStepM, or another size of cells,
// begins anew.  Sums and products only: the same calls give the same bits on every machine.
//
// Memory: 800 KiB.  Thread: one at a time.
class LandMap {
 public:
  static constexpr double kCellM = 50.0, kLeastCellM = 12.5, kMostStepM = 2000.0;
  static constexpr int kRaise = 12, kMostBar = 120;  // levels

  LandMap();

  // The beam goes on by a row of this width (2^32 = one turn) to where own ship is there. `reach_m`
  // is positive: where the video ends.
  void go_on(const GeoPoint& own_ship, std::uint64_t width_units, double reach_m);

  // An echo of this turn from one range to another, as wide as a row: of a plot that is told, or of
  // an extended one.
  void add_echo(const GeoPoint& own_ship, TrueBearing bearing, double width_rad, double from_m,
                double to_m, bool extended);
  // A plot that is not extended, and whether it is told: it passes the bar or lasts.
  void add_plot(const GeoPoint& own_ship, TrueBearing bearing, double range_m, bool told);

  struct Marks {
    // 0 to 1, the greatest of:
    // - 1 where an extended echo was in twelve of the last sixteen turns, less in fewer; half of
    //   that within half a cell of such a cell.  Not more than 1.8 cells, 90 m, from the echo, so
    //   a ship that passes 100 m off is free;
    // - a quarter where lasting echoes (six turns of sixteen) lie in five of the eight directions,
    //   two or three cells off, or the next two beyond half the echo's size; half in six, and so
    //   on. A straight coast is in four, ships at anchor in less; a channel less than five cells
    //   wide is in all.
    double on_land = 0.0;
    // 0 to 1: 0 where a plot and a half a turn, or less, are new within 300 m (six cells, if that
    // is less); 1 where six are.  Two ships under way make less.
    double clutter = 0.0;
    double bar = 0.0;      // levels, 0 to kMostBar
    bool lasting = false;  // a plot was in this cell in six of the last eight turns
  };
  // From what is known before, of an echo that reaches `half_m` around this place.
  Marks at(const GeoPoint& own_ship, TrueBearing bearing, double range_m,
           double half_m = 0.0) const;

  double cell_m() const { return cell_m_; }

 private:
  static constexpr std::uint32_t kSide = 256;
  // Bit 0 of a history is this turn, the next one the turn before.
  struct Cell {
    std::uint32_t turn = 0;  // of bit 0
    std::uint16_t land = 0, echo = 0;
    std::uint8_t plots = 0, new_plots = 0, told = 0;
    std::uint8_t where = 0;  // which of the places that share this memory
  };
  struct Bar {
    std::uint32_t turn = 0;
    std::uint16_t half_levels = 0;  // as of that turn
    std::uint8_t where = 0;
  };
  struct Place {
    std::int32_t east = 0, north = 0;
  };

  PlanePoint ground(const GeoPoint& own_ship) const;
  Place place_of(PlanePoint ground) const;
  static std::size_t index_of(Place place);
  static std::uint8_t where_of(Place place);
  static std::size_t square_of(Place place);
  int bar_at(Place place) const;
  void raise(Place place, int half_levels);
  // As of this turn.
  Cell now(Place place) const;
  double land_at(PlanePoint point) const;
  double surrounded_at(Place place, double half_m) const;
  int new_plots_near(Place place) const;  // in the last eight turns
  void forget();

  std::vector<Cell> cells_;
  std::vector<Bar> bars_;
  double cell_m_ = kCellM;
  GeoPoint own_ship_;
  PlanePoint own_;  // metres from where the map began
  double cos_latitude_ = 1.0;
  bool placed_ = false;
  std::uint64_t swept_ = 0;       // 2^32 = one turn
  std::uint32_t turn_ = 0;        // from kSide on: cells never seen are of long ago
  std::uint32_t began_turn_ = 0;  // what is there then is not new
};

}  // namespace skerry::server
