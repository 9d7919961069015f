// Charts for tests: made up, and the real one where it is installed.
#pragma once

#include <optional>

#include "echo/chart/coast_chart.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::scenes {

// Places the tests keep coming back to; all afloat.
inline constexpr GeoPoint kBergen{60.27, 5.15};
inline constexpr GeoPoint kEastOfTheAntimeridian{-16.75, -179.90};
inline constexpr GeoPoint kWestOfTheAntimeridian{-16.75, 179.85};
inline constexpr GeoPoint kEightyNorth{80.0, 16.0};

// `islands` islands around `centre`, within `radius`, from a seed: closed rings of straight edges,
// land on the left.  They may overlap where there are many; `centre` itself lies in water.
echo::CoastChart made_up_chart(GeoPoint centre, Length radius, int islands, std::uint64_t seed);

// The GSHHG window, or nothing where no chart is installed.
std::optional<echo::CoastChart> world_chart(GeoPoint centre, Length radius);

}  // namespace skerry::scenes
