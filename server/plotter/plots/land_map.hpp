// LandMap: where over ground land is, and where echoes come and go, learnt turn by turn.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// A grid that lies still over ground while own ship moves over it: 256 x 256 cells of 50 m; of
// half of that, or a quarter, where 32 of those reach as far as the radar, and of twice that, and
// again, until 128 do.  What the ship leaves behind makes room for what comes.  Each cell remembers
// of the last sixteen turns in which there was an echo of a plot that was told, and in which it was
// part of an extended one; and of the last eight in which there was a plot, told or not.  And of
// the last 32 spans of eight turns, ten minutes or so, those in which an echo stood there.
//
// Squares of four by four cells count their new plots of the last eight turns: those where there
// was none the turn before, in the same cell or the four beside it.  They also have a bar: how far
// over the threshold a plot must stand there to be told.  A told plot that is new among told ones,
// where the nine squares around had three new ones in eight turns, raises it by kRaise levels, and
// those of the eight squares around by a third of that; it falls by half a level a turn.  So
// wherever the sea comes and goes, whatever its spikes are like, a square tells a new plot in some
// ninety turns, and what is stronger or stays.
//
// An extended echo is land, but so are rain and sea that fill a place, as long as they do.
//
// Ground is dead reckoned from own ship's positions: exact to what the Earth's curvature and the
// convergence of meridians make of a few minutes' way (below 1 m in 5 km at 60 degrees).  Positions
// that are not finite move nothing; a step of more than kMostStepM, or another size of cells,
// begins anew.  Sums and products only: the same calls give the same bits on every machine.
//
// Memory: 1130 KiB.  Thread: one at a time.
class LandMap {
 public:
  static constexpr double kCellM = 50.0, kLeastCellM = 12.5, kMostStepM = 2000.0;
  static constexpr int kRaise = 12, kMostBar = 120;  // levels
  static constexpr std::uint32_t kSpan = 8;          // turns

  LandMap();

  // The beam goes on by a row of this width (2^32 = one turn) to where own ship is there. `reach_m`
  // is positive: where the video ends.
  void go_on(const GeoPoint& own_ship, std::uint64_t width_units, double reach_m);

  // A place over ground, metres from where the map began; good until go_on().
  struct Spot {
    PlanePoint at;
  };
  Spot spot(const GeoPoint& own_ship, TrueBearing bearing, double range_m) const;

  // What is known of a place from before.
  //
  // 0 to 1, the greatest of:
  // - 1 where an extended echo was in twelve of the last sixteen turns, less in fewer; half of that
  //   within half a cell of such a cell.  Not more than 1.8 cells from the echo, so a ship that
  //   passes 100 m off is free; 200 m on 6 NM, where a beam is as wide;
  // - a third where lasting echoes (six turns of sixteen) lie in six of the eight directions, two
  // or
  //   three cells off, or the next two beyond half the echo's size; two thirds in seven, 1 in all.
  //   A straight coast is in four, ships at anchor in less; a channel less than five cells wide is
  //   in all.
  double on_land(Spot spot, double half_m) const;
  // 0 to 1: 0 where a plot and a half a turn, or less, are new in the nine squares around; 1 where
  // six are.  Two ships under way make less.
  double clutter(Spot spot) const;
  double bar(Spot spot) const;  // levels, 0 to kMostBar
  bool lasts(Spot spot) const;  // a plot was in this cell in six of the last eight turns
  // In which spans of kSpan turns an echo stood there, in three of eight turns: bit 0 is this span,
  // the next one the span before.  Of the nine cells around, the one where it did most often.
  std::uint32_t stood(Spot spot) const;
  // An echo stands within two squares or so that has stood in its cell for four spans: land, or a
  // ship at anchor, or one that is slower than three cells a minute.
  bool is_by_standing(Spot spot) const;

  // A plot that is not extended, and whether it is told: it passes the bar or lasts.
  void add_plot(Spot spot, bool told);
  // An echo of this turn from one range to another, as wide as a row: of a plot that is told, or of
  // an extended one.
  void add_echo(const GeoPoint& own_ship, TrueBearing bearing, double width_rad, double from_m,
                double to_m, bool extended);

  double cell_m() const { return cell_m_; }

 private:
  static constexpr std::uint32_t kSide = 256;
  static constexpr std::int32_t kSquare = 4;  // cells of a square's side
  // Bit 0 of a history is this turn, the next one the turn before.
  struct Cell {
    std::uint32_t turn = 0;   // of bit 0
    std::uint32_t stood = 0;  // bits of spans
    std::uint16_t land = 0, echo = 0;
    std::uint8_t plots = 0, told = 0;
    std::uint8_t where = 0;  // which of the places that share this memory
  };
  struct Square {
    std::uint32_t turn = 0;                   // as of which
    std::uint32_t stood = 0;                  // spans in which a cell's echo has for four
    std::uint16_t half_levels = 0;            // its bar
    std::uint8_t where = 0;                   // as of a cell
    std::array<std::uint8_t, 8> new_plots{};  // this turn, the turn before, ...
  };
  struct Place {
    std::int32_t east = 0, north = 0;
  };

  PlanePoint ground(const GeoPoint& own_ship) const;
  Place place_of(PlanePoint ground) const;
  static std::size_t index_of(Place place);
  static std::size_t square_of(Place place);
  static std::uint8_t where_of(Place place);
  // As of this turn.
  Cell now(Place place) const;
  Cell& renewed(Place place);
  bool echo_lasts(Place place) const;
  Square square_now(Place place) const;
  int new_plots_near(Place place) const;  // in the last eight turns
  double land_at(PlanePoint point) const;
  double surrounded_at(Place place, double half_m) const;
  void raise(Place place);
  void forget();

  std::vector<Cell> cells_;
  std::vector<Square> squares_;
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
