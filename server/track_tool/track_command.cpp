#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "echo/tool_console/console.hpp"
#include "echo/tool_console/part_file.hpp"
#include "server/track_tool/commands.hpp"
#include "server/track_tool/plotter_run.hpp"
#include "server/track_tool/plotter_settings.hpp"
#include "server/track_tool/track_writer.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

struct TrackOptions {
  std::string file, tracks, plots;
  SpokeChoice choice;
  ChosenSettings settings;
};

int misused(const std::string& why) {
  echo::report(why, "skerry track --help says more.");
  return echo::kExitUsage;
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return a == b || fs::equivalent(a, b, ignored);
}

// What is wrong with the command line, before anything is read.
std::string misuse(const TrackOptions& options) {
  if (options.file.empty()) return "FILE is missing: a recording or a capture";
  if (options.tracks.empty() && options.plots.empty()) {
    return "nothing to write; expected -o FILE or --plots FILE";
  }
  if (!options.tracks.empty() && !track_writer_for(options.tracks, {}, [](std::string_view) {})) {
    return fmt::format("-o {}: expected {}", options.tracks, kTrackEndings);
  }
  if (!options.plots.empty() && !options.plots.ends_with(".csv")) {
    return fmt::format("--plots {}: expected .csv", options.plots);
  }
  if (!options.plots.empty() && same_file(options.plots, options.tracks)) {
    return "-o and --plots name the same file";
  }
  for (const std::string& output : {options.tracks, options.plots}) {
    if (!output.empty() && same_file(output, options.file)) {
      return fmt::format("{} would be written over", options.file);
    }
  }
  return "";
}

void warn(const std::string& text) { fmt::print(stderr, "skerry track: {}\n", text); }

std::string counted(std::uint64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

int track_file(const TrackOptions& options) {
  if (const std::string why = misuse(options); !why.empty()) return misused(why);
  // What cannot be written is found before minutes of reading.
  std::optional<echo::PartFile> tracks, plots;
  if (!options.tracks.empty()) tracks.emplace(options.tracks);
  if (!options.plots.empty()) plots.emplace(options.plots);

  echo::Progress shown;
  const ReadProgress progress = [&](double share, const char* doing) {
    shown.show(fmt::format("{}: {:.0f} %", doing, 100.0 * share));
  };
  const SpokeFile file(options.file, progress);
  shown.clear();
  for (const std::string& warning : file.warnings()) warn(warning);
  const SpokeFile::View view = file.chosen(options.choice);

  Plotter::Rule rule = options.settings.rule();
  const double told_deg = file.beam_deg(view.radar);
  if (!options.settings.has("beam") && told_deg > 0.0) {
    rule.plots.beam_deg = std::clamp(told_deg, 0.1, 10.0);
  }
  std::unique_ptr<TrackWriter> writer;
  std::optional<PlotCsv> plot_csv;
  PlotterOutput output;
  if (tracks) {
    writer = track_writer_for(options.tracks, {view.radar, view.view, file.hello(view.radar)},
                              [&](std::string_view text) { tracks->write(text); });
    output.turn = [&](std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) {
      writer->turn(tracked, lost);
    };
  }
  if (plots) {
    plot_csv.emplace(view.radar, [&](std::string_view text) { plots->write(text); });
  }
  output.plot = [&](const Plot& plot) {
    if (plot_csv) plot_csv->add(plot);
    if (writer) writer->plot(plot);
  };
  const PlotterRun run = run_plotter(file, options.choice, rule, output, progress);
  shown.clear();
  if (run.spokes.chunks > 0 || run.spokes.refused > 0) {
    warn(fmt::format("{} and {} could not be read", counted(run.spokes.refused, "spoke"),
                     counted(run.spokes.chunks, "chunk")));
  }
  if (!run.heading_changes) {
    warn("no change of heading is told: if own ship yawed, what lay still seems to move");
  }
  if (!run.place_changes) {
    warn("no way of own ship is told: if she sailed, courses and speeds are relative to her");
  }
  if (writer) writer->finish();
  if (plots) plots->finish();
  if (tracks) tracks->finish();
  echo::write_out(fmt::format("radar {} view {}: {}, {}, {}, {} tracked\n", view.radar, view.view,
                              counted(run.spokes.spokes, "spoke"), counted(run.turns, "turn"),
                              counted(run.plots, "plot"), counted(run.tracks, "target")));
  return echo::kExitOk;
}

}  // namespace

echo::Command make_track_command(CLI::App& app) {
  auto options = std::make_shared<TrackOptions>();
  app.add_option("FILE", options->file,
                 "a recording (.mcap), or a capture of a real radar: pcap, pcapng, by gzip or not");
  app.add_option("-o,--output", options->tracks,
                 "the tracks, FILE.csv or FILE.geojson; FILE.mcap: the plots, too");
  app.add_option("--plots", options->plots, "the plots, FILE.csv");
  app.add_option("--radar", options->choice.radar, "its number; without it the first with spokes");
  app.add_option("--view", options->choice.view, "its number; without it the radar's first");
  app.add_option("--from", options->choice.from,
                 "where to begin: seconds, [h:]min:s, or a mark's name");
  app.add_option("--until", options->choice.until, "where to end, likewise");
  options->settings.add_options(app);
  return {&app, [options] { return track_file(*options); }};
}

}  // namespace skerry::server
