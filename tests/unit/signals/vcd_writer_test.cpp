#include "clients/signals/vcd_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "tests/unit/signals/outside_tool.hpp"
#include "tests/unit/signals/synthetic_recording.hpp"

namespace skerry::client {
namespace {

using namespace testing_signals;
using testing::HasSubstr;

struct SigrokTicks {
  std::uint64_t samples_per_second = 0;
  std::vector<std::uint8_t> bytes;  // of every tick one or more, bit 0 of the first: first wire
};

SigrokTicks read_by_sigrok(const std::string& path, std::uint64_t downsample) {
  const ToolOutput sigrok = run_tool("sigrok-cli -I vcd:downsample=" + std::to_string(downsample) +
                                     " -i " + path + " -O binary 2>/dev/null");
  EXPECT_EQ(sigrok.code, 0);
  // "META samplerate: 20000000", then the samples.
  const std::string text = sigrok.text();
  const std::string head = "META samplerate: ";
  if (text.compare(0, head.size(), head) != 0) return {};
  const std::size_t end = text.find('\n');
  return {std::stoull(text.substr(head.size(), end)),
          {sigrok.out.begin() + static_cast<std::ptrdiff_t>(end + 1), sigrok.out.end()}};
}

struct Clock {
  std::uint32_t hz;
  const char* unit;
  friend void PrintTo(const Clock& clock, std::ostream* out) { *out << clock.hz << " Hz"; }
};
class VcdOfClock : public testing::TestWithParam<Clock> {};

TEST_P(VcdOfClock, SigrokReadsEveryEdgeAtItsTick) {
  if (!is_installed("sigrok-cli")) FAIL() << "sigrok-cli is not installed; tests/run installs it";
  const SignalRecording recording = make_recording({.clock_hz = GetParam().hz});
  Folder folder;
  const std::string path = folder / "signals.vcd";
  const SignalFile file = write_vcd(path, recording, false, kAlways);
  EXPECT_EQ(file.bytes, std::filesystem::file_size(path));
  EXPECT_THAT(text_of_file(path), HasSubstr(std::string("$timescale ") + GetParam().unit));
  const VcdTimescale time = vcd_timescale(GetParam().hz);
  const auto [samples_per_second, ticks] = read_by_sigrok(path, time.downsample());
  if (time.exact()) {
    EXPECT_EQ(samples_per_second, GetParam().hz);
  }
  ASSERT_EQ(ticks.size(), recording.ticks());
  for (unsigned wire = 0; wire < 4; ++wire) {
    const auto channel = static_cast<SignalChannel>(wire + 2);
    const auto expected = tick_levels(recording, channel);
    std::size_t wrong = 0, rises = 0;
    for (std::size_t t = 0; t < ticks.size(); ++t) {
      const unsigned level = (ticks[t] >> wire) & 1u;
      wrong += level != expected[t];
      rises += level == 1 && (t == 0 || ((ticks[t - 1] >> wire) & 1u) == 0);
    }
    EXPECT_EQ(wrong, 0u) << channel_name(channel);
    EXPECT_EQ(rises, static_cast<std::size_t>(std::count_if(
                         recording.edges.begin(), recording.edges.end(), [&](const auto& edge) {
                           return static_cast<unsigned>(edge.line) == wire;
                         })));
  }
}

// 60 MHz and 33 MHz have no period in whole femtoseconds.
INSTANTIATE_TEST_SUITE_P(Clocks, VcdOfClock,
                         testing::Values(Clock{20'000'000, "1 ns"}, Clock{125'000'000, "1 ns"},
                                         Clock{100'000'000, "1 ns"}, Clock{64'000'000, "1 ps"},
                                         Clock{60'000'000, "1 fs"}, Clock{33'000'000, "1 fs"}));

TEST(VcdWriter, SigrokReadsEveryVideoCode) {
  if (!is_installed("sigrok-cli")) FAIL() << "sigrok-cli is not installed; tests/run installs it";
  const SignalRecording recording = make_recording();
  Folder folder;
  const std::string path = folder / "signals.vcd";
  write_vcd(path, recording, true, kAlways);
  const auto bytes = read_by_sigrok(path, 50).bytes;
  ASSERT_EQ(bytes.size(), 3 * recording.ticks());  // 4 wires, 12 and 8 bits
  const auto a = tick_levels(recording, SignalChannel::video_a);
  const auto b = tick_levels(recording, SignalChannel::video_b);
  const auto trigger = tick_levels(recording, SignalChannel::trigger);
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < recording.ticks(); ++t) {
    const std::uint32_t all = bytes[3 * t] | bytes[3 * t + 1] << 8 | bytes[3 * t + 2] << 16;
    std::uint32_t reversed = 0;  // video's highest bit comes first
    for (unsigned bit = 0; bit < 24; ++bit) reversed |= ((all >> bit) & 1u) << (23 - bit);
    wrong +=
        (all & 1u) != trigger[t] || ((reversed >> 8) & 0xFFF) != a[t] || (reversed & 0xFF) != b[t];
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(VcdWriter, TimesAreWithinHalfAFemtosecondForEver) {
  for (const std::uint32_t clock : {60'000'000u, 33'000'000u, 77'777'777u}) {
    const VcdTimescale time = vcd_timescale(clock);
    EXPECT_FALSE(time.exact());
    EXPECT_STREQ(time.unit, "1 fs");
    for (std::uint64_t tick = 1; tick < 1'000'000'000'000; tick = tick * 3 + 1) {
      // |time - tick * 1e15 / clock| <= 1/2, in integers.
      const auto twice = static_cast<__int128>(time.time_of(tick)) * clock * 2 -
                         static_cast<__int128>(tick) * 2'000'000'000'000'000;
      EXPECT_LE(twice < 0 ? -twice : twice, clock) << tick;
    }
  }
  const VcdTimescale exact = vcd_timescale(64'000'000);
  EXPECT_TRUE(exact.exact());
  EXPECT_EQ(exact.time_of(64'000'000ull * 3600), 3'600'000'000'000'000u);
}

TEST(VcdWriter, BeginsAtTimeZeroWithEveryValueAndEndsAtTheLastTick) {
  SignalRecording recording = make_recording({.ticks = 1000, .trigger_ticks = 2000});
  recording.edges = {{recording.from_tick, board::Line::arp}};
  recording.source = "a $end of it\n";
  Folder folder;
  write_vcd(folder / "f.vcd", recording, false, kAlways);
  EXPECT_EQ(text_of_file(folder / "f.vcd"),
            "$version skerry $end\n"
            "$comment a _end of it? $end\n"
            "$comment sample clock 20000000 Hz, first tick 1234567890123, one sample per tick: "
            "sigrok-cli -I vcd:downsample=50 $end\n"
            "$timescale 1 ns $end\n"
            "$scope module board $end\n"
            "$var wire 1 ! trigger $end\n"
            "$var wire 1 \" acp $end\n"
            "$var wire 1 # arp $end\n"
            "$var wire 1 $ heading $end\n"
            "$upscope $end\n"
            "$enddefinitions $end\n"
            "#0\n$dumpvars\n0!\n0\"\n1#\n0$\n$end\n"
            "#1000\n0#\n"
            "#50000\n");
}

TEST(VcdWriter, EndsWholeButShorterWhenTold) {
  const SignalRecording recording = make_recording({.ticks = 300'000});
  Folder folder;
  const SignalFile file =
      write_vcd(folder / "f.vcd", recording, false, [](double done) { return done < 0.3; });
  EXPECT_FALSE(file.complete);
  EXPECT_EQ(file.samples, 2u << 16);
  const std::string text = text_of_file(folder / "f.vcd");
  const std::string last = "#" + std::to_string(50 * file.samples) + "\n";
  ASSERT_GT(text.size(), last.size());
  EXPECT_EQ(text.substr(text.size() - last.size()), last);
}

TEST(VcdWriter, AFullDiskIsAnErrorThatNamesTheFile) {
  try {
    write_vcd("/dev/full", make_recording(), true, kAlways);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write /dev/full: No space left on device");
  }
}

TEST(VcdWriter, WhatCannotBeWrittenLeavesNoFileAndAnOldOneAsItWas) {
  SignalRecording recording = make_recording();
  recording.edges = {{recording.from_tick, board::Line::acp},
                     {recording.from_tick + 1, board::Line::acp}};
  Folder folder;
  std::ofstream(folder / "f.vcd") << "mine";
  EXPECT_THROW(write_vcd(folder / "f.vcd", recording, false, kAlways), std::runtime_error);
  EXPECT_EQ(text_of_file(folder / "f.vcd"), "mine");
  EXPECT_THROW(write_vcd(folder / "none/f.vcd", make_recording(), false, kAlways),
               std::runtime_error);
}

}  // namespace
}  // namespace skerry::client
