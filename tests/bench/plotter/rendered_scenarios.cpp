// The four scenarios of A.823(19) on rendered video: what extraction adds to
// standard_scenarios_bench.  rendered_run.hpp says which error comes from where.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/unit/plotter/rendered_run.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

using RuleOf = Plotter::Rule (*)(const StandardScenario&, const RenderedRadar&);

Plotter::Rule rule_as_it_learns(const StandardScenario&, const RenderedRadar&) {
  return rule_of_all();
}

struct Row {
  std::vector<double> track, line;  // 95 of 100 are within
  int lost = 0, turns = 0, passings = 0, pieces = 0, false_tracks = 0;
};

Row row_of(const StandardScenario& scenario, double minutes, int runs, const RenderedRadar& radar,
           RuleOf rule_of) {
  Row row;
  std::vector<RenderedResult> results;
  for (int i = 0; i < runs; ++i) {
    results.push_back(rendered_run(scenario, minutes, static_cast<std::uint64_t>(i) + 1, radar,
                                   rule_of(scenario, radar)));
    row.turns += results.back().turns;
    row.passings += static_cast<int>(minutes * radar.set.rpm) + 1;
    row.pieces += results.back().pieces;
    row.false_tracks += results.back().false_tracks;
  }
  const auto at = [&](int i) -> const RenderedResult& {
    return results[static_cast<std::size_t>(i)];
  };
  int none = 0;
  row.track = errors_of_95(runs, row.lost, [&](int i) { return at(i).track; });
  row.line = errors_of_95(runs, none, [&](int i) { return at(i).line; });
  return row;
}

void print_errors(const std::vector<double>& errors) {
  for (const double error : errors) std::printf(" %8.2f   ", error);
  std::printf("\n");
}

// With what becomes of each: kept, not kept, and not kept by the straight line either.
void print_limits(const char* name, const ScenarioErrors& limits, const Row& row) {
  std::printf("           %-22s", name);
  const auto asked = limits.all();
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (asked[k] == 0.0)
      std::printf("        -   ");
    else
      std::printf(" %8.2f%s", asked[k],
                  row.track[k] <= asked[k]  ? " ok"
                  : row.line[k] <= asked[k] ? " NO"
                                            : " no");
  }
  std::printf("\n");
}

void print(std::size_t s, double minutes, const Row& row) {
  const StandardScenario& scenario = kStandardScenarios[s];
  std::printf("%zu  %3.0f min  %-22s", s + 1, minutes, "plotter");
  print_errors(row.track);
  std::printf("           %-22s", "line, the same plots");
  print_errors(row.line);
  const bool one = minutes < 2.0;
  print_limits("A.823", one ? scenario.after_1_min : scenario.after_3_min, row);
  print_limits("MSC.192", one ? msc192_after_1_min(scenario) : msc192_after_3_min(scenario), row);
  std::printf("           seen %.1f %%, further plots a turn %.2f, no track %d, false tracks %d\n",
              100.0 * row.turns / row.passings, 1.0 * row.pieces / std::max(row.turns, 1), row.lost,
              row.false_tracks);
  std::fflush(stdout);
}

// Of errors of plots: their mean; how much it drifts, a minute; their standard deviation in a run
// from the line that drifts; how much those of two turns are alike, -1 to 1; and the root mean
// square of what plots tell.  Only drift and deviation do harm to a motion.
struct Spread {
  double mean = 0.0, drift = 0.0, sigma = 0.0, correlation = 0.0, told = 0.0;
};

