#include "echo/coast_tool/figures_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "echo/chart/gdal/open_chart.hpp"
#include "echo/coast_tool/figure_coast.hpp"
#include "echo/coast_tool/figure_sheet.hpp"
#include "echo/tool_console/console.hpp"
#include "protocol/picture/picture_file.hpp"

namespace skerry::echo {
namespace {

using as_printed::Parameters;

struct FiguresOptions {
  std::string file = "coast-figures.png";
  std::vector<double> place = {60.2557, 5.2314};  // 154 m off the shore south of Bergen
  double range_nm = 0.25;
  std::string chart;
};

constexpr double kThreshold = 10.0;  // L, pixels, as printed

constexpr double kCalmSigma = 40.0;  // pixels

// Koch without c, where the heading does not say otherwise: with it no bump exceeds 4.3 pixels.
Parameters parameters_of(CoastMethod method, int iterations, double threshold_px = 0.0) {
  return {.method = method,
          .iterations = iterations,
          .threshold_px = threshold_px,
          .seed = 1,
          .control_value_px = 0.0};
}

void add_iterations(FigureSheet& sheet, const FigureCoast& coast, Parameters parameters) {
  for (int i = 1; i <= 4; ++i) {
    parameters.iterations = i;
    sheet.add_coast(*coast.printed(parameters),
                    i == 1 ? "1 iteration" : fmt::format("{} iterations", i));
  }
}

RgbaImage draw_figures(const FigureCoast& coast) {
  FigureSheet sheet(coast, "Figures 4, 5, 6, 9 and 10 of Ji et al. 2016 on a real coast");
  sheet.begin_row("Figure 4: random Koch curve as printed", "each edge of the chart whole");
  add_iterations(sheet, coast, parameters_of(CoastMethod::random_koch, 1));
  Parameters cut = parameters_of(CoastMethod::random_koch, 1);
  cut.control_value_px = 15.0;
  sheet.begin_row("Figure 4, with the control value: random Koch curve as printed",
                  "each edge cut into pieces of at most c = 15 pixels first");
  add_iterations(sheet, coast, cut);

  sheet.begin_row("Figure 5: fractional Brownian motion as printed, H = 0.6",
                  "sigma the standard deviation of the heights of the points. Wedges: where the "
                  "curve crosses itself, sea is taken for land");
  add_iterations(sheet, coast, parameters_of(CoastMethod::midpoint, 1));
  Parameters calm = parameters_of(CoastMethod::midpoint, 1);
  calm.sigma_px = kCalmSigma;
  sheet.begin_row("Figure 5, with sigma chosen by eye",
                  fmt::format("sigma = {} pixels. Nothing across edges that run north-west to "
                              "south-east, whatever it is",
                              kCalmSigma));
  add_iterations(sheet, coast, calm);

  sheet.begin_row(
      "Figure 6: Weierstrass-Mandelbrot function as printed, D = gamma = 1.5",
      fmt::format("phases 0: one curve for all edges, on the left of each, that does not "
                  "join. Amplitude {} of the edge, our choice",
                  Parameters{}.amplitude));
  add_iterations(sheet, coast, parameters_of(CoastMethod::weierstrass, 1));

  sheet.begin_row("Figure 9: the improved algorithm (L = 10 pixels) against the unimproved one",
                  "4 iterations");
  const auto add_both = [&](Parameters p, const std::string& name) {
    sheet.add_coast(*coast.printed(p), name + ", unimproved");
    p.threshold_px = kThreshold;
    sheet.add_coast(*coast.printed(p), name + ", improved");
  };
  for (const CoastMethodRow& row : coast_methods()) {
    if (row.paper_label.empty()) continue;
    Parameters p = parameters_of(row.method, 4);
    if (row.method == CoastMethod::midpoint) p.sigma_px = kCalmSigma;
    add_both(p, std::string(row.paper_label));
  }
  cut.iterations = 4;
  add_both(cut, "random Koch, c = 15");

  sheet.begin_row(
      "Figure 10: the radar's echo of it",
      fmt::format("as printed: improved, 3 iterations, Koch without c, sigma = {} pixels. "
                  "Corrected: D 1.15, down to the radar's resolution",
                  kCalmSigma));
  sheet.add_echo(coast.printed({.method = CoastMethod::straight}), "conventional");
  for (const CoastMethodRow& row : coast_methods()) {
    if (row.paper_label.empty()) continue;
    Parameters p = parameters_of(row.method, 3, kThreshold);
    if (row.method == CoastMethod::midpoint) p.sigma_px = kCalmSigma;
    sheet.add_echo(coast.printed(p), fmt::format("{} as printed", row.paper_label));
  }
  for (const CoastMethodRow& row : coast_methods()) {
    if (row.method == CoastMethod::straight) continue;
    sheet.add_echo(
        coast.corrected({.method = row.method, .dimension = 1.15}),
        fmt::format("{} corrected", row.paper_label.empty() ? row.label : row.paper_label));
  }
  return sheet.take();
}

CoastChart chart_for(const FiguresOptions& options, GeoPoint place, RangeScale scale) {
  const OpenedChart opened = open_chart(options.chart);
  for (const std::string& warning : opened.warnings) fmt::print(stderr, "{}\n", warning);
  return opened.chart->load(place, scale.length() * 1.5);
}

int run(const FiguresOptions& options) {
  const GeoPoint place{options.place[0], options.place[1]};
  const auto scale = RangeScale::find(options.range_nm);
  if (!scale) {
    return report(fmt::format("there is no range scale of {} NM", options.range_nm),
                  "They are 0.125 0.25 0.5 0.75 1.5 3 6 12 24 48 72 96.");
  }
  const FigureCoast coast(chart_for(options, place, *scale), place, *scale);
  const RgbaImage image = draw_figures(coast);
  skerry::write_file(options.file, encode_png(image, {{"Source", coast.source()}}));
  write_out(fmt::format("{}: {} x {} pixels\n", options.file, image.width, image.height));
  return kExitOk;
}

}  // namespace

Command make_figures_command(CLI::App& app) {
  auto options = std::make_shared<FiguresOptions>();
  CLI::App* command = app.add_subcommand(
      "figures", "Draws figures 4, 5, 6, 9 and 10 of Ji et al. 2016 on a real coast");
  command->add_option("-o,--output", options->file, "PNG file to write")->capture_default_str();
  command->add_option("--at", options->place, "Own ship: latitude,longitude, degrees")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(-180.0, 180.0))
      ->capture_default_str();
  command->add_option("--range", options->range_nm, "Range scale, NM")->capture_default_str();
  command->add_option("--chart", options->chart,
                      "ENC cell, folder of cells, GeoJSON, Shapefile or GSHHG file;\n"
                      "default: the finest GSHHG installed");
  return {command, [options] { return run(*options); }};
}

}  // namespace skerry::echo
