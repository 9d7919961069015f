// Table 2 of Ji et al. 2016: what a turn's coast costs, by method, iterations and range, as printed
// and corrected, measured in one run on the coast at Bergen.
//   table2_bench [--quick] [--csv FILE]
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "echo/fractal/as_printed/printed_coast.hpp"
#include "tests/bench/bench_support.hpp"
#include "tests/scenes/charts.hpp"

namespace {

using namespace skerry;
using echo::CoastMethod;

// Afloat 154 m off the shore, so that there is coast at every range; 1.3 NM south-west of where the
// other benches lie, which have none within 0.3 NM.
constexpr GeoPoint kPlace{60.2557, 5.2314};
constexpr std::array<double, 6> kRanges = {6.0, 3.0, 1.5, 0.75, 0.5, 0.25};
constexpr std::string_view kCold = "first of a chart", kWarm = "as she moves";
constexpr int kPaperIterations = 4, kMostIterations = 8;
constexpr std::size_t kTurnMayMake = echo::as_printed::kMostPoints;

struct Options {
  bool quick = false;
  std::string csv;
};

struct Cell {
  double ms = 0.0;
  std::size_t points = 0;
};
using Row = std::array<std::optional<Cell>, kRanges.size()>;  // nothing: too many points

// The method that each row shows.
struct Printed {
  CoastMethod method;
  std::string_view name;
  double threshold_px;
  int iterations;
  Row row;
};
struct Corrected {
  CoastMethod method;
  double dimension;
  Row cold, warm;
};

echo::CoastRules rules_of(CoastMethod method, double dimension) {
  echo::CoastRules rules{.seed = 1};
  for (echo::CoastStyle& style : rules.styles) style = {.method = method, .dimension = dimension};
  return rules;
}

echo::RadarResolution resolution_of(double nm) {
  const double range_m = nautical_miles(nm).in_metres();
  return {range_m, range_m / 1024.0, 360.0 / 4096.0};
}

// One chart window for each range, as the server asks for it.
echo::CoastChart chart_of(double nm) {
  const Length radius =
      metres(1.25 * nautical_miles(nm).in_metres() + echo::CoastPreparer::kMaxAnchorDistance);
  auto chart = scenes::world_chart(kPlace, radius);
  if (!chart) throw std::runtime_error("no GSHHG chart is installed (Debian: gmt-gshhg-full)");
  return std::move(*chart);
}

using Line = std::vector<PlanePoint>;
struct Coast {
  PlanePoint centre;
  std::vector<Line> lines;  // the chart's edges in range, joined
  std::size_t edges = 0;
};

Coast straight_coast(const echo::CoastChart& chart, double nm) {
  echo::CoastPreparer preparer(chart, kPlace, rules_of(CoastMethod::straight, 1.0));
  const auto picture = preparer.prepare(kPlace, resolution_of(nm));
  Coast coast{picture->centre, {}, picture->edge_count()};
  for (std::size_t r = 0; r + 1 < picture->run_starts.size(); ++r) {
    coast.lines.emplace_back(picture->vertices.begin() + picture->run_starts[r],
                             picture->vertices.begin() + picture->run_starts[r + 1]);
  }
  return coast;
}

// CPU seconds of repeat() to repeat(): the median of 1 to 15 runs, more of the quick ones.
template <typename Body>
double median_ms(bool quick, Body body) {
  std::vector<double> seconds;
  double sum = 0.0;
  const std::size_t most = quick ? 3 : 15;
  const double enough = quick ? 0.02 : 1.0;
  while (seconds.size() < most && (seconds.empty() || sum < enough)) {
    const double begun = bench::thread_seconds();
    body();
    seconds.push_back(bench::thread_seconds() - begun);
    sum += seconds.back();
  }
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return 1e3 * *middle;
}

// Projects and refines all of the coast once, as the paper does each turn; gives the points made.
std::size_t refine_as_printed(const Coast& coast, double nm, echo::as_printed::Parameters p) {
  const echo::as_printed::Display display{coast.centre, nautical_miles(nm).in_metres(), 1000.0};
  std::vector<echo::as_printed::PixelPoint> pixels;
  std::size_t made = 0;
  for (const Line& line : coast.lines) {
    pixels.clear();
    for (const PlanePoint& v : line) pixels.push_back(display.to_pixel(v));
    p.most_points = std::max<std::size_t>(2, kTurnMayMake - made);
    p.seed = made;
    made += echo::as_printed::refine(pixels, p).size();
    if (made > kTurnMayMake) throw std::length_error("more points than a turn may make");
  }
  return made;
}

std::optional<Cell> printed_cell(const Coast& coast, double nm,
                                 const echo::as_printed::Parameters& p, bool quick) {
  const bool koch = p.method == CoastMethod::random_koch;
  // Not even started where it can only be refused, or takes long.
  const double least = static_cast<double>(coast.edges) *
                       (p.threshold_px > 0.0 ? 1.0 : std::pow(koch ? 4.0 : 2.0, p.iterations));
  if (least > (quick ? 1e6 : static_cast<double>(kTurnMayMake))) return std::nullopt;
  try {
    Cell cell;
    cell.ms = median_ms(quick, [&] { cell.points = refine_as_printed(coast, nm, p); });
    return cell;
  } catch (const std::length_error&) {
    return std::nullopt;
  }
}

// Cold: the first picture of a new preparer, the chart already laid in the plane.  Warm: the next
// ones, each as soon as the ship has left the one before.
void measure_corrected(const echo::CoastChart& chart, std::size_t range, Corrected& row,
                       bool quick) {
  const double nm = kRanges[range];
  const echo::RadarResolution resolution = resolution_of(nm);
  const echo::CoastRules rules = rules_of(row.method, row.dimension);
  const double step_deg = 1.01 * echo::CoastPreparer::slack_for(resolution.range_m) / 111'400.0;
  const int steps = quick ? 2 : 8;
  std::vector<double> cold, warm;
  std::size_t cold_points = 0, warm_points = 0;
  for (int repeat = 0; repeat < (quick ? 1 : 5); ++repeat) {
    echo::CoastPreparer preparer(chart, kPlace, rules);
    const auto timed = [&](GeoPoint place, std::vector<double>& to) {
      const double begun = bench::thread_seconds();
      const auto picture = preparer.prepare(place, resolution);
      to.push_back(1e3 * (bench::thread_seconds() - begun));
      return picture->vertices.size();
    };
    cold_points = timed(kPlace, cold);
    for (int k = 1; k <= steps; ++k) {
      warm_points = timed({kPlace.latitude_deg + k * step_deg, kPlace.longitude_deg}, warm);
    }
  }
  const auto median = [](std::vector<double>& of) {
    const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), middle, of.end());
    return *middle;
  };
  row.cold[range] = Cell{median(cold), cold_points};
  row.warm[range] = Cell{median(warm), warm_points};
}