Spread spread_of(const std::vector<RenderedResult>& results, double PlotError::*value,
                 double PlotError::*told, double rpm) {
  Spread all;
  double squares = 0.0, products = 0.0, count = 0.0;
  for (const RenderedResult& result : results) {
    const auto n = static_cast<double>(result.plots.size());
    double mean = 0.0, slope = 0.0, times = 0.0;
    for (const PlotError& plot : result.plots) {
      mean += plot.*value / n;
      all.told += plot.*told * (plot.*told);
    }
    const auto turn = [&](std::size_t i) { return static_cast<double>(i) - 0.5 * (n - 1.0); };
    for (std::size_t i = 0; i < result.plots.size(); ++i) {
      slope += turn(i) * (result.plots[i].*value);
      times += turn(i) * turn(i);
    }
    slope /= std::max(times, 1.0);
    const auto off = [&](std::size_t i) { return result.plots[i].*value - mean - slope * turn(i); };
    for (std::size_t i = 0; i < result.plots.size(); ++i) {
      squares += off(i) * off(i);
      if (i > 0) products += off(i) * off(i - 1);
    }
    all.mean += mean / static_cast<double>(results.size());
    all.drift += slope * rpm / static_cast<double>(results.size());
    count += n;
  }
  all.sigma = std::sqrt(squares / std::max(count, 1.0));
  all.told = std::sqrt(all.told / std::max(count, 1.0));
  all.correlation = squares > 0.0 ? products / squares : 0.0;
  return all;
}

// What echo and extraction do to a plot, in the geometry of each scenario.
void print_plots(int runs, RenderedRadar radar, RuleOf rule_of) {
  std::printf(
      "\nplots against the middle of the hull, 3 min   along the range, m                      "
      "across, deg\n%-26s   mean  drift/min  sigma   told  corr.     mean  drift/min  sigma   told "
      " "
      "corr.\n",
      "");
  for (const bool errors : {false, true}) {
    radar.errors = errors;
    for (std::size_t s = 0; s < kStandardScenarios.size(); ++s) {
      const StandardScenario& scenario = kStandardScenarios[s];
      std::vector<RenderedResult> results;
      for (int i = 0; i < runs; ++i)
        results.push_back(rendered_run(scenario, 3.0, static_cast<std::uint64_t>(i) + 1, radar,
                                       rule_of(scenario, radar)));
      const Spread along =
          spread_of(results, &PlotError::far_m, &PlotError::range_sigma_m, radar.set.rpm);
      const Spread across =
          spread_of(results, &PlotError::right_m, &PlotError::right_sigma_m, radar.set.rpm);
      const double deg = kDegreesPerRadian / (scenario.range_nm * 1852.0);
      std::printf("%zu  %-22s %7.1f%11.2f%7.1f%7.1f%7.2f  %7.3f%11.3f%7.3f%7.3f%7.2f\n", s + 1,
                  errors ? "with all errors" : "echo and extraction", along.mean, along.drift,
                  along.sigma, along.told, along.correlation, across.mean * deg, across.drift * deg,
                  across.sigma * deg, across.told * deg, across.correlation);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The four scenarios of A.823(19) on rendered video."};
  int runs = 500;
  RenderedRadar radar;
  app.add_option("--runs", runs, "Of each scenario")->check(CLI::Range(1, 100'000));
  app.add_option("--spokes", radar.spokes, "A turn")->check(CLI::Range(512, 8192));
  app.add_option("--cells", radar.cells, "A spoke")->check(CLI::Range(256, 4096));
  bool pulse_known = false;
  app.add_flag("--pulse-known", pulse_known, "The plotter does not learn how long the pulse is");
  CLI11_PARSE(app, argc, argv);
  const RuleOf rule_of = pulse_known ? rule_knowing_the_pulse : rule_as_it_learns;
  std::printf("95 of 100 runs are within; NO: over the limit; no: over it, and so is the line\n");
  std::printf("%-33s rel.course  rel.speed         CPA        TCPA      course       speed\n", "");
  std::printf("%-33s        deg          kn          NM         min         deg          kn\n", "");
  for (std::size_t s = 0; s < kStandardScenarios.size(); ++s)
    for (const double minutes : {1.0, 3.0})
      print(s, minutes, row_of(kStandardScenarios[s], minutes, runs, radar, rule_of));
  print_plots(std::min(runs, 50), radar, rule_of);
}
