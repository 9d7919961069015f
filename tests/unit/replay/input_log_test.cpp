#include "server/replay/input_log.hpp"

#include <gtest/gtest.h>

#include "server/replay/input_messages.hpp"

namespace skerry::server {
namespace {

SectorInputs some_inputs() {
  SectorInputs inputs;
  inputs.views = {{0, {}}};
  inputs.coast = std::make_shared<const CoastInSight>();
  inputs.emissions = std::make_shared<const Emissions>();
  return inputs;
}

TEST(InputLog, KeepsChangesOnly) {
  InputLog log(1, {});
  SectorInputs inputs = some_inputs();
  log.took(0, 0, inputs, false);
  const std::size_t begin = log.since(0).size();
  for (std::uint64_t first = 16; first < 1600; first += 16) log.took(0, first, inputs, false);
  EXPECT_EQ(log.since(0).size(), begin);
  inputs.views[0].controls.gain = 77.0;
  log.took(0, 1600, inputs, false);
  ASSERT_EQ(log.since(begin).size(), 1u);
  recording::Input input;
  ASSERT_TRUE(input.ParseFromString(log.since(begin)[0]));
  EXPECT_EQ(input.taken().first(), 1600u);
  EXPECT_EQ(input.taken().views(0).gain(), 77.0);
  EXPECT_FALSE(input.taken().has_controls());
  ASSERT_EQ(log.reached().size(), 1u);
  ASSERT_TRUE(input.ParseFromString(log.reached()[0]));
  EXPECT_EQ(input.reached().first(), 1600u);
}

TEST(InputLog, TellsWholeStretchesOfSkippedSectors) {
  InputLog log(1, {});
  SectorInputs inputs = some_inputs();
  log.took(0, 0, inputs, false);
  const std::size_t begin = log.since(0).size();
  for (std::uint64_t first = 16; first < 160; first += 16) log.skipped(0, first, inputs.radar);
  log.took(0, 160, inputs, false);
  ASSERT_EQ(log.since(begin).size(), 1u);
  recording::Input input;
  ASSERT_TRUE(input.ParseFromString(log.since(begin)[0]));
  EXPECT_EQ(input.skipped().first(), 16u);
  EXPECT_EQ(input.skipped().sectors(), 9u);
}

TEST(InputLog, IsBoundedAndSaysSo) {
  InputLog log(1, {});
  wire::WorldChange change;
  for (int i = 0; i < 64; ++i) change.add_rain()->set_rate_mm_h(1.0);
  for (int i = 0; i < 150'000; ++i) log.changed(1, change, Duration{});
  std::size_t bytes = 0;
  std::vector<std::string> inputs;
  for (auto some = log.since(0); !some.empty(); some = log.since(inputs.size())) {
    EXPECT_LE(some.size(), ExerciseInputs::kMostAtOnce);
    inputs.insert(inputs.end(), some.begin(), some.end());
  }
  for (const std::string& input : inputs) bytes += input.size();
  EXPECT_LE(bytes, InputLog::kMaxBytes + 16);
  recording::Input last;
  ASSERT_TRUE(last.ParseFromString(inputs.back()));
  EXPECT_TRUE(last.has_incomplete());
}

TEST(InputMessages, CarryEveryControl) {
  echo::RadarControls radar{false, echo::PulseChoice::medium_pulse, false, 31.0, 22.5, -7.25,
                            33.0,  {{10.0, 20.0}, {300.0, 5.0}}};
  EXPECT_EQ(controls_of(message_of(radar)), radar);
  ViewInForce view;
  view.number = 9;
  view.controls = {*RangeScale::find(24.0),
                   1,
                   2,
                   3,
                   4,
                   5,
                   6,
                   true,
                   true,
                   echo::Decimation::mean,
                   true,
                   7,
                   true,
                   8,
                   9,
                   10,
                   echo::DopplerMode::both,
                   1.5,
                   echo::PictureMode::buoy,
                   40'000.0};
  EXPECT_EQ(view_of(message_of(view)), view);
  recording::Input::View wrong = message_of(view);
  wrong.set_mode(6);
  EXPECT_FALSE(view_of(wrong));
  wrong = message_of(view);
  wrong.set_range_scale(100);
  EXPECT_FALSE(view_of(wrong));
}

}  // namespace
}  // namespace skerry::server
