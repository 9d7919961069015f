// NavigationPlan: which sentences an output says, how often, and of what.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Named by their formatters.
enum class NavigationSentence : std::uint8_t {
  // Position, course and speed over ground, time.
  rmc,
  gga,
  vtg,
  zda,
  // Heading, rate of turn, speed through the water.
  hdt,
  ths,
  rot,
  vhw,
  vbw,
  // The radar's settings, own ship as the radar has her.
  rsd,
  osd,
  // AIS of the ships and marks around, and of own ship.
  vdm,
  vdo,
  // Tracked targets.
  ttm,
  tll,
  ttd,
  tlb,
  // Alerts about them: changes, all, and as before bridge alert management.
  alf,
  alc,
  alr,
  // The con of a ship that has a class: rudder, shaft, depth, wind felt and true, current, track.
  rsa,
  rpm,
  dpt,
  mwv,
  mwd,
  vdr,
  xte,
};
inline constexpr std::size_t kNavigationSentences = 27;

// "rmc".
std::string_view name_of(NavigationSentence sentence);
std::optional<NavigationSentence> find_navigation_sentence(std::string_view name);

// The period of ITU-R M.1371; only for vdm, vdo and static_period.
inline constexpr Duration kAsAisDoes{0};
inline constexpr Duration kShortestNavigationPeriod = std::chrono::milliseconds(20);
inline constexpr Duration kLongestNavigationPeriod = std::chrono::hours(1);

// Where tracked targets come from.
enum class TargetSource : std::uint8_t {
  plotted,  // the radar's plotter: what its video shows
  truth,    // where ships really are: for instructors and tests
};

struct NavigationPlan {
  // A sentence that is not listed is not sent.  Periods: kShortestNavigationPeriod to
  // kLongestNavigationPeriod.
  std::map<NavigationSentence, Duration> periods = usual_periods();
  // The period of names and sizes in AIS (types 5 and 24).  One minute, not the six of M.1371, so
  // that a display that is switched on during an exercise soon has the names.
  Duration static_period = std::chrono::minutes(1);
  std::uint32_t own_mmsi = 0;  // nine digits; 0: the one that the scenario gives own ship
  double ais_range_nm = 60.0;  // 1 .. 1000, from own ship: where VHF ends
  TargetSource targets = TargetSource::plotted;
  double tracking_range_nm = 24.0;   // 0.1 .. 120
  std::size_t tracked_targets = 40;  // 1 .. 99, the nearest; MSC.192(79) asks for 40 at most
  // Whether positions say that they are simulated: mode S, quality 8, and status V, which IEC
  // 61162-1 then requires.  Most displays do not use such positions.
  bool says_simulated = false;

  static std::map<NavigationSentence, Duration> usual_periods();
};

bool is_of_targets(NavigationSentence sentence);
bool is_of_alerts(NavigationSentence sentence);
// Whether any of its sentences needs a plotter.
bool needs_plotter(const NavigationPlan& plan);

// Why the plan cannot be, naming the value and its range.
std::optional<std::string> fault_in(const NavigationPlan& plan);

}  // namespace skerry::server