std::string short_count(std::size_t points) {
  if (points < 10'000) return std::to_string(points);
  const auto n = static_cast<double>(points);
  return n < 1e6 ? fmt::format("{:.0f}k", n * 1e-3) : fmt::format("{:.1f}M", n * 1e-6);
}

std::string ratio_text(double ratio) {
  if (ratio < 0.0995) return fmt::format("{:.2g}", ratio);
  return ratio < 9.95 ? fmt::format("{:.2f}", ratio) : fmt::format("{:.0f}", ratio);
}

void print_head(std::string_view what) {
  fmt::print("\n{}\n{:<36}", what, "");
  for (const double nm : kRanges) fmt::print("{:>23}", fmt::format("{} NM", nm));
  fmt::print("\n{:<36}", "");
  for (std::size_t i = 0; i < kRanges.size(); ++i)
    fmt::print("{:>9}{:>7}{:>7}", "ms", "points", "ratio");
  fmt::print("\n");
}

void print_row(const std::string& label, const Row& row, const Row& numerator,
               const Row& denominator) {
  fmt::print("{:<36}", label);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!row[i]) {
      fmt::print("{:>23}", "-");
      continue;
    }
    const std::string ratio =
        numerator[i] && denominator[i] ? ratio_text(numerator[i]->ms / denominator[i]->ms) : "";
    fmt::print("{:>9.4g}{:>7}{:>7}", row[i]->ms, short_count(row[i]->points), ratio);
  }
  fmt::print("\n");
}

std::string label_of(const Printed& p) {
  return fmt::format("{:<12}{:<12}{:>2} iterations", p.name,
                     p.threshold_px > 0.0 ? "improved" : "unimproved", p.iterations);
}

