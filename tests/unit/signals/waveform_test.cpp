#include "clients/signals/waveform.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/signals/synthetic_recording.hpp"

namespace skerry::client {
namespace {

using namespace testing_signals;

// Fills it in blocks whose lengths are taken by turns.
std::vector<std::int16_t> filled(Waveform& waveform, const std::vector<std::size_t>& blocks) {
  std::vector<std::int16_t> all;
  const std::size_t channels = waveform.channels().size();
  for (std::size_t k = 0; all.size() < waveform.samples() * channels; ++k) {
    const std::uint64_t first = all.size() / channels;
    const std::size_t count =
        std::min<std::uint64_t>(blocks[k % blocks.size()], waveform.samples() - first);
    std::vector<std::int16_t> block(count * channels, -1);
    waveform.fill(first, block);
    all.insert(all.end(), block.begin(), block.end());
  }
  return all;
}

TEST(Waveform, EverySampleIsTheStrongestOfItsTicksAtAnyRate) {
  const SignalRecording recording = make_recording();
  for (const std::uint32_t rate :
       {20'000'000u, 10'000'000u, 7'000'000u, 2'000'000u, 1'999'993u, 192'000u, 44'100u}) {
    Waveform waveform(recording, kAll, rate);
    const std::vector<std::int16_t> samples = filled(waveform, {1 << 16});
    for (std::size_t c = 0; c < kAll.size(); ++c) {
      const auto expected = expected_samples(recording, kAll[c], rate);
      ASSERT_EQ(waveform.samples(), expected.size()) << rate;
      std::size_t wrong = 0;
      for (std::size_t m = 0; m < expected.size(); ++m) {
        wrong += samples[m * kAll.size() + c] != expected[m];
      }
      EXPECT_EQ(wrong, 0u) << channel_name(kAll[c]) << " at " << rate;
    }
  }
}

TEST(Waveform, IsTheSameByBlocksOfAnySize) {
  const SignalRecording recording = make_recording();
  for (const std::uint32_t rate : {20'000'000u, 1'999'993u, 44'100u}) {
    Waveform waveform(recording, kAll, rate);
    const auto whole = filled(waveform, {1 << 16});
    EXPECT_EQ(filled(waveform, {1, 2, 3, 57, 1000, 4999}), whole) << rate;
  }
}

TEST(Waveform, NoPulseIsLostNorMergedAtAnyRateItAccepts) {
  const SignalRecording recording = make_recording();
  for (std::uint32_t rate = 7'000; rate <= 20'000'000; rate += rate / 7) {
    Waveform waveform(recording, {SignalChannel::trigger, SignalChannel::acp}, rate);
    const auto samples = filled(waveform, {1 << 16});
    for (std::size_t c = 0; c < 2; ++c) {
      const auto line = c == 0 ? board::Line::trigger : board::Line::acp;
      const auto edges = std::count_if(recording.edges.begin(), recording.edges.end(),
                                       [&](const board::Edge& e) { return e.line == line; });
      std::ptrdiff_t rises = samples[c] > 0 ? 1 : 0;
      for (std::size_t k = c + 2; k < samples.size(); k += 2) {
        rises += samples[k] > 0 && samples[k - 2] == 0;
      }
      EXPECT_EQ(rises, edges) << line_name(line) << " at " << rate;
    }
  }
}

TEST(Waveform, RefusesARateAtWhichPulsesWouldMergeAndNamesOneThatDoes) {
  SignalRecording recording = make_recording();
  recording.edges = {{recording.from_tick + 5, board::Line::acp},
                     {recording.from_tick + 1005, board::Line::acp}};
  try {
    Waveform waveform(recording, {SignalChannel::acp}, 30'000);
    FAIL() << "50 us are 1.5 samples";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "two acp pulses 50.000 us apart fall together at 30000 samples/s; "
                 "40000 samples/s keep them apart");
  }
  EXPECT_NO_THROW(Waveform(recording, {SignalChannel::acp}, 40'000));
}

TEST(PulseTrain, APulseEndsBeforeTheNextEdgeAndAtTheEndOfTheRecording) {
  SignalRecording recording = make_recording();
  const std::uint64_t from = recording.from_tick;
  recording.to_tick = from + 100;
  recording.edges = {{from, board::Line::acp},
                     {from + 12, board::Line::acp},
                     {from + 14, board::Line::acp},
                     {from + 90, board::Line::acp}};
  const SampleGrid grid(20'000'000, 20'000'000, 100);
  EXPECT_THAT(pulses_of(recording, board::Line::acp, grid),
              testing::ElementsAre(Pulse{0, 11}, Pulse{12, 13}, Pulse{14, 34}, Pulse{90, 100}));
  recording.edges[2].tick = from + 13;
  EXPECT_THROW(pulses_of(recording, board::Line::acp, grid), std::runtime_error);
}

TEST(PulseTrain, APulseLastsAMicrosecondOrATick) {
  EXPECT_EQ(pulse_ticks(20'000'000), 20u);
  EXPECT_EQ(pulse_ticks(125'000'000), 125u);
  EXPECT_EQ(pulse_ticks(60'000'000), 60u);
  EXPECT_EQ(pulse_ticks(100'000), 1u);
}

TEST(VideoTrack, FullScaleIsLeftJustifiedAndExact) {
  const board::ChannelFormat twelve{.samples = 2, .bits = 12};
  EXPECT_EQ(full_scale(0, twelve), 0);
  EXPECT_EQ(full_scale(1, twelve), 8);
  EXPECT_EQ(full_scale(4095, twelve), 32760);
  const board::ChannelFormat eight{.samples = 2, .bits = 8, .inverted = true};
  EXPECT_EQ(full_scale(255, eight), 32640);
  EXPECT_EQ(board::blank_code(eight), 255);
  EXPECT_EQ(board::blank_code(twelve), 0);
  const board::ChannelFormat sum{
      .samples = 2, .decimation = 4, .bits = 14, .mode = board::DecimationMode::sum};
  EXPECT_EQ(code_bits(sum), 16u);
  EXPECT_EQ(full_scale(65532, sum), 32766);
}

TEST(SampleGrid, CountsExactlyOverAMonth) {
  const std::uint64_t month = 30ull * 86'400 * 60'000'000;
  const SampleGrid grid(60'000'000, 44'100, month);
  EXPECT_EQ(grid.samples(), 30ull * 86'400 * 44'100);
  EXPECT_EQ(grid.index(month - 1), grid.samples() - 1);
  for (std::uint64_t m = grid.samples() - 5000; m < grid.samples(); ++m) {
    ASSERT_EQ(grid.index(grid.first_tick(m)), m);
    ASSERT_EQ(grid.index(grid.first_tick(m) - 1), m - 1);
  }
}

}  // namespace
}  // namespace skerry::client
