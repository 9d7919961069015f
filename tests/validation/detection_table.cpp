// detection_table: what rain and sea cost, target by target of MSC.192(79) table 2.
//
// For each target, set and weather: the farthest range at which 8 of 10 scans show it (first
// detection), and within what range the clutter hides it.  One pulse, one cell, antenna 15 m.  The
// threshold is passed by noise and clutter of that range with probability 1e-4, as the best of all
// operators would set it; it is found anew for each range from the cells beside the target.
// Prints the table of README.md beside this file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "echo/radar/shipped_sets.hpp"
#include "echo/spoke_returns.hpp"
#include "protocol/quantity/bearing.hpp"
#include "tests/validation/table2_targets.hpp"
#include "tests/validation/target_trial.hpp"

namespace skerry::validation {
namespace {

constexpr double kBearing = 40.0;
constexpr std::uint32_t kSpokes = 4096, kScans = 60;
constexpr double kNauticalMile = 1852.0;

struct Weather {
  std::string name;
  double rain_mm_h = 0.0;
  double sea_state = 0.0;
};
const std::vector<Weather> kWeather = {{"clear", 0.0, 0.0},
                                       {"rain 4 mm/h", 4.0, 0.0},
                                       {"rain 16 mm/h", 16.0, 0.0},
                                       {"sea state 2", 0.0, 2.0},
                                       {"sea state 5", 0.0, 5.0}};
// Significant wave heights in the middle of sea states 2 and 5, metres (SOURCES.md "Sea").
double waves_of(double state) { return state < 1.0 ? 0.0 : state < 3.0 ? 0.3 : 3.2; }

class Watch {
 public:
  Watch(const echo::RadarSet& set, const Weather& weather, RangeScale scale)
      : clock_(set.rpm, kSpokes),
        model_(echo::radar_model(set, {}, scale, clock_, 0)),
        returns_(model_, echo::serial_for),
        sea_(*scenes::scene_at(scenes::made_up_chart(scenes::kBergen, scale.length() * 1.3, 0, 1),
                               scenes::kBergen, scale, {})) {
    sea_.own_velocity = {};
    sea_.true_north_deg = 0.0;
    sea_.artefacts = {.side_lobes = false, .multiple_echoes = false, .second_trace = false};
    sea_.sea.state = weather.sea_state;
    sea_.sea.wind_from_deg = kBearing - 90.0;  // across: neither the best nor the worst
    sea_.wave_height_m = waves_of(weather.sea_state);
    if (weather.rain_mm_h > 0.0) {
      sea_.rain.push_back({sea_.own_ship,
                           {},
                           4.0 * scale.length().in_metres() + 20e3,
                           weather.rain_mm_h,
                           1,
                           echo::RainKind::even});
    }
  }

  double seen(const Table2Target& target, double range_m) {
    const double threshold = threshold_at(range_m);
    echo::Scene scene = sea_;
    target.put(scene, range_m, kBearing);
    const std::uint32_t spoke = RelativeBearing::from(degrees(kBearing)).nearest_spoke(kSpokes);
    const auto cell = static_cast<std::size_t>(range_m / model_.cell_m) + 1;
    std::uint32_t seen = 0;
    for (std::uint32_t scan = 0; scan < kScans; ++scan) {
      const float power = rows(scene, scan, spoke, 1).cells[cell];
      seen += received(power) > threshold ? 1 : 0;
    }
    return static_cast<double>(seen) / kScans;
  }

 private:
  echo::PowerRows rows(echo::Scene& scene, std::uint32_t scan, std::uint32_t first,
                       std::uint32_t count) {
    const std::uint64_t spoke = std::uint64_t{scan} * kSpokes + first;
    scene.time = clock_.time_of(spoke);
    return returns_.make(scene, spoke, count);
  }

  double received(float power) {
    const double re = std::sqrt(static_cast<double>(power)) + normal_(random_) * std::sqrt(0.5);
    const double im = normal_(random_) * std::sqrt(0.5);
    return re * re + im * im;
  }

