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
      : controls_(full.controls),
        scenes_(scenes),
        renderer_(set, full.geometry, echo::SpokeClock(set.rpm, full.geometry.spokes_per_turn), 0),
        video_(std::size_t{kSectorSpokes} * full.geometry.cells) {}

  Change to(std::size_t range) {
    controls_.range_scale = *RangeScale::from_index(range);
    Change change;
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
  void make(const echo::Scene& scene) {
    renderer_.render(scene, spoke_, kSectorSpokes, video_);
    spoke_ += kSectorSpokes;
  }

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
  std::vector<Change> all_first, all_again;
  for (const echo::RadarSet& set : echo::shipped_sets()) {
    Ranger ranger(full, set, scenes);
    ranger.to(0);
    std::vector<Change> first, again;
    for (std::size_t i = 1; i < RangeScale::kCount; ++i) first.push_back(ranger.to(i));
    for (std::size_t i = RangeScale::kCount - 1; i-- > 0;) again.push_back(ranger.to(i));
    for (std::size_t i = 1; i < RangeScale::kCount; ++i) again.push_back(ranger.to(i));
    print_changes(set.name + ", first time", first);
    print_changes(set.name + ", again", again);
    all_first.insert(all_first.end(), first.begin(), first.end());
    all_again.insert(all_again.end(), again.begin(), again.end());
  }
  print_changes("all sets, first time", all_first);
  print_changes("all sets, again", all_again);
}

}  // namespace skerry::bench
