// What native clients are told where they get no chart.  A relay knows by it why it got none.
#pragma once

#include <string_view>

namespace skerry::server {

inline constexpr std::string_view kChartBusy = "chart: too many ask at once; ask again";
inline constexpr std::string_view kNoChartHere = "chart: the server has no chart here";
// By one connection, before the answer to what it asked for last.
inline constexpr std::string_view kCoastlineAsked =
    "coastline: one was asked for and has not come yet; ask when it has";
inline constexpr std::string_view kChartObjectsAsked =
    "chart objects: they were asked for and have not come yet; ask when they have";

}  // namespace skerry::server
