#include "server/world/waters/waters_checks.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>

#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

void check_tide(const scenario::Sea& sea, YamlSource& source) {
  if (sea.tide().empty()) return;
  for (const char* const key : {"sea.tide_range_m", "sea.high_water_h"}) {
    if (source.has(key)) source.refuse(key, "given beside sea.tide; allowed: one of the two");
  }
  std::set<int> names;
  double amplitudes = 0.0, coastline = 0.0;
  for (int i = 0; i < sea.tide_size(); ++i) {
    const std::string path = fmt::format("sea.tide[{}].name", i);
    amplitudes += sea.tide(i).amplitude_m();
    if (sea.tide(i).name() <= scenario::TideConstituent::s2) {
      coastline += sea.tide(i).amplitude_m();  // of m2 and s2: Tide::over_coastline_m()
    }
    if (!source.is_sound(path) || names.insert(sea.tide(i).name()).second) continue;
    source.refuse(path, fmt::format("{} is given twice; allowed: each constituent once",
                                    scenario::TideConstituent::Name_Name(sea.tide(i).name())));
  }
  // What echo::Scene::water_level_m may be.
  constexpr double kMostBelow_m = 17.0, kMostAbove_m = 15.0;
  if (amplitudes + coastline > kMostBelow_m || amplitudes - coastline > kMostAbove_m) {
    source.refuse(
        "sea.tide",
        fmt::format("the water goes from {:.2f} m below mean high water springs to {:.2f} "
                    "m above it; allowed: {} m below to {} m above",
                    amplitudes + coastline, amplitudes - coastline, kMostBelow_m, kMostAbove_m));
  }
  constexpr double kLeastDepth_m = 2.0;
  if (source.is_sound("sea.depth_m") && sea.depth_m() - amplitudes < kLeastDepth_m) {
    source.refuse(source.has("sea.depth_m") ? "sea.depth_m" : "sea.tide",
                  fmt::format("{} m below the mean level, and the tide falls {:.2f} m; allowed: at "
                              "least {} m at low water",
                              sea.depth_m(), amplitudes, kLeastDepth_m));
  }
}

void check_banks(const scenario::Scenario& scenario, YamlSource& source) {
  if (scenario.banks_size() > kMaxBanks) {
    source.refuse("banks",
                  fmt::format("{} entries; allowed: at most {}", scenario.banks_size(), kMaxBanks));
    return;
  }
  for (int i = 0; i < scenario.banks_size(); ++i) {
    const auto& line = scenario.banks(i).line();
    const std::string path = fmt::format("banks[{}].line", i);
    if (!source.is_sound(path)) continue;
    if (line.size() < 2 || line.size() > kMaxBankPoints) {
      source.refuse(path, fmt::format("{} points; allowed: 2 to {}", line.size(), kMaxBankPoints));
      continue;
    }
    for (int k = 1; k < line.size(); ++k) {
      const ShortWay way = short_way_between(geo_point(line[k - 1]), geo_point(line[k]));
      const double long_m = length_of({way.east_m, way.north_m});
      if (long_m >= 1.0 && long_m <= kLongestBankPart_m) continue;
      source.refuse(fmt::format("{}[{}]", path, k),
                    fmt::format("{:.1f} m from the point before it; allowed: 1 to {} m", long_m,
                                kLongestBankPart_m));
    }
  }
}

}  // namespace

void check_waters(const scenario::Scenario& scenario, YamlSource& source) {
  check_tide(scenario.sea(), source);
  check_banks(scenario, source);
  if (scenario.tidal_diamonds_size() > kMaxTidalDiamonds) {
    source.refuse("tidal_diamonds", fmt::format("{} entries; allowed: at most {}",
                                                scenario.tidal_diamonds_size(), kMaxTidalDiamonds));
    return;
  }
  std::map<std::string, int> names;
  for (int i = 0; i < scenario.tidal_diamonds_size(); ++i) {
    const scenario::TidalDiamond& diamond = scenario.tidal_diamonds(i);
    const std::string path = fmt::format("tidal_diamonds[{}]", i);
    if (source.is_sound(path + ".name")) {
      const auto [other, is_new] = names.emplace(diamond.name(), i);
      if (!is_new) {
        source.refuse(path + ".name",
                      fmt::format("\"{}\" is the name of tidal_diamonds[{}] too; names must differ",
                                  diamond.name(), other->second));
      }
    }
    if (diamond.hours_size() != kStreamHours) {
      source.refuse(path + ".hours",
                    fmt::format("{} given; expected {}: from 6 h before high water to 6 h after it",
                                diamond.hours_size(), kStreamHours));
    }
  }
}

}  // namespace skerry::server
