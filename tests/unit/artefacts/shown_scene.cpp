#include "tests/unit/artefacts/shown_scene.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace skerry {

ShownScene::ShownScene(const scenes::ArtefactScene& scene)
    : geometry_(scene.with.geometry),
      scale_(scene.with.controls.range_scale),
      cell_m_(geometry_.cell_size(scale_).in_metres()) {
  const auto turn_of = [&](const echo::ScenePtr& which) {
    scenes::NamedScene named = scene.with;
    named.scene = which;
    auto video = scenes::render_scans(named, scene.scan + 1);
    const std::size_t turn = std::size_t{geometry_.spokes_per_turn} * geometry_.cells;
    video.erase(video.begin(), video.end() - static_cast<std::ptrdiff_t>(turn));
    return video;
  };
  with_ = turn_of(scene.with.scene);
  without_ = turn_of(scene.without);
}

std::vector<Difference> ShownScene::differences() const {
  std::vector<Difference> found;
  for (std::uint32_t spoke = 0; spoke < geometry_.spokes_per_turn; ++spoke) {
    for (std::uint32_t cell = 0; cell < geometry_.cells; ++cell) {
      const int gained = level(spoke, cell) - level(spoke, cell, false);
      if (gained != 0)
        found.push_back(
            {360.0 * spoke / geometry_.spokes_per_turn, (cell + 0.5) * cell_m_, gained});
    }
  }
  return found;
}

std::uint32_t ShownScene::spoke_at(double bearing_deg) const {
  const double turns = bearing_deg / 360.0;
  const auto spoke = std::lround((turns - std::floor(turns)) * geometry_.spokes_per_turn);
  return static_cast<std::uint32_t>(spoke) % geometry_.spokes_per_turn;
}

template <typename Visit>
void ShownScene::visit(double middle_deg, double half_deg, double from_m, double to_m, bool with,
                       Visit&& each) const {
  const double step = 360.0 / geometry_.spokes_per_turn;
  for (double off = -half_deg; off <= half_deg; off += step) {
    const std::uint32_t spoke = spoke_at(middle_deg + off);
    const std::uint32_t end = std::min(cell_at(to_m), geometry_.cells - 1);
    for (std::uint32_t cell = cell_at(from_m); cell <= end; ++cell) each(level(spoke, cell, with));
  }
}

double ShownScene::mean(double middle_deg, double half_deg, double from_m, double to_m,
                        bool with) const {
  double sum = 0.0;
  std::size_t count = 0;
  visit(middle_deg, half_deg, from_m, to_m, with, [&](int level) {
    sum += level;
    ++count;
  });
  return sum / static_cast<double>(count);
}

int ShownScene::peak(double middle_deg, double half_deg, double from_m, double to_m,
                     bool with) const {
  int most = 0;
  visit(middle_deg, half_deg, from_m, to_m, with, [&](int level) { most = std::max(most, level); });
  return most;
}

const ShownScene& shown(const std::string& name) {
  static std::map<std::string, ShownScene> rendered;
  const auto found = rendered.find(name);
  if (found != rendered.end()) return found->second;
  return rendered.emplace(name, ShownScene(scenes::artefact_scene(name))).first->second;
}

}  // namespace skerry
