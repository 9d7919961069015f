// The targets of MSC.192(79) table 2.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::validation {

struct Table2Target {
  std::string name;
  double x_nm = 0.0, s_nm = 0.0;  // range of first detection
  // Puts it into an empty scene, that far from the own ship on that bearing.
  std::function<void(echo::Scene&, double range_m, double bearing_deg)> put;

  double range_nm(echo::Band band) const { return band == echo::Band::x ? x_nm : s_nm; }
};

std::vector<std::string> table2_names();
// Requires a name of table2_names().
Table2Target table2_target(const std::string& name);

// The shortest range scale on which that range is shown.
RangeScale scale_for(double range_m);

}  // namespace skerry::validation
