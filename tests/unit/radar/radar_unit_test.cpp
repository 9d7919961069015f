// A radar under way: what is changed on it while it turns.
#include "server/radar/radar_unit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {
namespace {

// Spokes of a view as they are published.
class Record {
 public:
  SectorEncoder encoder() {
    return [this](const Sector& sector) -> EncodedSectorPtr {
      const std::lock_guard lock(mutex_);
      spokes_.insert(spokes_.end(), sector.spokes.begin(), sector.spokes.end());
      more_.notify_all();
      return std::make_shared<EncodedSector>();
    };
  }
  std::size_t wait_for(std::size_t spokes) {
    std::unique_lock lock(mutex_);
    more_.wait_for(lock, std::chrono::seconds(60), [&] { return spokes_.size() >= spokes; });
    return spokes_.size();
  }
  std::vector<SpokePtr> spokes() {
    const std::lock_guard lock(mutex_);
    return spokes_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable more_;
  std::vector<SpokePtr> spokes_;
};

class RunningRadar : public testing::Test {
 protected:
  static constexpr std::uint32_t kSpokes = 512, kCells = 256;

  static scenario::Scenario scenario() {
    return parse_scenario(
        "name: s\nseed: 3\nown_ships:\n"
        "  - {name: F, position: {lat: 60, lon: 5}, radars: [{range_nm: 3}]}\n",
        "f");
  }
  static RadarConfig config() {
    RadarConfig made;
    made.geometry = {kSpokes, kCells, 8};
    made.controls.range_scale = *RangeScale::find(3.0);
    made.controls.gain = 95.0;  // noise shows
    made.controls.sea = 0.0;
    made.radar_controls.rotation_rpm = 60.0;
    return made;
  }
  RunningRadar()
      : timeline_(World(scenario())),
        coast_(std::make_unique<OpenSea>(), 1, {}),
        airwaves_(1),
        unit_(config(), timeline_, coast_, airwaves_, 0) {
    coast_.prepare_now(
        0, unit_.wish(timeline_.latest()->own_ships[0], unit_.config().controls.range_scale));
    FormatRing& ring = unit_.views().find(0)->channel.add_format("record", record_.encoder());
    reader_ = ring.on_publish([] {});
  }
  void start() {
    unit_.warm_up();
    unit_.start({std::chrono::steady_clock::now(), UtcTime{}});
  }
  ~RunningRadar() override {
    unit_.stop();
    reader_.reset();
  }

  Timeline timeline_;
  CoastService coast_;
  Airwaves airwaves_;
  Record record_;
  RadarUnit unit_;
  FormatRing::Registration reader_;
};

TEST_F(RunningRadar, TurnsAtAnotherRateWithoutLosingOrRepeatingASpoke) {
  start();
  record_.wait_for(128);
  echo::RadarControls controls = unit_.radar_controls();
  controls.rotation_rpm = 30.0;
  unit_.set_radar_controls(controls);
  const std::size_t before = record_.spokes().size();
  ASSERT_GE(record_.wait_for(before + 128), before + 128);
  unit_.stop();

  const auto spokes = record_.spokes();
  const bool unbroken = unit_.counters().sectors_skipped == 0;
  const auto step = [&](std::size_t i) {
    return spokes[i + 1]->header.scenario_time - spokes[i]->header.scenario_time;
  };
  for (std::size_t i = 0; i + 1 < spokes.size(); ++i) {
    const SpokeHeader &one = spokes[i]->header, &next = spokes[i + 1]->header;
    ASSERT_EQ(next.sequence, one.sequence + 1);
    // A machine that is late leaves whole sectors out.
    ASSERT_EQ((next.index - one.index - 1) % RadarUnit::kSectorSpokes, 0u) << "after " << i;
    if (unbroken) {
      ASSERT_EQ(next.index, (one.index + 1) % kSpokes) << "after " << i;
    }
    ASSERT_GT(next.scenario_time, one.scenario_time);
  }
  EXPECT_NEAR(in_seconds(step(0)), 60.0 / (60.0 * kSpokes), 2e-9);
  EXPECT_NEAR(in_seconds(step(spokes.size() - 2)), 60.0 / (30.0 * kSpokes), 2e-9);
}

TEST_F(RunningRadar, WhatAnotherHostMakesIsCountedAndNotMade) {
  unit_.make_spokes_until({});
  start();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  EXPECT_EQ(record_.spokes().size(), 0u);
  EXPECT_GT(unit_.counters().sectors, 2u);
  EXPECT_EQ(unit_.counters().sectors_skipped, 0u);
  unit_.make_spokes_until(std::chrono::steady_clock::now() + std::chrono::hours(1));
  record_.wait_for(64);
  const SpokeHeader first = record_.spokes().front()->header;
  EXPECT_GT(first.scenario_time, ScenarioTime(std::chrono::milliseconds(300)));
  EXPECT_EQ(first.sequence % RadarUnit::kSectorSpokes, 0u);
  EXPECT_EQ(first.sequence, std::uint64_t{first.scan} * kSpokes + first.index)
      << "as if it had made all";
  unit_.make_spokes_until(std::chrono::steady_clock::now());
  const std::size_t made = record_.spokes().size();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LE(record_.spokes().size(), made + RadarUnit::kSectorSpokes);
}

TEST_F(RunningRadar, HiddenViewsSayHowFarTheyReach) {
  Record hidden;
  FormatRing::Registration reads;
  const RadarViewPtr view = unit_.views().open(0, true, [&](VideoChannel& channel) {
    reads = channel.add_format("record", hidden.encoder()).on_publish([] {});
  });
  echo::ViewControls controls = view->controls_in_force();
  controls.instrumented_range_m = 8000.0;
  view->set_controls(controls);
  start();
  record_.wait_for(32);
  ASSERT_GE(hidden.wait_for(32), 32u);
  unit_.stop();
  const SpokeHeader &seen = hidden.spokes().front()->header,
                    &own = record_.spokes().front()->header;
  EXPECT_EQ(seen.view, view->number);
  EXPECT_EQ(seen.range_scale, own.range_scale);
  EXPECT_DOUBLE_EQ(seen.reach().in_metres(), 8000.0);
  EXPECT_DOUBLE_EQ(own.reach().in_metres(), 3.0 * 1852.0);
  EXPECT_EQ(own.instrumented_range.in_metres(), 0.0);
  reads.reset();
}

TEST_F(RunningRadar, TellsTheCoastHowFarItsViewsReach) {
  const ShipState ship = timeline_.latest()->own_ships[0];
  const RadarViewPtr view = unit_.views().open(0, true, [](VideoChannel&) {});
  echo::ViewControls controls = view->controls_in_force();
  const double scale = controls.range_scale.length().in_metres();
  EXPECT_EQ(unit_.wish(ship, controls.range_scale).resolution.range_m, scale);
  controls.instrumented_range_m = 1.9 * scale;
  view->set_controls(controls);
  EXPECT_EQ(unit_.wish(ship, controls.range_scale).resolution.range_m, 2.0 * scale);
  controls.range_scale = *RangeScale::find(96.0);
  controls.instrumented_range_m = 190.0 * 1852.0;
  view->set_controls(controls);
  EXPECT_EQ(unit_.wish(ship, controls.range_scale).resolution.range_m, 96.0 * 1852.0);
}

}  // namespace
}  // namespace skerry::server
