#include "echo/coast_tool/fit_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "echo/chart/gdal/coverage.hpp"
#include "echo/chart/gdal/open_chart.hpp"
#include "echo/coast_tool/fit_report.hpp"
#include "echo/tool_console/console.hpp"

namespace skerry::echo {
namespace {

constexpr std::array kTypes = {CoastType::unknown, CoastType::artificial, CoastType::rocky,
                               CoastType::sandy};

// A stretch's own offset is no surer than that of so many edges.
constexpr int kStretchEdges = 64;

struct FitOptions {
  std::vector<std::string> charts;
  std::string area, place, method;
  double from_m = 0.0, to_m = 0.0;  // 0: as the chart supports
  bool stretches = false;
  double stretch_km = 10.0;
  std::string csv, yaml;
};

CoastArea area_of(const FitOptions& options, const ChartSource& chart) {
  if (!options.area.empty()) return parse_area(options.area);
  if (!options.place.empty()) return named_place(options.place);
  const auto* covered = dynamic_cast<const CoveredChart*>(&chart);
  if (!covered || covered->coverage().everywhere())
    throw std::invalid_argument(fmt::format(
        "{} is of the whole world: say which coast, by --area lat1,lon1,lat2,lon2 or by --place {}",
        chart.describe(), fmt::join(place_names(), "|")));
  const GeoBox box = covered->coverage().box();
  return checked(
      {"chart", box.south_deg, box.north_deg, box.west_deg, box.west_deg + box.width_deg},
      "the chart");
}

class Fitter {
 public:
  Fitter(const FitOptions& options, const CoastArea& area, const CoastChart& chart,
         const Telling& tell)
      : options_(options), area_(area), chart_(chart), plane_(area.centre()), tell_(tell) {}

  const LocalPlane& plane() const { return plane_; }

  // All coast of the area as one if the chart tells no kinds apart, else each kind by itself; and
  // why a kind is missing.
  std::vector<CoastFit> fits(std::vector<std::string>& missing) const {
    std::vector<CoastType> found;
    for (CoastType type : kTypes) {
      if (coast_lines(chart_, plane_, area_, type).edges > 0) found.push_back(type);
    }
    if (found.empty())
      throw std::runtime_error(fmt::format(
          "no coast in {} ({}) of {}. Is it at sea, or inland? Corners are lat1,lon1,lat2,lon2",
          area_.name, area_.limits(), chart_.source));
    if (found == std::vector{CoastType::unknown})
      return {fit("all", {"unknown", "rocky"}, std::nullopt)};
    std::vector<CoastFit> fits;
    for (CoastType type : found) {
      const std::string name(scenario_name(type));
      try {
        fits.push_back(fit(name, {name}, type));
      } catch (const TooLittleCoast& error) {
        missing.push_back(fmt::format("{} coast: {}", name, error.what()));
      }
    }
    if (fits.empty()) throw TooLittleCoast(fmt::format("{}", fmt::join(missing, "; ")));
    return fits;
  }

 private:
  CoastFit fit(const std::string& name, std::vector<std::string> kinds,
               std::optional<CoastType> type) const {
    CoastFit out{name, std::move(kinds), coast_lines(chart_, plane_, area_, type), {}, {}};
    const double from = options_.from_m > 0.0 ? options_.from_m : finest_scale_m(out.coast);
    const double to = options_.to_m > 0.0 ? options_.to_m : 32.0 * from;
    out.measurement = measure_coast(out.coast, from, to, tell_);
    tell_("choosing a style");
    auto method = find_method(options_.method);
    if (type == CoastType::artificial && !method) method = CoastMethod::straight;
    out.chosen = choose_style(out.measurement.box.dimension,
                              offset_at(out.measurement, out.measurement.spacing_m).value, method);
    if (type == CoastType::artificial && options_.method.empty())
      out.chosen.words = {"straight: artificial coast is (type I)"};
    return out;
  }

