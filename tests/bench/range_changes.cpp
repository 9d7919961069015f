// What a change of the range scale costs the sector that comes first.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "echo/radar/shipped_sets.hpp"
#include "echo/spoke_renderer.hpp"
#include "tests/bench/bench_support.hpp"
#include "tests/bench/radar_bench_parts.hpp"

namespace skerry::bench {
namespace {

constexpr int kLater = 24;  // sectors

struct Change {
  double first_ms = 0.0;   // the change and the sector behind it
  double median_ms = 0.0;  // of later sectors
  double ratio() const { return first_ms / median_ms; }
};

// One radar that goes from range to range over scenes of each.
class Ranger {
 public:
  Ranger(const scenes::NamedScene& full, const echo::RadarSet& set,
         const std::vector<echo::ScenePtr>& scenes)
      : set_(set),
        geometry_(full.geometry),
        controls_(full.controls),
        scenes_(scenes),
        renderer_(made(0)),
        video_(std::size_t{kSectorSpokes} * full.geometry.cells) {}

  // `ahead`: another has made and holds the tables, as the server has it.
  Change to(std::size_t range, bool ahead) {
    controls_.range_scale = *RangeScale::from_index(range);
    Change change;
    std::optional<echo::SpokeRenderer> holder;
    if (ahead) {
      holder.emplace(made(0));
      holder->set_controls(controls_);
      holder->render(*scenes_[range], 0, kSectorSpokes, video_);
    }
    const double begun = thread_seconds();
    renderer_.set_controls(controls_);
    make(*scenes_[range]);
    change.first_ms = 1e3 * (thread_seconds() - begun);
    std::vector<double> later;
    for (int i = 0; i < kLater; ++i) {
      const double from = thread_seconds();
      make(*scenes_[range]);
      later.push_back(1e3 * (thread_seconds() - from));
    }
    change.median_ms = median_of(later);
    return change;
  }

 private:
  echo::SpokeRenderer made(std::uint32_t radar) const {
    return {set_, geometry_, echo::SpokeClock(set_.rpm, geometry_.spokes_per_turn), radar};
  }
  void make(const echo::Scene& scene) {
    renderer_.render(scene, spoke_, kSectorSpokes, video_);
    spoke_ += kSectorSpokes;
  }

  echo::RadarSet set_;
  ScanGeometry geometry_;
  echo::ViewControls controls_;
  const std::vector<echo::ScenePtr>& scenes_;
  echo::SpokeRenderer renderer_;
  std::vector<std::uint8_t> video_;
  std::uint64_t spoke_ = 0;
};

void print_changes(const std::string& name, const std::vector<Change>& changes) {
  std::vector<double> ms, ratios;
  for (const Change& c : changes) ms.push_back(c.first_ms), ratios.push_back(c.ratio());
  fmt::print("{:<34}{:>8.2f}{:>8.2f}{:>8.2f}{:>10.1f}{:>8.1f}{:>8.1f}\n", name, median_of(ms),
             percentile_of(ms, 0.95), percentile_of(ms, 1.0), median_of(ratios),
             percentile_of(ratios, 0.95), percentile_of(ratios, 1.0));
}

}  // namespace

void range_changes(const scenes::NamedScene& full) {
  std::vector<echo::ScenePtr> scenes;
  for (std::size_t i = 0; i < RangeScale::kCount; ++i) {
    const RangeScale scale = *RangeScale::from_index(i);
    auto chart = scenes::world_chart(scenes::kBergen, scale.length() * 1.3);
    if (!chart) return;
    const echo::ScenePtr coast =
        scenes::scene_at(std::move(*chart), scenes::kBergen, scale, full.geometry, {}, 345.0);
    auto scene = std::make_shared<echo::Scene>(*full.scene);
    scene->coast = coast->coast;
    scene->index = coast->index;
    scene->structure_index = coast->structure_index;
    scene->ashore = coast->ashore;
    scenes.push_back(std::move(scene));
  }
  fmt::print(
      "\nThe first sector after a change to the next range scale, ms, and times the median one\n"
      "{:<34}{:>8}{:>8}{:>8}{:>10}{:>8}{:>8}\n",
      "", "p50", "p95", "max", "p50", "p95", "max");
  std::vector<Change> all_unready, all_ready;
  for (const echo::RadarSet& set : echo::shipped_sets()) {
    Ranger ranger(full, set, scenes);
    ranger.to(0, false);
    const auto up_and_down = [&](bool ahead) {
      std::vector<Change> changes;
      for (std::size_t i = 1; i < RangeScale::kCount; ++i) changes.push_back(ranger.to(i, ahead));
      for (std::size_t i = RangeScale::kCount - 1; i-- > 0;) changes.push_back(ranger.to(i, ahead));
      return changes;
    };
    const auto unready = up_and_down(false), ready = up_and_down(true);
    print_changes(set.name, unready);
    print_changes(set.name + ", tables made ahead", ready);
    all_unready.insert(all_unready.end(), unready.begin(), unready.end());
    all_ready.insert(all_ready.end(), ready.begin(), ready.end());
  }
  print_changes("all sets", all_unready);
  print_changes("all sets, tables made ahead", all_ready);
}

}  // namespace skerry::bench
