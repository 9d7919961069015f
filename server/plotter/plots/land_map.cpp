#include "server/plotter/plots/land_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerDegree = 60.0 * 1852.0;  // of latitude
constexpr double kMostReachCells = 128.0, kLeastReachCells = 32.0;
constexpr double kNearM = 300.0;
constexpr int kMostNear = 6;
constexpr double kMostOwn = 6.0;   // cells
constexpr double kFarthest = 1e7;  // metres from where the map began
constexpr std::uint32_t kHistory = 16;
constexpr int kFew = 3;              // new plots in eight turns: one boat that fades makes them
constexpr std::int32_t kSquare = 4;  // cells of a square's side

bool finite(const GeoPoint& point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         std::fabs(point.latitude_deg) <= 90.0 && std::fabs(point.longitude_deg) <= 360.0;
}

double clamped(double share) { return std::clamp(share, 0.0, 1.0); }

// Of the eight directions, the one in which that cell lies.
unsigned direction_of(int east, int north) {
  const unsigned quarter = north >= 0 ? (east > 0 ? 0u : 1u) : (east < 0 ? 2u : 3u);
  return 2 * quarter + (std::abs(east) > std::abs(north) ? 1u : 0u);
}

}  // namespace

LandMap::LandMap()
    : cells_(std::size_t{kSide} * kSide), bars_(cells_.size() / (kSquare * kSquare)) {}

void LandMap::forget() {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  std::fill(bars_.begin(), bars_.end(), Bar{});
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
  return {static_cast<std::int32_t>(std::floor(ground.east_m / cell_m_)),
          static_cast<std::int32_t>(std::floor(ground.north_m / cell_m_))};
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

int LandMap::bar_at(Place place) const {
  const Bar& bar = bars_[square_of(place)];
  const std::uint32_t turns = turn_ - bar.turn;
  if (bar.where != where_of(place) || turns >= bar.half_levels) return 0;
  return static_cast<int>(bar.half_levels - turns);
}

void LandMap::raise(Place place, int half_levels) {
  const int raised = std::min(bar_at(place) + half_levels, 2 * kMostBar);
  bars_[square_of(place)] = {turn_, static_cast<std::uint16_t>(raised), where_of(place)};
}

LandMap::Cell LandMap::now(Place place) const {
  Cell cell = cells_[index_of(place)];
  const std::uint32_t turns = turn_ - cell.turn;
  const std::uint8_t where = where_of(place);
  if (cell.where != where || turns >= kHistory) return {turn_, 0, 0, 0, 0, 0, where};
  cell.land = static_cast<std::uint16_t>(cell.land << turns);
  cell.echo = static_cast<std::uint16_t>(cell.echo << turns);
  cell.plots = static_cast<std::uint8_t>(cell.plots << turns);
  cell.new_plots = static_cast<std::uint8_t>(cell.new_plots << turns);
  cell.told = static_cast<std::uint8_t>(cell.told << turns);
  cell.turn = turn_;
  return cell;
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
      Cell cell = now(place);
      cell.echo |= 1;
      if (extended) cell.land |= 1;
      cells_[index_of(place)] = cell;
    }
    if (range >= to_m) return;
  }
}

void LandMap::add_plot(const GeoPoint& own_ship, TrueBearing bearing, double range_m, bool told) {
  const auto toward = echo::sin_cos_units(bearing.units());
  const Place place = place_of(ground(own_ship) + PlanePoint{toward.sin, toward.cos} * range_m);
  Cell cell = now(place);
  unsigned plots = cell.plots, told_before = cell.told;
  for (const auto& [east, north] : {Place{1, 0}, Place{-1, 0}, Place{0, 1}, Place{0, -1}}) {
    const Cell beside = now({place.east + east, place.north + north});
    plots |= beside.plots;
    told_before |= beside.told;
  }
  const bool learning = turn_ - began_turn_ < 2;
  if (!learning && (plots & 2u) == 0) cell.new_plots |= 1;
  if (!learning && told && (told_before & 2u) == 0 && new_plots_near(place) >= kFew) {
    for (int north = -kSquare; north <= kSquare; north += kSquare)
      for (int east = -kSquare; east <= kSquare; east += kSquare)
        raise({place.east + east, place.north + north},
              2 * (north == 0 && east == 0 ? kRaise : kRaise / 3));
  }
  cell.plots |= 1;
  if (told) cell.told |= 1;
  cells_[index_of(place)] = cell;
}

double LandMap::land_at(PlanePoint point) const {
  const auto share = [&](double east, double north) {
    const Cell cell = now(place_of(point + PlanePoint{east, north} * cell_m_));
    return clamped(std::popcount(cell.land) / 12.0);
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
      const Cell cell = now({place.east + east, place.north + north});
      if (std::popcount(cell.echo) >= 6) directions |= 1u << direction_of(east, north);
    }
  }
  return clamped((std::popcount(directions) - 4) / 4.0);
}

int LandMap::new_plots_near(Place place) const {
  const int near = std::clamp(static_cast<int>(kNearM / cell_m_), 1, kMostNear);
  int count = 0;
  for (int north = -near; north <= near; ++north)
    for (int east = -near; east <= near; ++east)
      count += std::popcount(now({place.east + east, place.north + north}).new_plots);
  return count;
}

LandMap::Marks LandMap::at(const GeoPoint& own_ship, TrueBearing bearing, double range_m,
                           double half_m) const {
  const auto toward = echo::sin_cos_units(bearing.units());
  const PlanePoint point = ground(own_ship) + PlanePoint{toward.sin, toward.cos} * range_m;
  const Place place = place_of(point);
  Marks marks;
  marks.on_land = std::max(land_at(point), surrounded_at(place, half_m));
  marks.clutter = clamped((new_plots_near(place) / 8.0 - 1.5) / 4.5);
  marks.bar = 0.5 * bar_at(place);
  marks.lasting = std::popcount(static_cast<unsigned>(now(place).plots >> 1)) >= 6;
  return marks;
}

}  // namespace skerry::server