void print_tables(const std::vector<Printed>& printed, const std::vector<Corrected>& corrected) {
  const auto corrected_of = [&](CoastMethod method) -> const Corrected& {
    return *std::find_if(corrected.begin(), corrected.end(),
                         [&](const Corrected& c) { return c.method == method; });
  };
  print_head(
      "As printed (c = 15, L = 10 pixels where improved), refined once per turn; "
      "ratio: time of the method corrected, as she moves, to this");
  for (const Printed& p : printed) {
    if (p.iterations > kPaperIterations &&
        std::all_of(p.row.begin(), p.row.end(), [](const auto& cell) { return !cell; }))
      continue;
    print_row(label_of(p), p.row, corrected_of(p.method).warm, p.row);
  }
  print_head(
      "Corrected, D as given, down to the radar's resolution (1024 cells, 4096 spokes); "
      "ratio: this time to that of the method as printed, improved, 3 iterations");
  const Row none{};
  for (const Corrected& c : corrected) {
    const auto beside = std::find_if(printed.begin(), printed.end(), [&](const Printed& p) {
      return p.method == c.method && p.threshold_px > 0.0 && p.iterations == 3;
    });
    const Row& as_printed = beside == printed.end() ? none : beside->row;
    const std::string name = fmt::format("{:<13}D {:<6}", name_of(c.method), c.dimension);
    print_row(name + std::string(kCold), c.cold, c.cold, as_printed);
    print_row(name + std::string(kWarm), c.warm, c.warm, as_printed);
  }
  double slowest = 0.0;
  std::string which;
  for (const Corrected& c : corrected) {
    for (const Row* row : {&c.cold, &c.warm}) {
      for (std::size_t i = 0; i < row->size(); ++i) {
        if (!(*row)[i] || (*row)[i]->ms <= slowest) continue;
        slowest = (*row)[i]->ms;
        which = fmt::format("{}, D {}, {} NM, {}", name_of(c.method), c.dimension, kRanges[i],
                            row == &c.cold ? kCold : kWarm);
      }
    }
  }
  fmt::print("\nslowest corrected cell: {:.3g} ms ({})\n", slowest, which);
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

void write_csv(const std::string& file, const std::vector<Printed>& printed,
               const std::vector<Corrected>& corrected) {
  std::ofstream out(file);
  out << "cpu,mode,method,threshold_px,iterations,dimension,range_nm,ms,points\n";
  const std::string cpu = '"' + cpu_name() + '"';
  const auto write = [&](const std::string& what, const Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (row[i])
        out << fmt::format("{},{},{},{:.6g},{}\n", cpu, what, kRanges[i], row[i]->ms,
                           row[i]->points);
    }
  };
  for (const Printed& p : printed) {
    write(fmt::format("as_printed,{},{},{},", name_of(p.method), p.threshold_px, p.iterations),
          p.row);
  }
  for (const Corrected& c : corrected) {
    write(fmt::format("corrected_cold,{},,,{}", name_of(c.method), c.dimension), c.cold);
    write(fmt::format("corrected_warm,{},,,{}", name_of(c.method), c.dimension), c.warm);
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view arg = argv[i];
    if (arg == "--quick" || arg.starts_with("--benchmark_")) {
      options.quick = true;  // tests/run asks all benches in Google Benchmark's words
    } else if (arg == "--csv" && i + 1 < argc) {
      options.csv = argv[++i];
    } else {
      throw std::invalid_argument(fmt::format("{}: not known; allowed: --quick, --csv FILE", arg));
    }
  }
  return options;
}

std::vector<Printed> printed_rows() {
  std::vector<Printed> rows;
  for (const double threshold : {0.0, 10.0}) {
    for (const auto& [method, name] : {std::pair{CoastMethod::random_koch, "random Koch"},
                                       {CoastMethod::midpoint, "fBm"},
                                       {CoastMethod::weierstrass, "WMF"}}) {
      for (int i = 1; i <= kMostIterations; ++i) rows.push_back({method, name, threshold, i, {}});
    }
  }
  return rows;
}

std::vector<Corrected> corrected_rows() {
  std::vector<Corrected> rows = {{CoastMethod::straight, 1.0, {}, {}}};
  for (const CoastMethod method : {CoastMethod::regular_koch, CoastMethod::random_koch,
                                   CoastMethod::midpoint, CoastMethod::weierstrass}) {
    rows.push_back({method, 1.15, {}, {}});
  }
  for (const CoastMethod method : {CoastMethod::midpoint, CoastMethod::weierstrass}) {
    rows.push_back({method, 1.3, {}, {}});
  }
  return rows;
}

// On one line of a terminal, overwritten by the next.
void progress(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r{:<60}\r{}", "", what);
}

void run(const Options& options) {
  std::vector<Printed> printed = printed_rows();
  std::vector<Corrected> corrected = corrected_rows();
  fmt::print("Table 2: milliseconds of CPU per turn, medians; {}\nchart edges in range:",
             cpu_name());
  for (std::size_t i = 0; i < kRanges.size(); ++i) {
    const double nm = kRanges[i];
    const echo::CoastChart chart = chart_of(nm);
    const Coast coast = straight_coast(chart, nm);
    fmt::print("{}  {} NM {}", i == 0 ? "" : ",", nm, coast.edges);
    std::fflush(stdout);
    for (Printed& p : printed) {
      progress(fmt::format("{} NM, {}", nm, label_of(p)));
      p.row[i] = printed_cell(
          coast, nm,
          {.method = p.method, .iterations = p.iterations, .threshold_px = p.threshold_px},
          options.quick);
    }
    for (Corrected& c : corrected) {
      progress(fmt::format("{} NM, {} corrected", nm, name_of(c.method)));
      measure_corrected(chart, i, c, options.quick);
    }
  }
  progress("");
  fmt::print("\n-: would make more than {} points{}\n", short_count(kTurnMayMake),
             options.quick ? " (quick: or more than 1M)" : "");
  print_tables(printed, corrected);
  if (!options.csv.empty()) write_csv(options.csv, printed, corrected);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = parse(argc, argv);
    if (!scenes::world_chart(kPlace, nautical_miles(0.25))) {
      fmt::print("No GSHHG chart is installed (Debian: gmt-gshhg-full): nothing to measure.\n");
      return 0;
    }
    run(options);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "table2_bench: {}\n", error.what());
    return 1;
  }
}
