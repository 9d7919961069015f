// Speed against error: what each approximation of the coast costs and how wrong it makes it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::bench {

// One setting of one knob.
struct ErrorRow {
  std::string knob;     // "refinement tolerance"
  std::string setting;  // "1/2 cell"
  double microseconds_per_spoke = 0.0;
  double p50_m = 0.0, p99_m = 0.0, max_m = 0.0;  // against the knob's reference
  double dimension = 0.0;                        // of the coast made; NaN where it has no say
  bool in_use = false;                           // what the server does
};

// The place of the studies: Bergen, at a place whose coast lies near and far.
struct ErrorStudy {
  echo::CoastChart chart;  // to 1.2 times the range at least
  GeoPoint own_ship;
  double range_m = 0.0;
  int rays = 1024;      // compared
  int repetitions = 5;  // of each timing; the median counts
  // Called with the name of each setting before it is measured.
  std::function<void(const std::string&)> progress;
};
inline constexpr int kStudySpokes = 4096;
inline constexpr int kStudyCells = 1024;

// Each against its own reference in double precision, without culling, without level of detail.
std::vector<ErrorRow> study_refinement(const ErrorStudy& study);
std::vector<ErrorRow> study_intersection(const ErrorStudy& study);
std::vector<ErrorRow> study_projection(const ErrorStudy& study);
std::vector<ErrorRow> study_series(const ErrorStudy& study);

// p50, p99 and max of `errors`, into `row`; `errors` is sorted.
void fill_errors(std::vector<double>& errors, ErrorRow& row);

// Median seconds of `body` over `repetitions`.
double median_seconds(int repetitions, const std::function<void()>& body);

// Processor time that this thread has used so far.
double thread_seconds();

// Log-log curves, one per knob: p99 error across, time per spoke up.
std::string error_curve_svg(std::span<const ErrorRow> rows);

}  // namespace skerry::bench
