#include "echo/coast_tool/judge_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "echo/chart/gdal/coverage.hpp"
#include "echo/chart/gdal/open_chart.hpp"
#include "echo/coast_tool/judge_run.hpp"
#include "echo/tool_console/console.hpp"

namespace skerry::echo {
namespace {

struct Asked {
  std::vector<std::string> charts, places;
  std::string area, csv, out;
  bool no_pictures = false;
  JudgeOptions judge;
};

// The chart's own limits; Bergen of one that has the whole Earth.  Error: std::invalid_argument for
// one that is larger than a plane.
CoastArea area_of(const ChartSource& chart) {
  const auto* covered = dynamic_cast<const CoveredChart*>(&chart);
  if (covered == nullptr || covered->coverage().everywhere()) return named_place("bergen");
  const GeoBox box = covered->coverage().box();
  return checked(
      {"chart", box.south_deg, box.north_deg, box.west_deg, box.west_deg + box.width_deg},
      chart.describe());
}

int run_judge(const Asked& asked) {
  std::vector<CoastArea> areas;
  JudgeOptions options = asked.judge;
  try {
    if (!asked.area.empty()) areas.push_back(parse_area(asked.area));
    for (const std::string& place : asked.places) areas.push_back(named_place(place));
    for (const double nm : options.scales_nm) {
      if (RangeScale::find(nm)) continue;
      throw std::invalid_argument(fmt::format("--ranges {:g}: expected some of {} NM", nm,
                                              fmt::join(RangeScale::kNauticalMiles, ", ")));
    }
  } catch (const std::invalid_argument& error) {
    report(error.what());
    return kExitUsage;
  }
  if (asked.no_pictures) options.scales_nm.clear();

  Progress progress;
  progress.show("opening the chart");
  const std::vector<std::filesystem::path> paths(asked.charts.begin(), asked.charts.end());
  const OpenedChart opened = paths.empty() ? open_chart({}) : open_charts(paths);
  for (const std::string& warning : opened.warnings) fmt::print(stderr, "note: {}\n", warning);
  if (areas.empty()) areas.push_back(area_of(*opened.chart));

  std::string text, csv = judgement_csv_head();
  for (const CoastArea& area : areas) {
    const Telling tell = [&](const std::string& what) {
      progress.show(fmt::format("{}: {}", area.name, what));
    };
    tell("reading the coast");
    const CoastChart chart = opened.chart->load(area.centre(), area.radius());
    const Judgement judgement = judge(chart, area, options, tell);
    if (!text.empty()) text += '\n';
    text += judgement_text(judgement);
    csv += judgement_csv(judgement);
  }
  progress.clear();
  if (!asked.csv.empty()) write_file(asked.csv, csv);
  if (asked.out.empty()) {
    write_out(text);
  } else {
    write_file(asked.out, text);
  }
  return kExitOk;
}

}  // namespace

Command make_judge_command(CLI::App& app) {
  const auto asked = std::make_shared<Asked>();
  CLI::App* command = app.add_subcommand(
      "judge", "Thins a fine coast, refines it back by every method and says how like it is");
  command->add_option(
      "--chart", asked->charts,
      "GSHHG file, ENC cell or folder of cells, GeoJSON or Shapefile; several: each "
      "over those after it.  Default: the finest GSHHG installed");
  auto* area = command->add_option("--area", asked->area,
                                   "Two opposite corners, degrees: lat1,lon1,lat2,lon2");
  command
      ->add_option("--place", asked->places,
                   "Coasts known by name.  Default: the limits of --chart, or bergen if it has the "
                   "whole Earth")
      ->check(CLI::IsMember(place_names(), CLI::ignore_case))
      ->excludes(area);
  command->add_option("--keep", asked->judge.keep, "Every how many-th vertex the methods are shown")
      ->check(CLI::Range(2, 64))
      ->capture_default_str();
  command->add_option("--seeds", asked->judge.seeds, "Coasts drawn by each method of chance")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command->add_option("--detail", asked->judge.detail_m, "What curves are refined down to, metres")
      ->check(CLI::Range(0.5, 1000.0))
      ->capture_default_str();
  command->add_option("--ranges", asked->judge.scales_nm, "Range scales of the echo pictures, NM")
      ->capture_default_str();
  command->add_option("--beam", asked->judge.beam_deg, "Beam width of the echo pictures, degrees")
      ->check(CLI::Range(0.3, 10.0))
      ->capture_default_str();
  command->add_flag("--no-pictures", asked->no_pictures, "Only the curves, not their echoes");
  command->add_option("--csv", asked->csv, "Write every figure of every seed to a file");
  command->add_option("-o,--out", asked->out, "Write the tables to a file instead of the terminal");
  command->footer(
      "Examples:\n"
      "  skerry coast judge\n"
      "  skerry coast judge --place bergen plymouth dalian --csv judge.csv\n"
      "  skerry coast judge --place bergen --keep 4 --seeds 20 --no-pictures\n"
      "  skerry coast judge --beam 4.9 --ranges 1.5       a beam as the recorded radars have it\n"
      "The echo pictures stand beside what real recordings measure.\n");
  return {command, [asked] { return run_judge(*asked); }};
}

}  // namespace skerry::echo
