#include "server/track_tool/plotter_run.hpp"

#include <optional>
#include <set>
#include <vector>

namespace skerry::server {
namespace {

// A plotter and what becomes of what it finds.
class OneRun {
 public:
  OneRun(const Plotter::Rule& rule, const PlotterOutput& output)
      : plotter_(rule), output_(output) {}

  void add(const Spoke& spoke) {
    if (scan_ && *scan_ != spoke.header.scan) end_turn();
    scan_ = spoke.header.scan;
    if (!first_) first_ = spoke.header;
    if (spoke.header.heading != first_->heading) run_.heading_changes = true;
    if (spoke.header.own_ship != first_->own_ship) run_.place_changes = true;
    plotter_.add(spoke);
    take_plots();
  }
  PlotterRun finish(SpokesTaken spokes) {
    plotter_.flush();
    take_plots();
    end_turn();
    run_.spokes = spokes;
    run_.tracks = static_cast<std::uint32_t>(seen_.size());
    return run_;
  }

 private:
  void take_plots() {
    for (const Plot& plot : plotter_.new_plots()) {
      ++run_.plots;
      if (output_.plot) output_.plot(plot);
    }
  }
  void end_turn() {
    ++run_.turns;
    const std::vector<PlottedTrack> tracked = plotter_.tracks(), lost = plotter_.take_lost();
    for (const PlottedTrack& track : tracked) seen_.insert(track.number);
    if (output_.turn) output_.turn(tracked, lost);
  }

  Plotter plotter_;
  const PlotterOutput& output_;
  std::optional<std::uint32_t> scan_;
  std::optional<SpokeHeader> first_;
  std::set<std::uint32_t> seen_;
  PlotterRun run_;
};

}  // namespace

PlotterRun run_plotter(const SpokeFile& file, const SpokeChoice& choice, const Plotter::Rule& rule,
                       const PlotterOutput& output, const ReadProgress& progress) {
  OneRun run(rule, output);
  const SpokesTaken spokes = file.each_spoke(
      choice, [&](const Spoke& spoke) { run.add(spoke); }, progress);
  return run.finish(spokes);
}

}  // namespace skerry::server
