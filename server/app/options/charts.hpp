// The charts a server is started with.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"

namespace skerry::server {

// `charts`, each over those after it, all over the finest GSHHG file installed (unless one of them
// is GSHHG, or none is installed), with the heights of `elevation` unless it is empty.  What of
// them cannot be used is logged as warnings.
// Error: std::runtime_error naming the file and what is wrong; without any chart, which package
// brings one.
std::unique_ptr<const echo::ChartSource> open_charts(const std::vector<std::string>& charts,
                                                     const std::string& elevation);

}  // namespace skerry::server
