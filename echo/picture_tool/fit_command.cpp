#include "echo/picture_tool/fit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/picture_tool/radar_fit.hpp"
#include "echo/picture_tool/stand_in_report.hpp"
#include "echo/radar/shipped_sets.hpp"
#include "echo/tool_console/console.hpp"
#include "echo/tool_console/text_table.hpp"
#include "echo/tool_console/time_limit.hpp"

namespace skerry::echo {
namespace {

struct RadarFitAsked {
  std::string capture, set, yaml;
  double reach_m = 0.0, minutes = 10.0;
  std::uint32_t places = 4, renders = 60;
  std::uint64_t seed = 77;
  bool no_classifier = false;
};

// What differences are measured by: how far places and turns lie apart at the start.
PictureStatistics fit_spread(const SpreadStatistics& real, const SpreadStatistics& ours) {
  PictureStatistics spread;
  for (const StatisticRow& row : statistic_rows()) {
    const auto known = [](double v) { return std::isfinite(v) ? v : 0.0; };
    spread.*row.of =
        std::hypot(known(real.spread.*row.of), known(ours.spread.*row.of), row.least_spread);
  }
  return spread;
}

class RadarFitter {
 public:
  RadarFitter(const RadarFitAsked& asked, Progress& progress) : asked_(asked), progress_(progress) {
    CapturedRadar row = rows_of(asked.capture).front();
    if (asked.reach_m > 0.0) {
      row = captured_radar_of(asked.capture, asked.reach_m).value_or(row);
      row.reach_m = asked.reach_m;
    }
    if (!asked.set.empty()) row.set = asked.set;
    progress_.show("reading " + asked.capture);
    real_ = real_and_radar(asked.capture, row, 8);
    real_figures_ = spread_statistics({&real_.real, 1}, beam());
    if (real_figures_.empty())
      throw std::runtime_error(fmt::format("{}: no coast in it: only {:.2g} % of the cells echo",
                                           asked.capture, 100.0 * real_figures_.mean.occupancy));
    const GshhgReader chart = GshhgReader::open(GshhgReader::find_finest());
    places_ = find_stand_ins(
        chart, real_.radar,
        {.count = asked.places, .seed = asked.seed, .occupancy = real_figures_.mean.occupancy},
        [&](const std::string& what) { progress_.show(what); });
    if (places_.empty())
      throw std::runtime_error(fmt::format(
          "{}: no place of the chart has a picture of which 1 to 70 % echoes", asked.capture));
  }

  std::string run() {
    const FitGrid grid(real_.radar);
    const SpreadStatistics before = figures_at(grid, grid.start(), 1);
    const PictureStatistics spread = fit_spread(real_figures_, before);
    const TimeLimit limit(asked_.minutes);
    std::uint32_t done = 0;
    const FitResult found = search_grid(
        grid,
        [&](const FitPoint& point) {
          progress_.show(fmt::format("{}: render {} of at most {}", short_name(real_.real), ++done,
                                     asked_.renders));
          return fit_distance(real_figures_.mean, figures_at(grid, point, 1).mean, spread);
        },
        asked_.renders, [&] { return limit.over(); });
    return text_of(grid, found, spread);
  }

 private:
  double beam() const { return real_.radar.set.beam_width_deg; }

  SpreadStatistics figures_at(const FitGrid& grid, const FitPoint& point,
                              std::uint32_t turns) const {
    return spread_statistics(pictures_of(grid.at(point), places_, turns), beam());
  }

  Call call_at(const FitGrid& grid, const FitPoint& point) const {
    return call_real_ours({&real_.real, 1}, pictures_of(grid.at(point), places_, 2), beam(),
                          asked_.seed);
  }

  std::string calls_text(const FitGrid& grid, const FitResult& found) const {
    if (asked_.no_classifier) return {};
    progress_.show("classifier, before");
    const Call before = call_at(grid, grid.start());
    progress_.show("classifier, after");
    const Call after = call_at(grid, found.point);
    if (!before.mask || !after.mask)
      return fmt::format("AUC: -\nnote: {}\n", before.mask ? after.why_not : before.why_not);
    return fmt::format("AUC, mask {:.2f} before, {:.2f} after; all features {:.2f}, {:.2f}\n",
                       before.mask->auc, after.mask->auc, before.all->auc, after.all->auc);
  }

