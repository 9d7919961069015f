#include "server/plotter/plots/land_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerDegree = 60.0 * 1852.0;  // of latitude
constexpr double kMostReachCells = 128.0, kLeastReachCells = 32.0;
constexpr double kMostOwn = 6.0;  // cells
constexpr int kBySquares = 2;
constexpr int kLongSpans = 4;
constexpr double kFarthest = 1e7;  // metres from where the map began
constexpr std::uint32_t kHistory = 16;
constexpr int kLasting = 6;  // turns of a history
constexpr int kFew = 3;      // new plots in eight turns: one boat that fades makes as many

bool finite(const GeoPoint& point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         std::fabs(point.latitude_deg) <= 90.0 && std::fabs(point.longitude_deg) <= 360.0;
}

double clamped(double share) { return std::clamp(share, 0.0, 1.0); }

// Of 16 bits.  std::popcount() calls a function where the processor need not have it.
int bits_of(std::uint32_t history) {
  history -= history >> 1 & 0x5555u;
  history = (history & 0x3333u) + (history >> 2 & 0x3333u);
  history = (history + (history >> 4)) & 0x0f0fu;
  return static_cast<int>((history + (history >> 8)) & 31u);
}

int spans_of(std::uint32_t stood) { return bits_of(stood & 0xffffu) + bits_of(stood >> 16); }

// Rounded down.  std::floor() calls a function where the processor need not have it.
std::int32_t floor_of(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return whole - (value < whole ? 1 : 0);
}

// Of the eight directions, the one in which that cell lies.
unsigned direction_of(int east, int north) {
  const unsigned quarter = north >= 0 ? (east > 0 ? 0u : 1u) : (east < 0 ? 2u : 3u);
  return 2 * quarter + (std::abs(east) > std::abs(north) ? 1u : 0u);
}

}  // namespace

LandMap::LandMap()
    : cells_(std::size_t{kSide} * kSide), squares_(cells_.size() / (kSquare * kSquare)) {}

void LandMap::forget() {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  std::fill(squares_.begin(), squares_.end(), Square{});
  own_ = {};
  began_turn_ = turn_;
}

void LandMap::go_on(const GeoPoint& own_ship, std::uint64_t width_units, double reach_m) {
  swept_ += width_units;
  turn_ = static_cast<std::uint32_t>(swept_ >> 32) + kSide;
  if (began_turn_ == 0) began_turn_ = turn_;
  double cell_m = kCellM;
  while (reach_m > cell_m * kMostReachCells) cell_m *= 2.0;
  while (reach_m < cell_m * kLeastReachCells && cell_m > kLeastCellM) cell_m *= 0.5;
  if (cell_m != cell_m_) {
    forget();
    cell_m_ = cell_m;
  }
  if (!finite(own_ship) || (placed_ && own_ship == own_ship_)) return;
  if (placed_) {
    const PlanePoint now = ground(own_ship);
    const PlanePoint step = now - own_;
    own_ = now;
    if (dot(step, step) > kMostStepM * kMostStepM || dot(now, now) > kFarthest * kFarthest)
      forget();
  }
  own_ship_ = own_ship;
  cos_latitude_ = echo::sin_cos_degrees(own_ship.latitude_deg).cos;
  placed_ = true;
}

PlanePoint LandMap::ground(const GeoPoint& own_ship) const {
  if (!placed_ || !finite(own_ship)) return own_;
  const double east = wrapped_longitude(own_ship.longitude_deg - own_ship_.longitude_deg);
  const double north = own_ship.latitude_deg - own_ship_.latitude_deg;
  return own_ + PlanePoint{east * cos_latitude_, north} * kMetresPerDegree;
}

LandMap::Place LandMap::place_of(PlanePoint ground) const {
  // Within kFarthest, half the Earth's girth and a reach of the origin: far inside of 32 bits.
  return {floor_of(ground.east_m / cell_m_), floor_of(ground.north_m / cell_m_)};
}

std::size_t LandMap::index_of(Place place) {
  return (static_cast<std::uint32_t>(place.north) % kSide) * kSide +
         static_cast<std::uint32_t>(place.east) % kSide;
}

std::uint8_t LandMap::where_of(Place place) {
  return static_cast<std::uint8_t>(static_cast<std::uint32_t>(place.east) / kSide % 16 * 16 +
                                   static_cast<std::uint32_t>(place.north) / kSide % 16);
}

