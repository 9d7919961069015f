// Small craft at their berths, made up where a chart has marinas, fishing harbours and pontoons.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "echo/chart/chart_object.hpp"
#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

// What a chart says of where craft lie.
struct MooringArea {
  std::vector<std::vector<GeoPoint>> rings;  // inside an odd number of them; closed, not repeated
  bool fishing = false;                      // else pleasure craft
  std::string name;                          // file and object, for reports
};
struct MooringPlace {
  GeoPoint place;  // of a harbour drawn as a point: reaches kPlaceReach
  bool fishing = false;
};
struct Moorings {
  std::vector<MooringArea> areas;
  std::vector<MooringPlace> places;
  std::vector<std::vector<GeoPoint>> berths;  // lines that craft lie along, within areas and places
};

inline constexpr double kPlaceReach = 250.0;  // metres; assumed

// Bounds, so that no chart makes more than a radar can use.  By area: craft are at least
// kLeastApart from each other, and an area without pontoons has one for 129 m2 in the mean.
inline constexpr std::size_t kMostCraft = 20'000;             // of a chart
inline constexpr std::size_t kMostCraftInArea = 1'000;        // of an area without pontoons
inline constexpr double kLeastApart = 4.0;                    // metres
inline constexpr std::size_t kMostMooringWork = 200'000'000;  // edges looked at, of a chart

// Craft as points of kind `craft`, each fixed by the place of its berth:
//  - along both sides of pontoons (open ones; the outside of closed ones) lower than 1.5 m;
//  - along piers and berths within an area or near a place;
//  - in areas that hold none of these, in rows along the area's longest side.
// Pleasure craft have berths every 5 m, of which 70 % are taken; fishing craft 7 m, 60 %.
// Cross-sections are log-normal with a deviation of 5 dB about 2.5 m2 (a craft of 10 m without
// reflector: SOURCES.md "Rules", MSC.192(79) table 2, unverified there) and 10 m2 (fishing,
// assumed).  Berths, occupancy and spread are ASSUMED.
// None lies on the land of `rings`.  What a bound leaves out is told to `reports`.
// The same bits on every machine.
std::vector<ChartObject> moored_craft(const Moorings& moorings,
                                      const std::vector<ChartObject>& objects,
                                      const std::vector<CoastRing>& rings, const std::string& chart,
                                      std::vector<std::string>& reports);

// Takes away craft that lie on the land of `chart`, which may be of several charts.
void remove_craft_ashore(CoastChart& chart);

}  // namespace skerry::echo
