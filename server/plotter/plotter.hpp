// Plotter: the spokes of one radar in, plots and tracks out.
#pragma once

#include <span>
#include <vector>

#include "protocol/video/spoke.hpp"
#include "server/plotter/plots/plot_extractor.hpp"
#include "server/plotter/tracks/tracker.hpp"

namespace skerry::server {

// Of one view of a radar, live, played back or imported.  The same spokes give the same plots and
// tracks, bit for bit, on every machine.
//
// Thread: one at a time.
class Plotter {
 public:
  struct Rule {
    PlotExtractor::Rule plots;
    Tracker::Rule tracks;
  };
  Plotter() : Plotter(Rule{}) {}
  // Errors: std::invalid_argument, says which value is out of its range.
  explicit Plotter(const Rule& rule) : extractor_(rule.plots), tracker_(rule.tracks) {}

  // Spokes in their order.
  void add(const Spoke& spoke);
  // The spokes stop here.
  void flush();

  // Those that the last add() or flush() completed.
  std::span<const Plot> new_plots() const { return plots_; }
  // True if the last add() or flush() completed a row: tracks() are of then.
  bool has_gone_on() const { return gone_on_; }
  std::vector<PlottedTrack> tracks() const { return tracker_.tracks(); }
  std::vector<PlottedTrack> take_lost() { return tracker_.take_lost(); }
  Tracker& tracker() { return tracker_; }
  PlotExtractor::Counts plot_counts() const { return extractor_.counts(); }

 private:
  void take_row();

  PlotExtractor extractor_;
  Tracker tracker_;
  std::vector<Plot> plots_;
  bool gone_on_ = false;
};

}  // namespace skerry::server
