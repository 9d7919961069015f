#include "server/exercise_tool/echo_stand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kBoxMargin_m = 30.0;
constexpr double kRingMargin_m = 300.0;
constexpr double kLandMargin_m = 100.0;
constexpr int kLit = 64;

using LandAt = std::function<bool(GeoPoint)>;

// A scan as levels by range and true bearing from where it was made.
class PolarVideo {
 public:
  PolarVideo(const Scan& scan, const LandAt& is_land) : scan_(scan), is_land_(is_land) {
    const Spoke& newest = *scan.newest();
    own_ = newest.header.own_ship;
    heading_deg_ = newest.header.heading.in_degrees();
    cell_m_ = newest.header.cell_size().in_metres();
    cells_ = static_cast<int>(scan.geometry.cells);
    spokes_ = static_cast<int>(scan.geometry.spokes_per_turn);
    scale_ = scan.geometry.bits == 4 ? 17 : 1;
  }

  double cell_m() const { return cell_m_; }
  int cells() const { return cells_; }
  int spokes() const { return spokes_; }
  double spoke_deg() const { return 360.0 / spokes_; }

  int level(int spoke, int cell) const {
    const auto& row =
        scan_.spokes[static_cast<std::size_t>(((spoke % spokes_) + spokes_) % spokes_)];
    return row ? scale_ * row->cells[static_cast<std::size_t>(cell)] : 0;
  }
  double mean(int spoke, int cell, int half_width) const {
    int sum = 0;
    for (int k = -half_width; k <= half_width; ++k) sum += level(spoke + k, cell);
    return static_cast<double>(sum) / (2 * half_width + 1);
  }
  int spoke_at(double true_deg) const {
    const int spoke = nearest(true_deg - heading_deg_);
    const auto& row = scan_.spokes[static_cast<std::size_t>(spoke)];
    // A ship that turns has another heading there.
    return row ? nearest(true_deg - row->header.heading.in_degrees()) : spoke;
  }
  GeoPoint place_at(double range_m, double spoke) const {
    const double bearing = degrees(heading_deg_ + spoke * spoke_deg()).in_radians();
    constexpr double kMetresPerDegree = 111'120.0;
    const double parallel = std::max(0.01, std::cos(degrees(own_.latitude_deg).in_radians()));
    return {own_.latitude_deg + range_m * std::cos(bearing) / kMetresPerDegree,
            wrapped_longitude(own_.longitude_deg +
                              range_m * std::sin(bearing) / kMetresPerDegree / parallel)};
  }
  bool is_land(int spoke, int cell) const {
    return is_land_(place_at((cell + 0.5) * cell_m_, spoke));
  }
  // Or its echo, or beam, may reach the place.
  bool is_near_land(int spoke, int cell, double half_beam_spokes) const {
    const double range_m = (cell + 0.5) * cell_m_;
    return is_land_(place_at(range_m, spoke)) ||
           is_land_(place_at(range_m, spoke - half_beam_spokes)) ||
           is_land_(place_at(range_m, spoke + half_beam_spokes)) ||
           is_land_(place_at(std::max(0.0, range_m - kLandMargin_m), spoke)) ||
           is_land_(place_at(range_m + kLandMargin_m, spoke));
  }
  GeoPoint own() const { return own_; }

 private:
  int nearest(double relative_deg) const {
    return static_cast<int>(std::lround(wrapped_degrees(relative_deg) / spoke_deg())) % spokes_;
  }

  const Scan& scan_;
  const LandAt& is_land_;
  GeoPoint own_;
  double heading_deg_ = 0.0, cell_m_ = 1.0;
  int cells_ = 0, spokes_ = 0, scale_ = 1;
};

