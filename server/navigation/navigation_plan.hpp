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
};
inline constexpr std::size_t kNavigationSentences = 16;

// "rmc".
std::string_view name_of(NavigationSentence sentence);
std::optional<NavigationSentence> find_navigation_sentence(std::string_view name);

// As ITU-R M.1371 has it: only for vdm, vdo and static_period.
inline constexpr Duration kAsAisDoes{0};
inline constexpr Duration kShortestNavigationPeriod = std::chrono::milliseconds(20);
inline constexpr Duration kLongestNavigationPeriod = std::chrono::hours(1);

struct NavigationPlan {
  // What is not there is not said.  Every period: kShortestNavigationPeriod to
  // kLongestNavigationPeriod.
  std::map<NavigationSentence, Duration> periods = usual_periods();
  // Of names and sizes in AIS (types 5 and 24).  A minute, not the six of M.1371: a display that is
  // switched on during an exercise then soon has the names.
  Duration static_period = std::chrono::minutes(1);
  std::uint32_t own_mmsi = 0;        // nine digits; 0: the one that the scenario gives own ship
  double ais_range_nm = 60.0;        // 1 .. 1000, from own ship: where VHF ends
  double tracking_range_nm = 24.0;   // 0.1 .. 120
  std::size_t tracked_targets = 40;  // 1 .. 99, the nearest; MSC.192(79) asks for 40 at most
  // What positions call themselves: simulated ones have mode S and quality 8, and the status V that
  // IEC 61162-1 wants of them, so most displays do not use them.
  bool says_simulated = false;

  static std::map<NavigationSentence, Duration> usual_periods();
};

// Why the plan cannot be, naming the value and its range.
std::optional<std::string> fault_in(const NavigationPlan& plan);

}  // namespace skerry::server
