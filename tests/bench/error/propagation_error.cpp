#include "tests/bench/error/propagation_error.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "echo/propagation/path_table.hpp"
#include "tests/bench/error/study.hpp"

namespace skerry::bench {
namespace {

using echo::PathConditions;
using echo::PathGrid;
using echo::PathTable;

constexpr double kReach = 48.0 * 1852.0;
constexpr int kPathRepetitions = 7;

struct PathPlace {
  float range, height;
  double point = 0.0, body = 0.0;  // of the reference; bodies only of the first few
};
constexpr std::size_t kPlaces = 20000, kBodies = 100;

std::vector<PathPlace> places_of(const PathConditions& conditions) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<PathPlace> places;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    PathPlace place;
    place.range = static_cast<float>(100.0 * std::pow(kReach / 100.0, unit(random)));
    place.height = static_cast<float>(0.25 * std::pow(800.0, unit(random)));
    const auto range = static_cast<double>(place.range), height = static_cast<double>(place.height);
    place.point = echo::point_reference(conditions, range, height);
    if (i < kBodies) place.body = echo::body_reference(conditions, range, height);
    places.push_back(place);
  }
  return places;
}

class Errors {
 public:
  void add(float made, double truth) {
    if (truth > 1e-12)
      db_.push_back(std::fabs(10.0 * std::log10(static_cast<double>(made) / truth)));
  }
  double at(double share) {
    std::sort(db_.begin(), db_.end());
    return db_[static_cast<std::size_t>(share * static_cast<double>(db_.size() - 1))];
  }

 private:
  std::vector<double> db_;
};

void print_grid(std::FILE* out, const PathConditions& conditions,
                const std::vector<PathPlace>& places, PathGrid grid) {
  const double build =
      median_seconds(kPathRepetitions, [&] { PathTable(conditions, kReach, grid); });
  const PathTable table(conditions, kReach, grid);
  volatile float sink = 0.0f;
  const double point = median_seconds(kPathRepetitions, [&] {
    float sum = 0.0f;
    for (const PathPlace& place : places) sum += table.point(place.range, place.height);
    sink = sum;
  });
  const double body = median_seconds(kPathRepetitions, [&] {
    float sum = 0.0f;
    for (const PathPlace& place : places) sum += table.body(place.range, place.height);
    sink = sum;
  });
  Errors points, bodies;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PathPlace& place = places[i];
    points.add(table.point(place.range, place.height), place.point);
    if (i < kBodies) bodies.add(table.body(place.range, place.height), place.body);
  }
  std::fprintf(out,
               "  %3d x %2d per octave %s  build %6.2f ms %5zu KiB  point %5.1f ns  p50 %.4f p99 "
               "%.3f max %6.2f dB   body %5.1f ns  p50 %.4f p99 %.3f max %5.2f dB\n",
               1 << grid.range_bits, 1 << grid.height_bits, grid == PathGrid{} ? "*" : " ",
               build * 1e3, table.bytes() / 1024, point * 1e9 / kPlaces, points.at(0.5),
               points.at(0.99), points.at(1.0), body * 1e9 / kPlaces, bodies.at(0.5),
               bodies.at(0.99), bodies.at(1.0));
}

}  // namespace

void print_propagation_error(std::FILE* out) {
  std::fprintf(out,
               "propagation tables, 15 m, 100 m to 48 NM, 0.25 to 200 m (* in use; the maximum of "
               "a point stands in the deepest null)\n");
  for (double wave : {0.0, 1.5})
    for (double hertz : {9.41e9, 3.05e9}) {
      echo::RadarSet set;
      set.frequency_hz = hertz;
      set.antenna_height_m = 15.0;
      const PathConditions conditions = echo::path_conditions(set, {}, wave);
      const std::vector<PathPlace> places = places_of(conditions);
      std::fprintf(out, " %.2f GHz, waves of %.1f m\n", hertz * 1e-9, wave);
      for (PathGrid grid : {PathGrid{2, 1}, PathGrid{3, 2}, PathGrid{4, 3}, PathGrid{5, 4}})
        print_grid(out, conditions, places, grid);
      volatile double sink = 0.0;
      const double reference = median_seconds(kPathRepetitions, [&] {
        double sum = 0.0;
        for (const PathPlace& place : places)
          sum += echo::point_reference(conditions, static_cast<double>(place.range),
                                       static_cast<double>(place.height));
        sink = sum;
      });
      std::fprintf(out, "  double reference                              point %5.1f ns\n",
                   reference * 1e9 / kPlaces);
    }
}

}  // namespace skerry::bench