  // Passed by one in ten thousand of the cells at that range, over half a turn in three scans.
  double threshold_at(double range_m) {
    const auto cell = static_cast<std::size_t>(range_m / model_.cell_m) + 1;
    if (const auto known = thresholds_.find(cell); known != thresholds_.end()) return known->second;
    const bool clutter = sea_.sea.state > 0.0 || !sea_.rain.empty();
    double threshold = -std::log(1e-4);
    if (clutter) {
      std::vector<double> values;
      for (std::uint32_t scan = 0; scan < 3; ++scan) {
        for (std::uint32_t first = 0; first < kSpokes / 2; first += 16) {
          const echo::PowerRows made = rows(sea_, scan, first, 16);
          for (std::uint32_t k = 0; k < 16; ++k) {
            for (std::size_t i = cell - 1; i <= cell + 1; ++i)
              values.push_back(received(made.cells[k * made.pitch + i]));
          }
        }
      }
      const auto rank = static_cast<std::ptrdiff_t>(1e-4 * static_cast<double>(values.size()));
      std::nth_element(values.begin(), values.end() - 1 - rank, values.end());
      threshold = std::max(threshold, *(values.end() - 1 - rank));
    }
    return thresholds_[cell] = threshold;
  }

  echo::SpokeClock clock_;
  echo::RadarModel model_;
  echo::SpokeReturns returns_;
  echo::Scene sea_;
  std::map<std::size_t, double> thresholds_;
  std::mt19937_64 random_{7};
  std::normal_distribution<double> normal_;
};

struct Range {
  double first_nm = 0.0;  // farthest with 8 of 10
  double lost_nm = 0.0;   // within this it is lost
};

class Table {
 public:
  explicit Table(const echo::RadarSet& set) : set_(set) { set_.antenna_height_m = 15.0; }

  Range range_of(const Table2Target& target, std::size_t weather) {
    Range range;
    for (double nm = 0.3; nm < 23.0; nm *= 1.1) {
      const double metres = nm * kNauticalMile;
      if (watch(weather, scale_for(metres)).seen(target, metres) >= 0.8) {
        range.first_nm = nm;
      } else if (range.first_nm == 0.0) {
        range.lost_nm = nm;
      }
    }
    return range;
  }

 private:
  Watch& watch(std::size_t weather, RangeScale scale) {
    auto& kept = watches_[{weather, scale.index()}];
    if (!kept) kept.emplace(set_, kWeather[weather], scale);
    return *kept;
  }

  echo::RadarSet set_;
  std::map<std::pair<std::size_t, std::size_t>, std::optional<Watch>> watches_;
};

int run() {
  for (const char* name : {"25 kW X", "30 kW S"}) {
    Table table(echo::find_set(name));
    fmt::print("\n| {} | must | ", name);
    for (const Weather& weather : kWeather) fmt::print("{} | ", weather.name);
    fmt::print("\n|---|---|");
    for (std::size_t i = 0; i < kWeather.size(); ++i) fmt::print("---|");
    fmt::print("\n");
    for (const std::string& target_name : table2_names()) {
      const Table2Target target = table2_target(target_name);
      // A coast is made anew for each range, and lies beyond what the clutter hides.
      if (target_name.starts_with("shore")) continue;
      fmt::print("| {} | {} | ", target_name, target.range_nm(echo::find_set(name).band()));
      for (std::size_t w = 0; w < kWeather.size(); ++w) {
        const Range range = table.range_of(target, w);
        if (range.first_nm == 0.0) {
          fmt::print("not seen | ");
        } else if (range.lost_nm > 0.0) {
          fmt::print("{:.1f} (lost within {:.1f}) | ", range.first_nm, range.lost_nm);
        } else {
          fmt::print("{:.1f} | ", range.first_nm);
        }
        std::fflush(stdout);
      }
      fmt::print("\n");
    }
  }
  return 0;
}

}  // namespace
}  // namespace skerry::validation

int main() { return skerry::validation::run(); }