  const FitOptions& options_;
  const CoastArea& area_;
  const CoastChart& chart_;
  LocalPlane plane_;
  const Telling& tell_;
};

std::vector<StyledStretch> styled(const CoastStretches& found, const CoastFit& whole,
                                  std::optional<CoastMethod> method, const Telling& tell) {
  std::vector<StyledStretch> out;
  for (const CoastStretch& s : found.stretches) {
    tell(fmt::format("style {} of {}", out.size() + 1, found.stretches.size()));
    const double dimension = std::isfinite(s.dimension.dimension) ? s.dimension.dimension
                                                                  : whole.measurement.box.dimension;
    out.emplace_back(s, choose_style(dimension, s.offset, method, kStretchEdges).style);
  }
  return out;
}

int run_fit(const FitOptions& options) {
  if (options.to_m > 0.0 && options.from_m > 0.0 && options.to_m < 4.0 * options.from_m) {
    report(fmt::format("--from {:g} --to {:g}: fewer than three sizes of box, each twice the last",
                       options.from_m, options.to_m),
           "--to must be at least four times --from.");
    return kExitUsage;
  }
  Progress progress;
  const Telling tell = [&](const std::string& text) { progress.show(text); };
  tell("opening the chart");
  const std::vector<std::filesystem::path> paths(options.charts.begin(), options.charts.end());
  const OpenedChart opened = paths.empty() ? open_chart({}) : open_charts(paths);
  for (const std::string& warning : opened.warnings) fmt::print(stderr, "note: {}\n", warning);
  std::optional<CoastArea> area;
  try {
    area = area_of(options, *opened.chart);
  } catch (const std::invalid_argument& error) {
    report(error.what());
    return kExitUsage;
  }
  tell("reading the coast");
  const CoastChart chart = opened.chart->load(area->centre(), area->radius());

  const Fitter fitter(options, *area, chart, tell);
  std::vector<std::string> missing;
  const std::vector<CoastFit> fits = fitter.fits(missing);
  std::string text = fmt::format("{} ({}), {}\n", area->name, area->limits(), chart.source);
  for (const CoastFit& fit : fits) text += fit_text(fit);
  for (const std::string& reason : missing) text += "\n" + reason + "\n";
  std::vector<StyledStretch> stretches;
  if (options.stretches) {
    const CoastLines all = coast_lines(chart, fitter.plane(), *area);
    const double from = options.from_m > 0.0 ? options.from_m : finest_scale_m(all);
    const CoastStretches found =
        measure_stretches(all, fitter.plane(), options.stretch_km * 1000.0, from, tell);
    stretches = styled(found, fits.front(), find_method(options.method), tell);
    text += stretches_text(found, stretches);
  }
  const std::string scenario = scenario_text(fits, stretches);
  if (!options.csv.empty()) write_file(options.csv, scales_csv(fits));
  if (!options.yaml.empty()) write_file(options.yaml, scenario);
  progress.clear();
  text += "\nFor the scenario:\n" + (stretches.empty() ? scenario : scenario_text(fits, {}));
  if (!stretches.empty()) {
    text += options.yaml.empty()
                ? "and a place for each stretch: --yaml FILE writes all of it\n"
                : fmt::format("with a place for each stretch in {}\n", options.yaml);
  }
  write_out(text);
  return kExitOk;
}

}  // namespace

Command make_fit_command(CLI::App& app) {
  const auto options = std::make_shared<FitOptions>();
  CLI::App* command = app.add_subcommand(
      "fit", "Measures how rough a coast is and chooses the style that refines it likewise");
  command->add_option(
      "--chart", options->charts,
      "GSHHG file, ENC cell or folder of cells, GeoJSON or Shapefile; several: each "
      "over those after it.  Default: the finest GSHHG installed");
  auto* area = command->add_option("--area", options->area,
                                   "Two opposite corners, degrees: lat1,lon1,lat2,lon2.  Default: "
                                   "all of a chart that is not of the world");
  command->add_option("--place", options->place, "A coast known by name")
      ->check(CLI::IsMember(place_names(), CLI::ignore_case))
      ->excludes(area);
  command
      ->add_option("--from", options->from_m,
                   "Least size of box, metres.  Default: 100 m by powers of two, as the chart "
                   "supports it")
      ->check(CLI::Range(0.1, 1e5));
  command->add_option("--to", options->to_m, "Largest size of box, metres.  Default: 32 times that")
      ->check(CLI::Range(0.4, 1e6));
  std::vector<std::string> methods;
  for (const CoastMethodRow& row : coast_methods()) methods.emplace_back(row.name);
  command->add_option("--method", options->method, "Default: by the dimension")
      ->check(CLI::IsMember(methods));
  command->add_flag("--stretches", options->stretches, "Also each stretch of the coast by itself");
  command->add_option("--stretch-km", options->stretch_km, "How long a stretch is")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  command->add_option("--csv", options->csv, "Write scale, boxes, local D and offsets to a file");
  command->add_option("--yaml", options->yaml, "Write the lines for the scenario to a file");
  command->footer(
      "Examples:\n"
      "  skerry coast fit --place bergen\n"
      "  skerry coast fit --area 50.15,-4.6,50.55,-3.6 --csv plymouth.csv\n"
      "  skerry coast fit --chart US5WA22M.000 --stretches --yaml tacoma.yaml\n"
      "South and west are negative.  The dimension is that of a box count; rulers along the lines\n"
      "and offsets from chords stand beside it, and how sure each is.\n");
  return {command, [options] { return run_fit(*options); }};
}

}  // namespace skerry::echo
