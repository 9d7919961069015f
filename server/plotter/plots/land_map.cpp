#include "server/plotter/plots/land_map.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerDegree = 60.0 * 1852.0;  // of latitude
constexpr double kMostReachCells = 128.0, kNearM = 300.0;
constexpr double kFarthest = 1e7;  // metres from where the map began
constexpr std::uint8_t kLand = 1, kPlot = 2;
constexpr std::uint8_t kStep = 32;         // of 255, for a turn in which something is seen
constexpr std::uint32_t kOften = 153;      // of 255: seen in more turns than dense clutter is
constexpr std::uint32_t kForgotten = 100;  // turns after which nothing is left

std::uint8_t grown(std::uint8_t value) {
  return static_cast<std::uint8_t>(std::min(value + kStep, 255));
}

// A share less, rounded so that it ends at 0.
std::uint8_t decayed(std::uint8_t value, int share) {
  return static_cast<std::uint8_t>(value - (value + share - 1) / share);
}

bool finite(const GeoPoint& point) {
  return std::isfinite(point.latitude_deg) && std::isfinite(point.longitude_deg) &&
         std::fabs(point.latitude_deg) <= 90.0 && std::fabs(point.longitude_deg) <= 360.0;
}

double clamped(double share) { return std::clamp(share, 0.0, 1.0); }

}  // namespace

LandMap::LandMap() : cells_(std::size_t{kSide} * kSide) {}

void LandMap::forget() {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  own_ = {};
}

void LandMap::go_on(const GeoPoint& own_ship, std::uint64_t width_units, double reach_m) {
  swept_ += width_units;
  // Turns count from far beyond 0, which is that of cells never seen.
  turn_ = static_cast<std::uint32_t>(swept_ >> 32) + 2 * kForgotten;
  double cell_m = kCellM;
  while (reach_m > cell_m * kMostReachCells) cell_m *= 2.0;
  if (cell_m != cell_m_) {
    forget();
    cell_m_ = cell_m;
  }
  if (!finite(own_ship) || (begun_ && own_ship == own_ship_)) return;
  if (begun_) {
    const PlanePoint now = ground(own_ship);
    const PlanePoint step = now - own_;
    own_ = now;
    if (dot(step, step) > kMostStepM * kMostStepM || dot(now, now) > kFarthest * kFarthest)
      forget();
  }
  own_ship_ = own_ship;
  cos_latitude_ = echo::sin_cos_degrees(own_ship.latitude_deg).cos;
  begun_ = true;
}

PlanePoint LandMap::ground(const GeoPoint& own_ship) const {
  if (!begun_ || !finite(own_ship)) return own_;
  const double east = wrapped_longitude(own_ship.longitude_deg - own_ship_.longitude_deg);
  const double north = own_ship.latitude_deg - own_ship_.latitude_deg;
  return own_ + PlanePoint{east * cos_latitude_, north} * kMetresPerDegree;
}

LandMap::Place LandMap::place_of(PlanePoint ground) const {
  // Within kFarthest, a step and a reach of 0: far inside of 32 bits.
  return {static_cast<std::int32_t>(std::floor(ground.east_m / cell_m_)),
          static_cast<std::int32_t>(std::floor(ground.north_m / cell_m_))};
}

LandMap::Cell LandMap::now(Place place) const {
  const auto east = static_cast<std::uint32_t>(place.east);
  const auto north = static_cast<std::uint32_t>(place.north);
  Cell cell = cells_[(north % kSide) * kSide + east % kSide];
  const auto where = static_cast<std::uint8_t>((east / kSide % 16) * 16 + north / kSide % 16);
  const std::uint32_t turns = turn_ - cell.turn;
  if (cell.where != where || turns >= kForgotten) return {turn_, where, 0, 0, 0};
  if (turns == 0) return cell;
  for (std::uint32_t i = 0; i < turns && (cell.land | cell.rate) != 0; ++i) {
    cell.land = decayed(cell.land, 16);
    cell.rate = decayed(cell.rate, 8);
  }
  cell.turn = turn_;
  cell.seen = 0;
  return cell;
}

void LandMap::see(Place place, std::uint8_t what) {
  Cell cell = now(place);
  if ((cell.seen & what) != 0) return;
  cell.seen |= what;
  std::uint8_t& value = what == kLand ? cell.land : cell.rate;
  value = grown(value);
  const auto east = static_cast<std::uint32_t>(place.east);
  const auto north = static_cast<std::uint32_t>(place.north);
  cells_[(north % kSide) * kSide + east % kSide] = cell;
}

void LandMap::add_land(const GeoPoint& own_ship, TrueBearing bearing, double width_rad,
                       double from_m, double to_m) {
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
      see(place_of(ship + ahead * range + right * off), kLand);
    }
    if (range >= to_m) return;
  }
}

void LandMap::add_plot(const GeoPoint& own_ship, TrueBearing bearing, double range_m) {
  const auto toward = echo::sin_cos_units(bearing.units());
  see(place_of(ground(own_ship) + PlanePoint{toward.sin, toward.cos} * range_m), kPlot);
}

LandMap::Marks LandMap::at(const GeoPoint& own_ship, TrueBearing bearing, double range_m) const {
  const auto toward = echo::sin_cos_units(bearing.units());
  const Place place = place_of(ground(own_ship) + PlanePoint{toward.sin, toward.cos} * range_m);
  const int near = std::max(1, static_cast<int>(kNearM / cell_m_));
  std::uint32_t plots = 0, squares = 0, always = 0, here = 0, beside = 0;
  for (int north = -near; north <= near; ++north) {
    for (int east = -near; east <= near; ++east) {
      const Cell cell = now({place.east + east, place.north + north});
      plots += cell.rate;
      squares += std::uint32_t{cell.rate} * cell.rate;
      always += cell.rate > kOften ? cell.rate - kOften : 0u;
      if (north == 0 && east == 0) here = cell.land;
      if (std::abs(north) <= 1 && std::abs(east) <= 1)
        beside = std::max<std::uint32_t>(beside, cell.land);
    }
  }
  const double stay = always / (255.0 - kOften);
  const double come_and_go = (plots - squares / 255.0) / 255.0;
  Marks marks;
  marks.on_land = std::max({here / 255.0, beside / 510.0, clamped((stay - 3.0) / 4.0)});
  marks.clutter = clamped((come_and_go - 2.0) / 6.0);
  return marks;
}

}  // namespace skerry::server
