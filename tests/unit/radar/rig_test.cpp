// Alignment, blanked sectors and antenna height of a radar under way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <vector>

#include "server/radar/view_renderers.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::server {
namespace {

// A turn of the made-up islands, with another rig from some spoke on.
class Rig : public testing::Test {
 protected:
  static scenes::NamedScene islands() {
    for (scenes::NamedScene& named : scenes::made_up_scenes()) {
      if (named.name == "islands") return std::move(named);
    }
    throw std::logic_error("there is no scene of islands");
  }
  const scenes::NamedScene islands_ = islands();
  const std::uint32_t turn_ = islands_.geometry.spokes_per_turn;
  const std::uint32_t cells_ = islands_.geometry.cells;
  const echo::SpokeClock clock_{24.0, turn_};

  ViewRenderers renderers() const {
    return {islands_.set, islands_.geometry, clock_, 0, islands_.controls.range_scale,
            {},           echo::serial_for};
  }
  std::shared_ptr<echo::Scene> scene() const {
    return std::make_shared<echo::Scene>(*islands_.scene);
  }
  void render(ViewRenderers& made, const echo::Scene& scene, std::uint64_t first,
              std::uint64_t count, std::vector<std::uint8_t>& video) const {
    made.set_view(0, islands_.controls);
    for (std::uint64_t at = first; at < first + count; at += 16) {
      made.render(scene, at, 16);
      video.insert(video.end(), made.video(0).begin(), made.video(0).end());
    }
  }
  static double mean(std::span<const std::uint8_t> video) {
    return std::accumulate(video.begin(), video.end(), 0.0) / static_cast<double>(video.size());
  }
  // How much two pictures have in common, of spokes `a` on and `b` on: correlation of their cells.
  double likeness(const std::vector<std::uint8_t>& one, std::size_t a,
                  const std::vector<std::uint8_t>& other, std::size_t b, std::size_t spokes) const {
    double xx = 0.0, yy = 0.0, xy = 0.0, x = 0.0, y = 0.0;
    const std::size_t n = spokes * cells_;
    for (std::size_t i = 0; i < n; ++i) {
      const double p = one[a * cells_ + i], q = other[b * cells_ + i];
      x += p, y += q, xx += p * p, yy += q * q, xy += p * q;
    }
    const auto count = static_cast<double>(n);
    return (xy - x * y / count) / std::sqrt((xx - x * x / count) * (yy - y * y / count));
  }
};

TEST_F(Rig, AlignmentTurnsThePictureClockwise) {
  const std::uint32_t shift = turn_ / 16;  // 22.5 deg
  std::vector<std::uint8_t> straight, turned;
  ViewRenderers one = renderers();
  render(one, *scene(), 0, turn_ / 4, straight);
  const auto other = scene();
  other->bearing_alignment_deg = 22.5;
  ViewRenderers two = renderers();
  render(two, *other, 0, turn_ / 4, turned);
  EXPECT_GT(likeness(straight, 0, turned, shift, turn_ / 8), 0.9);
  EXPECT_LT(likeness(straight, 0, turned, 0, turn_ / 8), 0.5);
}

TEST_F(Rig, AlignmentMayChangeUnderWay) {
  const auto other = scene();
  other->bearing_alignment_deg = -37.0;
  std::vector<std::uint8_t> changed, fresh;
  ViewRenderers made = renderers();
  render(made, *scene(), 0, 64, changed);
  changed.clear();
  render(made, *other, 64, turn_ / 8, changed);
  ViewRenderers anew = renderers();
  render(anew, *other, 64, turn_ / 8, fresh);
  EXPECT_GT(likeness(changed, 0, fresh, 0, turn_ / 8), 0.98);
}

TEST_F(Rig, NothingEchoesInABlankedSector) {
  const auto other = scene();
  other->blanked = {{0.0, 11.25}};
  std::vector<std::uint8_t> open, blanked;
  ViewRenderers made = renderers();
  render(made, *scene(), 0, turn_ / 16, open);
  ViewRenderers same = renderers();
  render(same, *other, 0, turn_ / 16, blanked);
  const std::size_t half = open.size() / 2;
  EXPECT_GT(mean(std::span(open).first(half)), 5.0);
  EXPECT_LT(mean(std::span(blanked).first(half - cells_)), 0.1);
  EXPECT_GT(mean(std::span(blanked).subspan(half + cells_)), 5.0);
}

TEST_F(Rig, AHigherAntennaSeesFartherFromTheNextSectorOn) {
  const auto far = std::make_shared<echo::Scene>(
      *scenes::scene_at({}, scenes::kBergen, *RangeScale::find(24.0), islands_.geometry));
  echo::Hull boat;
  boat.centre = {0.0, 20.0 * 1852.0};
  boat.length_m = 30.0, boat.beam_m = 8.0, boat.height_m = 4.0;
  boat.identity = 9;
  boat.cross_section_m2 = 3e4;
  far->hulls = {boat};
  echo::ViewControls controls;
  controls.range_scale = *RangeScale::find(24.0);
  controls.gain = 60.0;
  ViewRenderers made(islands_.set, islands_.geometry, clock_, 0, controls.range_scale, {},
                     echo::serial_for);
  made.set_view(0, controls);
  const auto strongest = [&](std::uint64_t first) {
    made.render(*far, first, 16);
    const auto video = made.video(0);
    return *std::max_element(video.begin() + 300, video.end());
  };
  const int low = strongest(0);
  echo::RadarControls higher;
  higher.antenna_height_m = 95.0;
  made.set_radar(controls.range_scale, higher, clock_);
  const int high = strongest(turn_);
  EXPECT_GT(high, low + 40);
}

// Another rate makes the returns anew; what a receiver has learnt goes on.
TEST_F(Rig, AnotherRateKeepsThePicture) {
  std::vector<std::uint8_t> changed, same;
  ViewRenderers made = renderers(), plain = renderers();
  render(made, *scene(), 0, 64, changed);
  render(plain, *scene(), 0, 128, same);
  echo::SpokeClock faster = clock_;
  faster.change_rate(64, 36.0);
  made.set_radar(islands_.controls.range_scale, {}, faster);
  render(made, *scene(), 64, 64, changed);
  EXPECT_GT(likeness(changed, 64, same, 64, 64), 0.9);
}

}  // namespace
}  // namespace skerry::server
