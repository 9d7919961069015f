#include "echo/picture_tool/captured_radars.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "echo/radar/shipped_sets.hpp"

namespace skerry::echo {
namespace {

constexpr std::array kRows = {
    CapturedRadar{"halo20-ranges", "HALO20", 3183.0, 1.72},
    CapturedRadar{"3g-trueheading", "3G", 1633.0, 1.77},
    CapturedRadar{"br24-ranges", "BR24", 1633.0, 1.77},
    CapturedRadar{"br24-ranges", "BR24", 2454.0, 1.77},
    CapturedRadar{"4g-ranges", "4G", 1809.0, 1.95},
    CapturedRadar{"4g-ranges", "4G", 2713.0, 1.95},
    CapturedRadar{"garminxhd", "xHD", 0.0, 1.125},
    CapturedRadar{"halo-velocitytrack", "HALO24", 0.0, 1.72, true},
    CapturedRadar{"halo3-5", "HALO3", 0.0, 1.72},
    CapturedRadar{"quantum2", "Quantum 2", 0.0, 2.24},
};
constexpr std::string_view kStandIn = "HALO20";

}  // namespace

std::span<const CapturedRadar> captured_radars() { return kRows; }

std::optional<CapturedRadar> captured_radar_of(const std::string& file, double reach_m) {
  const std::string name = std::filesystem::path(file).filename().string();
  std::optional<CapturedRadar> found;
  for (const CapturedRadar& row : kRows) {
    if (!name.starts_with(row.capture)) continue;
    if (!found) found = row;
    if (row.reach_m > 0.0 && std::fabs(row.reach_m - reach_m) <= 0.02 * reach_m) return row;
  }
  return found;
}

RadarSet stand_in_set(std::string_view name, std::vector<std::string>& notes) {
  for (const RadarSet& set : shipped_sets()) {
    if (set.name == name) return set;
  }
  notes.push_back(fmt::format("there is no set {}: {} stands in for it", name, kStandIn));
  return find_set(kStandIn);
}

}  // namespace skerry::echo
