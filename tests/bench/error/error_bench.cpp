// Prints time per spoke against error for every approximation of the coast.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "tests/bench/error/study.hpp"
#include "tests/scenes/charts.hpp"

namespace {

using namespace skerry;
using namespace skerry::bench;

constexpr std::string_view kHelp = R"(error_bench: speed against error off Bergen.

  --range NM     range scale (3)
  --csv FILE     the rows as comma-separated values
  --svg FILE     the curves, log-log
  --quick        fewer rays, one repetition, 0.75 NM
Errors are of the leading edge on each ray, or of each vertex (projection, series), in metres,
against the reference named in the table.
)";

struct Asked {
  double range_nm = 3.0;
  std::string csv, svg;
  bool quick = false;
};

Asked read(int argc, char** argv) {
  Asked asked;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::runtime_error(fmt::format("{} wants a value", word));
      return argv[++i];
    };
    if (word == "--range") {
      asked.range_nm = std::stod(value());
    } else if (word == "--csv") {
      asked.csv = value();
    } else if (word == "--svg") {
      asked.svg = value();
    } else if (word == "--quick" || word.starts_with("--benchmark_min_time")) {
      asked.quick = true;
    } else {
      throw std::runtime_error(fmt::format("{} is not an option\n{}", word, kHelp));
    }
  }
  if (asked.quick) asked.range_nm = 0.75;
  if (!(asked.range_nm >= 0.125 && asked.range_nm <= 24.0)) {
    throw std::runtime_error("--range: expected 0.125 to 24 NM");
  }
  return asked;
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text) || !file.flush()) throw std::runtime_error("cannot write " + path);
}

std::string shown(double dimension) {
  return std::isnan(dimension) ? "" : fmt::format("{:.3f}", dimension);
}

int run(const Asked& asked) {
  ErrorStudy study;
  study.own_ship = scenes::kBergen;
  study.range_m = nautical_miles(asked.range_nm).in_metres();
  study.rays = asked.quick ? 128 : 1024;
  study.repetitions = asked.quick ? 1 : 5;
  study.progress = [](const std::string& what) { fmt::print(stderr, "{}\n", what); };
  auto chart = scenes::world_chart(study.own_ship, metres(1.3 * study.range_m + 200.0));
  if (!chart) {
    fmt::print(stderr, "no world shoreline installed: nothing to measure\n");
    return 0;
  }
  study.chart = std::move(*chart);
  std::vector<ErrorRow> rows;
  for (const auto& part : {study_refinement, study_intersection, study_projection, study_series}) {
    for (ErrorRow& row : part(study)) rows.push_back(std::move(row));
  }
  std::string csv = "knob,setting,in_use,us_per_spoke,p50_m,p99_m,max_m,dimension\n";
  fmt::print("Off Bergen, {} NM, {} spokes of {} cells\n\n", asked.range_nm, kStudySpokes,
             kStudyCells);
  fmt::print("{:22} {:40} {:>10} {:>10} {:>10} {:>10} {:>6}\n", "knob", "setting", "us/spoke",
             "p50 m", "p99 m", "max m", "D");
  for (const ErrorRow& r : rows) {
    const std::string time =
        r.microseconds_per_spoke > 0.0 ? fmt::format("{:.4f}", r.microseconds_per_spoke) : "";
    fmt::print("{:22} {}{:39} {:>10} {:>10.3g} {:>10.3g} {:>10.3g} {:>6}\n", r.knob,
               r.in_use ? '*' : ' ', r.setting, time, r.p50_m, r.p99_m, r.max_m,
               shown(r.dimension));
    csv += fmt::format("{},\"{}\",{},{},{},{},{},{}\n", r.knob, r.setting, r.in_use ? 1 : 0, time,
                       r.p50_m, r.p99_m, r.max_m, shown(r.dimension));
  }
  fmt::print("\n* what the server does\n");
  if (!asked.csv.empty()) write(asked.csv, csv);
  if (!asked.svg.empty()) write(asked.svg, error_curve_svg(rows));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::string_view(argv[i]) == "--help") {
        fmt::print("{}", kHelp);
        return 0;
      }
    }
    return run(read(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "error_bench: {}\n", error.what());
    return 2;
  }
}