  std::string text_of(const FitGrid& grid, const FitResult& found,
                      const PictureStatistics& spread) const {
    progress_.show("figures of two turns");
    const SpreadStatistics before = figures_at(grid, grid.start(), 2);
    const SpreadStatistics after = figures_at(grid, found.point, 2);
    std::string text = fmt::format(
        "{}, from {}, at {} places, {} renders{}\ndistance {:.2f} before, {:.2f} after\n\n",
        short_name(real_.real), real_.radar.set.name, places_.size(), found.renders,
        found.ended ? "" : ", stopped before the search ended", found.distance_before,
        found.distance);
    TextTable table;
    table.begin("");
    for (const char* head : {"real", "before", "after", "spread", "off by"}) table.add(head);
    std::string missed;
    for (const StatisticRow& row : statistic_rows()) {
      const double off =
          std::fabs(after.mean.*row.of - real_figures_.mean.*row.of) / spread.*row.of;
      const auto cell = [&](double value, int digits) {
        return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("-");
      };
      table.begin(std::string(row.name) + (counts_for_fit(row) ? "" : " *"));
      table.add(cell(real_figures_.mean.*row.of, row.digits));
      table.add(cell(before.mean.*row.of, row.digits));
      table.add(cell(after.mean.*row.of, row.digits));
      table.add(cell(spread.*row.of, row.digits)), table.add(cell(off, 1));
      if (off > 1.0) missed += (missed.empty() ? "" : "; ") + std::string(row.name);
    }
    text += table.text() + "* not sought after\n\n";
    text += fmt::format("not matched to a spread: {}\n", missed.empty() ? "none" : missed);
    text += calls_text(grid, found);
    text += knobs_text(grid, found);
    for (const std::string& note : real_.notes) text += fmt::format("note: {}\n", note);
    const std::string yaml = scenario_of(grid, found.point);
    if (!asked_.yaml.empty()) write_file(asked_.yaml, yaml);
    return text + "\nFor the scenario, under an own ship's radars:\n" + yaml;
  }

  // What the search changed, and what would stand at the end of its grid.
  static std::string knobs_text(const FitGrid& grid, const FitResult& found) {
    std::string text;
    for (std::size_t k = 0; k < kFitKnobs; ++k) {
      const auto knob = static_cast<FitKnob>(k);
      const auto& values = grid.values(knob);
      const bool end = found.point[k] == 0 || found.point[k] + 1 == values.size();
      text += fmt::format("{}: {:g} before, {:g} after{}\n", knob_name(knob),
                          values[grid.start()[k]], values[found.point[k]],
                          end && found.point[k] != grid.start()[k] ? ", the end of the grid" : "");
    }
    return text;
  }

  const RadarFitAsked& asked_;
  Progress& progress_;
  RealAndRadar real_;
  SpreadStatistics real_figures_;
  std::vector<StandIn> places_;
};

int run_radar_fit(const RadarFitAsked& asked) {
  Progress progress;
  RadarFitter fitter(asked, progress);
  const std::string text = fitter.run();
  progress.clear();
  write_out(text);
  return kExitOk;
}

}  // namespace

Command make_radar_fit_command(CLI::App& app) {
  const auto asked = std::make_shared<RadarFitAsked>();
  CLI::App* command =
      app.add_subcommand("fit", "Finds the set that makes our picture most like a recorded one");
  command->add_option("capture", asked->capture, "Of a real radar: .pcap, .pcap.gz or .mcap")
      ->required();
  command->add_option("--reach", asked->reach_m, "Metres to the last cell, to 2 %")
      ->check(CLI::Range(10.0, 400e3));
  std::vector<std::string> names;
  for (const RadarSet& set : shipped_sets()) names.push_back(set.name);
  command
      ->add_option("--set", asked->set,
                   "The shipped set to begin with.  Default: that which the capture's name tells")
      ->check(CLI::IsMember(names));
  command->add_option("--places", asked->places, "Places of ours")
      ->check(CLI::Range(1, 24))
      ->capture_default_str();
  command->add_option("--renders", asked->renders, "Sets tried, at most")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--minutes", asked->minutes, "After these the search stops where it is")
      ->check(CLI::Range(0.0, 1e4))
      ->capture_default_str();
  command->add_option("--seed", asked->seed, "Of the places")->capture_default_str();
  command->add_flag("--no-classifier", asked->no_classifier, "Only the figures, no AUC");
  command->add_option("--yaml", asked->yaml, "Write the lines for the scenario to a file");
  command->footer(
      "Examples:\n"
      "  skerry radar fit halo20-ranges.pcap.gz\n"
      "  skerry radar fit br24-ranges-nm.pcap.gz --reach 1633 --yaml br24.yaml\n"
      "  skerry radar fit ours.mcap --set \"broadband dome\" --renders 30 --minutes 2\n"
      "Turned are video range, integration, gain, pulse, bandwidth and beam, one after the other,\n"
      "while the figures come nearer.\n");
  return {command, [asked] { return run_radar_fit(*asked); }};
}

}  // namespace skerry::echo