std::size_t LandMap::square_of(Place place) {
  return (static_cast<std::uint32_t>(place.north) % kSide / kSquare) * (kSide / kSquare) +
         static_cast<std::uint32_t>(place.east) % kSide / kSquare;
}

LandMap::Cell LandMap::now(Place place) const {
  Cell cell = cells_[index_of(place)];
  const std::uint32_t turns = turn_ - cell.turn;
  const std::uint8_t where = where_of(place);
  if (cell.where != where) return {turn_, 0, 0, 0, 0, 0, where};
  const std::uint32_t spans = turn_ / kSpan - cell.turn / kSpan;
  cell.stood = spans < 32 ? cell.stood << spans : 0;
  if (turns >= kHistory) return {turn_, cell.stood, 0, 0, 0, 0, where};
  cell.land = static_cast<std::uint16_t>(cell.land << turns);
  cell.echo = static_cast<std::uint16_t>(cell.echo << turns);
  cell.plots = static_cast<std::uint8_t>(cell.plots << turns);
  cell.told = static_cast<std::uint8_t>(cell.told << turns);
  cell.turn = turn_;
  return cell;
}

LandMap::Cell& LandMap::renewed(Place place) {
  Cell& cell = cells_[index_of(place)];
  if (cell.turn != turn_ || cell.where != where_of(place)) cell = now(place);
  return cell;
}

bool LandMap::echo_lasts(Place place) const {
  const Cell& cell = cells_[index_of(place)];
  if (bits_of(cell.echo) < kLasting) return false;  // nearly all: on the sea
  return bits_of(now(place).echo) >= kLasting;
}

LandMap::Square LandMap::square_now(Place place) const {
  Square square = squares_[square_of(place)];
  const std::uint32_t turns = turn_ - square.turn;
  const std::uint8_t where = where_of(place);
  if (square.where != where || turns > 2u * kMostBar) return {turn_, 0, 0, where, {}};
  if (turns == 0) return square;
  const std::uint32_t spans = turn_ / kSpan - square.turn / kSpan;
  square.stood = spans < 32 ? square.stood << spans : 0;
  square.turn = turn_;
  square.half_levels = static_cast<std::uint16_t>(
      square.half_levels - std::min<std::uint32_t>(turns, square.half_levels));
  const std::array<std::uint8_t, 8> old = square.new_plots;
  square.new_plots = {};
  for (std::size_t i = turns; i < old.size(); ++i) square.new_plots[i] = old[i - turns];
  return square;
}

int LandMap::new_plots_near(Place place) const {
  unsigned count = 0;
  for (int north = -kSquare; north <= kSquare; north += kSquare) {
    for (int east = -kSquare; east <= kSquare; east += kSquare) {
      const Place at{place.east + east, place.north + north};
      const Square& square = squares_[square_of(at)];
      const std::uint32_t turns = turn_ - square.turn;
      if (square.where != where_of(at)) continue;
      for (std::size_t i = turns; i < square.new_plots.size(); ++i)
        count += square.new_plots[i - turns];
    }
  }
  return static_cast<int>(count);
}

void LandMap::raise(Place place) {
  for (int north = -kSquare; north <= kSquare; north += kSquare) {
    for (int east = -kSquare; east <= kSquare; east += kSquare) {
      const Place at{place.east + east, place.north + north};
      Square square = square_now(at);
      const int by = 2 * (north == 0 && east == 0 ? kRaise : kRaise / 3);
      square.half_levels =
          static_cast<std::uint16_t>(std::min(square.half_levels + by, 2 * kMostBar));
      squares_[square_of(at)] = square;
    }
  }
}

void LandMap::add_echo(const GeoPoint& own_ship, TrueBearing bearing, double width_rad,
                       double from_m, double to_m, bool extended) {
  const PlanePoint ship = ground(own_ship);
  const auto toward = echo::sin_cos_units(bearing.units());
  const PlanePoint ahead{toward.sin, toward.cos}, right{toward.cos, -toward.sin};
  // Places so near each other, both ways, that none of the cells between them is missed.
  const double step = 0.7 * cell_m_;
  for (double range = from_m;; range = std::min(range + step, to_m)) {
    const double width = width_rad * range;
    const int across = 1 + static_cast<int>(width / step);
    for (int i = 0; i < across; ++i) {
      const double off = ((i + 0.5) / across - 0.5) * width;
      const Place place = place_of(ship + ahead * range + right * off);
      Cell& cell = renewed(place);
      cell.echo |= 1;
      if ((cell.stood & 1u) == 0 && bits_of(cell.echo & 0xffu) >= 3) {
        cell.stood |= 1;
        if (spans_of(cell.stood) >= kLongSpans) {
          Square square = square_now(place);
          square.stood |= 1;
          squares_[square_of(place)] = square;
        }
      }
      if (extended) cell.land |= 1;
    }
    if (range >= to_m) return;
  }
}

