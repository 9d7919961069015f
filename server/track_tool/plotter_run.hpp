// run_plotter(): the spokes of a file through a plotter.
#pragma once

#include <functional>
#include <span>

#include "server/plotter/plotter.hpp"
#include "server/track_tool/spoke_file.hpp"

namespace skerry::server {

// What comes out; both may be null.
struct PlotterOutput {
  std::function<void(const Plot&)> plot;
  // At the end of each turn, the last one's whole or not: tracked ones, and those lost in it.
  std::function<void(std::span<const PlottedTrack>, std::span<const PlottedTrack>)> turn;
};

struct PlotterRun {
  SpokesTaken spokes;
  std::uint64_t turns = 0, plots = 0;
  std::uint32_t tracks = 0;  // tracked at some turn's end
  // Some spoke tells another heading, or place of own ship, than the first one.
  bool heading_changes = false, place_changes = false;
};

// A turn ends before the first spoke of another scan.
// Error: std::invalid_argument of the rule, std::runtime_error of the file.
PlotterRun run_plotter(const SpokeFile& file, const SpokeChoice& choice, const Plotter::Rule& rule,
                       const PlotterOutput& output, const ReadProgress& progress = {});

}  // namespace skerry::server
