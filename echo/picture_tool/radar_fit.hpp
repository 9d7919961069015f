// RadarFit: the set whose picture is most like a real one's.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "echo/picture_tool/made_pictures.hpp"
#include "echo/picture_tool/picture_statistics.hpp"

namespace skerry::echo {

// What the search turns: each a step on a grid.
enum class FitKnob : std::uint8_t { video_range, integration, gain, pulse, bandwidth, beam };
inline constexpr std::size_t kFitKnobs = 6;
using FitPoint = std::array<std::size_t, kFitKnobs>;  // steps, by knob

std::string_view knob_name(FitKnob knob);

// The grid about a set: its own values and others, in order.  Pulses and bandwidths are times the
// set's, all its pulses alike; the beam's antenna gain goes with it, as a scenario's does.
class FitGrid {
 public:
  explicit FitGrid(MadeRadar start);

  const FitPoint& start() const { return start_point_; }
  const std::vector<double>& values(FitKnob knob) const {
    return values_[static_cast<std::size_t>(knob)];
  }
  MadeRadar at(const FitPoint& point) const;
  // Whether such a set can be (faults_of).
  bool sound(const FitPoint& point) const;

 private:
  MadeRadar start_;
  std::array<std::vector<double>, kFitKnobs> values_;
  FitPoint start_point_{};
};

// How far a picture's figures are from the real one's: the mean over statistics that both have of
// the squared difference over the spread, each at most kMostOff spreads squared.  Turn to turn
// figures do not count: the set hardly moves them.
inline constexpr double kMostOff = 5.0;
double fit_distance(const PictureStatistics& real, const PictureStatistics& ours,
                    const PictureStatistics& spread);
bool counts_for_fit(const StatisticRow& row);

struct FitResult {
  FitPoint point{};
  double distance = 0.0, distance_before = 0.0;
  std::uint32_t renders = 0;
  bool ended = false;  // no step makes it better; else it was stopped
};

// Steps along one knob after the other while that makes it better, until none does, `most` points
// were tried or `stop` says so.  A pure function of the grid and `distance_at`.
FitResult search_grid(const FitGrid& grid,
                      const std::function<double(const FitPoint&)>& distance_at, std::uint32_t most,
                      const std::function<bool()>& stop);

// The lines of a scenario's radar that differ from the shipped set, and the controls.
std::string scenario_of(const FitGrid& grid, const FitPoint& point);

}  // namespace skerry::echo