void LandMap::add_plot(Spot spot, bool told) {
  const Place place = place_of(spot.at);
  Cell& cell = renewed(place);
  unsigned plots = cell.plots, told_before = cell.told;
  for (const auto& [east, north] : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}}) {
    const Place at{place.east + east, place.north + north};
    const Cell& beside = cells_[index_of(at)];
    const std::uint32_t turns = turn_ - beside.turn;
    if (turns > 1 || beside.where != where_of(at)) continue;
    plots |= static_cast<unsigned>(beside.plots) << turns;
    told_before |= static_cast<unsigned>(beside.told) << turns;
  }
  cell.plots |= 1;
  if (told) cell.told |= 1;
  if (turn_ - began_turn_ < 2) return;
  if ((plots & 2u) == 0) {
    Square square = square_now(place);
    if (square.new_plots[0] < 255) ++square.new_plots[0];
    squares_[square_of(place)] = square;
  }
  if (told && (told_before & 2u) == 0 && new_plots_near(place) >= kFew) raise(place);
}

double LandMap::land_at(PlanePoint point) const {
  const auto share = [&](double east, double north) {
    const Cell cell = now(place_of(point + PlanePoint{east, north} * cell_m_));
    return clamped(bits_of(cell.land) / 12.0);
  };
  // Half a cell away lies the next cell, or this one.
  return std::max({share(0.0, 0.0), 0.5 * share(0.5, 0.0), 0.5 * share(-0.5, 0.0),
                   0.5 * share(0.0, 0.5), 0.5 * share(0.0, -0.5)});
}

double LandMap::surrounded_at(Place place, double half_m) const {
  const int own = 1 + static_cast<int>(std::min(half_m / cell_m_, kMostOwn));
  unsigned directions = 0;
  for (int north = -own - 2; north <= own + 2; ++north) {
    for (int east = -own - 2; east <= own + 2; ++east) {
      if (std::abs(north) <= own && std::abs(east) <= own) continue;
      if (echo_lasts({place.east + east, place.north + north}))
        directions |= 1u << direction_of(east, north);
    }
  }
  return clamped((bits_of(directions) - 5) / 3.0);
}

LandMap::Spot LandMap::spot(const GeoPoint& own_ship, TrueBearing bearing, double range_m) const {
  const auto toward = echo::sin_cos_units(bearing.units());
  return {ground(own_ship) + PlanePoint{toward.sin, toward.cos} * range_m};
}

std::uint32_t LandMap::stood(Spot spot) const {
  const Place middle = place_of(spot.at);
  std::uint32_t most = 0;
  for (int north = -1; north <= 1; ++north) {
    for (int east = -1; east <= 1; ++east) {
      const std::uint32_t here = now({middle.east + east, middle.north + north}).stood;
      if (spans_of(here >> 2) > spans_of(most >> 2)) most = here;  // not just now
    }
  }
  return most;
}

bool LandMap::is_by_standing(Spot spot) const {
  constexpr std::uint32_t kLately = 7;
  const Place middle = place_of(spot.at);
  for (int north = -kBySquares; north <= kBySquares; ++north) {
    for (int east = -kBySquares; east <= kBySquares; ++east) {
      const Place at{middle.east + east * kSquare, middle.north + north * kSquare};
      if ((square_now(at).stood & kLately) != 0) return true;
    }
  }
  return false;
}

double LandMap::on_land(Spot spot, double half_m) const {
  return std::max(land_at(spot.at), surrounded_at(place_of(spot.at), half_m));
}

double LandMap::clutter(Spot spot) const {
  return clamped((new_plots_near(place_of(spot.at)) / 8.0 - 1.5) / 4.5);
}

double LandMap::bar(Spot spot) const { return 0.5 * square_now(place_of(spot.at)).half_levels; }

bool LandMap::lasts(Spot spot) const {
  return bits_of(now(place_of(spot.at)).plots >> 1) >= kLasting;
}

}  // namespace skerry::server
