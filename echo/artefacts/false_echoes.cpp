#include "echo/artefacts/false_echoes.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "echo/artefacts/indirect_echoes.hpp"
#include "echo/artefacts/multiple_echoes.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

// The main lobe's first null lies 1.25 beam widths off the axis (beam.hpp).
constexpr double kLobe = 1.3;

// The `most` strongest, in their order.
void keep_strongest(std::vector<PointEcho>& echoes, std::size_t most) {
  if (echoes.size() <= most) return;
  std::vector<float> powers;
  for (const PointEcho& echo : echoes) powers.push_back(echo.power);
  std::nth_element(powers.begin(), powers.begin() + static_cast<std::ptrdiff_t>(most), powers.end(),
                   std::greater<>());
  const float least = powers[most];
  std::erase_if(echoes, [&](const PointEcho& echo) { return echo.power <= least; });
}

}  // namespace

FalseEchoes::FalseEchoes(const RadarModel& model)
    : model_(model),
      reach_units_(static_cast<std::uint32_t>(std::min(90.0, kLobe * model.set.beam_width_deg) *
                                              kUnitsPerDegree)) {}

void FalseEchoes::add(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
                      std::span<const PointEcho> seen, std::span<const PointEcho> strong,
                      std::vector<PointEcho>& out) const {
  const bool multiple = scene.artefacts.multiple_echoes && (!seen.empty() || scene.structure_index);
  const bool indirect =
      scene.artefacts.indirect_echoes && !scene.obstructions.empty() && !strong.empty();
  if (!multiple && !indirect) return;
  const BearingSpan where{first.plane_units - reach_units_,
                          last.plane_units - first.plane_units + 2 * reach_units_};
  std::vector<PointEcho> found;
  if (multiple) {
    add_multiple_echoes(model_, scene, first, where, seen, found);
    add_bridge_echoes(model_, scene, first, where, found);
  }
  if (indirect) {
    const std::uint32_t bow = first.plane_units - first.relative_units;
    const auto turned = static_cast<std::int32_t>(last.plane_units - last.relative_units - bow) / 2;
    add_indirect_echoes(scene, bow + static_cast<std::uint32_t>(turned), where, strong, found);
  }
  keep_strongest(found, kMostEchoes);
  out.insert(out.end(), found.begin(), found.end());
}

}  // namespace skerry::echo