double quantile(std::vector<double>& values, double share) {
  const auto at = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

struct Around {
  double median = 0.0, upper_tenth = 0.0;
  double least_rise() const { return std::max(kLeastRise, kLeastSpread * (upper_tenth - median)); }
};

std::optional<Around> around_of(std::vector<double>& levels) {
  if (levels.size() < 20) return std::nullopt;
  return Around{quantile(levels, 0.5), quantile(levels, 0.9)};
}

struct Where {
  double range_m = 0.0;
  int spoke = 0;
  double half_beam = 0.0;  // spokes
  int half_mean = 0;       // spokes to either side of a mean's middle
};

EchoStand hull_stand(const EchoPlace& place, const PolarVideo& video, const Where& at) {
  const double half_m = place.half_length_m + kBoxMargin_m;
  const double half_cells = std::max(1.5, half_m / video.cell_m());
  const double across_deg = radians(half_m / std::max(50.0, at.range_m)).in_degrees();
  const double half_spokes = std::min(90.0, across_deg) / video.spoke_deg() + at.half_beam;
  const double ring_cells = half_cells + std::max(half_cells, kRingMargin_m / video.cell_m());
  const double ring_spokes = std::min(video.spokes() / 4.0, half_spokes + 6.0 * at.half_beam);
  const double middle = at.range_m / video.cell_m();
  std::vector<double> ring;
  double strongest = -1.0;
  const int first = std::max(0, static_cast<int>(middle - ring_cells));
  const int last = std::min(video.cells() - 1, static_cast<int>(middle + ring_cells));
  for (int cell = first; cell <= last; ++cell) {
    const double off_cells = std::fabs(cell + 0.5 - middle) / half_cells;
    for (int k = -static_cast<int>(ring_spokes); k <= static_cast<int>(ring_spokes); ++k) {
      const double off = std::max(off_cells, std::fabs(k) / half_spokes);
      if (off > 1.0 && off < 4.0 / 3.0) continue;
      if (video.is_near_land(at.spoke + k, cell, at.half_beam)) continue;
      const double level = video.mean(at.spoke + k, cell, at.half_mean);
      if (off <= 1.0) {
        strongest = std::max(strongest, level);
      } else {
        ring.push_back(level);
      }
    }
  }
  if (strongest < 0.0) return {false, "her place is in the land's echo"};
  const auto around = around_of(ring);
  if (!around) return {false, "land is all round her"};
  const double rise = strongest - around->median;
  const double least = around->least_rise();
  return {rise >= least, fmt::format("level {:.0f}, {:.0f} over her surroundings (needs {:.0f})",
                                     strongest, rise, least)};
}

EchoStand beacon_stand(const EchoPlace& place, const PolarVideo& video, const Where& at) {
  const int first = static_cast<int>((at.range_m + kBoxMargin_m) / video.cell_m());
  const int last =
      std::min(video.cells() - 1, static_cast<int>((at.range_m + place.trail_m) / video.cell_m()));
  const int side = std::max(2, static_cast<int>(6.0 * at.half_beam));
  std::vector<double> ring;
  for (int cell = first; cell <= last; ++cell) {
    for (int k = side; k <= 2 * side; ++k) {
      for (const int spoke : {at.spoke - k, at.spoke + k}) {
        if (!video.is_near_land(spoke, cell, at.half_beam)) {
          ring.push_back(video.mean(spoke, cell, at.half_mean));
        }
      }
    }
  }
  const auto around = around_of(ring);
  if (!around) return {false, "land is all round its trail, or the scale ends before it"};
  int lit = 0, looked = 0, runs = 0;
  bool in_run = false;
  for (int cell = first; cell <= last; ++cell) {
    const bool usable = !video.is_near_land(at.spoke, cell, at.half_beam);
    const bool is_lit =
        usable && video.mean(at.spoke, cell, at.half_mean) >= around->median + around->least_rise();
    looked += usable ? 1 : 0;
    lit += is_lit ? 1 : 0;
    if (is_lit && !in_run) ++runs;
    in_run = is_lit;
  }
  if (place.sort == EchoPlace::Sort::sart) {
    return {runs >= kLeastDots, fmt::format("{} dots (needs {})", runs, kLeastDots)};
  }
  const double share = looked > 0 ? static_cast<double>(lit) / looked : 0.0;
  return {share >= kLeastTrail, fmt::format("{:.0f} % of its trail is lit (needs {:.0f} %)",
                                            100.0 * share, 100.0 * kLeastTrail)};
}

}  // namespace

EchoStand stand_of(const EchoPlace& place, const Scan& scan, const LandAt& is_land) {
  if (scan.newest() == nullptr) return {false, "the radar transmits nothing"};
  const PolarVideo video(scan, is_land);
  const ShortWay way = short_way_between(video.own(), place.position);
  const double range_m = std::hypot(way.north_m, way.east_m);
  const double reach_m = video.cells() * video.cell_m();
  if (range_m > reach_m) {
    return {false, fmt::format("{:.1f} NM off, beyond the range scale", range_m / 1852.0)};
  }
  const double bearing_deg = radians(std::atan2(way.east_m, way.north_m)).in_degrees();
  const double half_beam = 0.5 * place.beam_deg / video.spoke_deg();
  const Where at{range_m, video.spoke_at(bearing_deg), half_beam,
                 static_cast<int>(half_beam / 2.0)};
  return place.sort == EchoPlace::Sort::hull ? hull_stand(place, video, at)
                                             : beacon_stand(place, video, at);
}

LitShares lit_shares(const Scan& scan, double within_m, const LandAt& is_land) {
  LitShares shares;
  if (scan.newest() == nullptr) return shares;
  const PolarVideo video(scan, is_land);
  int land_lit = 0, water_lit = 0;
  for (int spoke = 0; spoke < video.spokes(); spoke += 8) {
    for (int cell = 2; cell < video.cells(); cell += 4) {
      const bool near = cell * video.cell_m() <= within_m;
      const bool lit = video.level(spoke, cell) >= kLit;
      if (video.is_land(spoke, cell)) {
        ++shares.land_cells;
        land_lit += lit ? 1 : 0;
      } else if (near) {
        ++shares.water_cells;
        water_lit += lit ? 1 : 0;
      }
    }
  }
  if (shares.land_cells > 0) shares.land = static_cast<double>(land_lit) / shares.land_cells;
  if (shares.water_cells > 0) shares.water = static_cast<double>(water_lit) / shares.water_cells;
  return shares;
}

}  // namespace skerry::server
