// Many radars on one core: a sector of each by turns, or one after the other.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "echo/kernel/isa.hpp"
#include "echo/spoke_renderer.hpp"
#include "tests/bench/bench_support.hpp"
#include "tests/bench/radar_bench_parts.hpp"
#include "tests/scenes/moving_scene.hpp"

namespace skerry::bench {
namespace {

class Fleet {
 public:
  Fleet(const scenes::NamedScene& named, std::size_t radars)
      : turn_(named.geometry.spokes_per_turn),
        cells_(double{1} * turn_ * named.geometry.cells * static_cast<double>(radars)),
        clock_(named.rpm, turn_),
        scenes_(named.scene),
        video_(std::size_t{kSectorSpokes} * named.geometry.cells) {
    for (std::size_t i = 0; i < radars; ++i) {
      radars_.push_back(std::make_unique<echo::SpokeRenderer>(named.set, named.geometry, clock_,
                                                              static_cast<std::uint32_t>(i)));
      radars_.back()->set_controls(named.controls);
    }
  }

  // The next turn of all; nanoseconds a cell.
  double turn_by_sectors() {
    const auto scenes = begin_turn();
    const double begun = thread_seconds();
    for (std::size_t k = 0; k < scenes.size(); ++k)
      for (const auto& radar : radars_) make(*radar, *scenes[k], k);
    return end_turn(begun);
  }
  double turn_one_after_the_other() {
    const auto scenes = begin_turn();
    const double begun = thread_seconds();
    for (const auto& radar : radars_)
      for (std::size_t k = 0; k < scenes.size(); ++k) make(*radar, *scenes[k], k);
    return end_turn(begun);
  }

 private:
  std::vector<echo::ScenePtr> begin_turn() {
    std::vector<echo::ScenePtr> scenes;
    for (std::uint64_t spoke = first_; spoke < first_ + turn_; spoke += kSectorSpokes)
      scenes.push_back(scenes_.at(clock_.time_of(spoke)));
    return scenes;
  }
  void make(echo::SpokeRenderer& radar, const echo::Scene& scene, std::size_t sector) {
    radar.render(scene, first_ + sector * kSectorSpokes, kSectorSpokes, video_);
  }
  double end_turn(double begun) {
    first_ += turn_;
    return 1e9 * (thread_seconds() - begun) / cells_;
  }

  std::uint32_t turn_;
  double cells_;
  echo::SpokeClock clock_;
  scenes::MovingScene scenes_;
  std::vector<std::uint8_t> video_;
  std::vector<std::unique_ptr<echo::SpokeRenderer>> radars_;
  std::uint64_t first_ = 0;
};

}  // namespace

void by_turns(const scenes::NamedScene& full, std::size_t radars, int turns) {
  Fleet fleet(full, radars);
  fleet.turn_one_after_the_other();  // to fill what is kept
  std::vector<double> sectors, whole, ratios;
  for (int i = 0; i < turns; ++i) {
    whole.push_back(fleet.turn_one_after_the_other());
    sectors.push_back(fleet.turn_by_sectors());
    ratios.push_back(sectors.back() / whole.back());
  }
  const double cells_per_second =
      1.0 * full.geometry.spokes_per_turn * full.geometry.cells * full.rpm / 60.0;
  const auto carried = [&](double ns) { return 1e9 / (ns * cells_per_second); };
  const double by_sector = median_of(sectors), by_turn = median_of(whole);
  fmt::print("{:<10}{:>8}{:>14.2f}{:>14.2f}{:>10.2f}{:>12.0f}{:>10.0f}\n",
             echo::name_of(echo::active_isa()), radars, by_turn, by_sector, median_of(ratios),
             carried(by_turn), carried(by_sector));
}

}  // namespace skerry::bench
