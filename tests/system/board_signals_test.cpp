// `skerry board signals` on a running server, its files read by programs of others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/system/board_kit.hpp"

namespace skerry::system_test {
namespace {

using board::Reg;
using testing::HasSubstr;

bool is_installed(const std::string& program) {
  return run({"/bin/sh", "-c", "command -v " + program}).code == 0;
}

// The command's own summary of what it recorded.
struct Summary {
  double seconds = 0.0;
  unsigned long long triggers = 0, acps = 0, arps = 0, headings = 0, sweeps = 0;
};
Summary summary_of(const std::string& out) {
  Summary all;
  unsigned long long tick = 0;
  EXPECT_EQ(std::sscanf(out.c_str(),
                        "%lf s from tick %llu: %llu triggers, %llu ACP, %llu ARP, %llu heading, "
                        "%llu sweeps",
                        &all.seconds, &tick, &all.triggers, &all.acps, &all.arps, &all.headings,
                        &all.sweeps),
            7)
      << out;
  return all;
}

class BoardSignals : public testing::Test {
 protected:
  Ending signals(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {
        skerry_program(), "board", "signals", "--port", std::to_string(server_.tcp_port()),
        "--timeout",      "60"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(std::move(all));
  }

  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("boards.yaml", board_scenario())}};
};

TEST_F(BoardSignals, ATurnHasEveryAcpAndOneArpAsSigrokReadsIt) {
  if (!is_installed("sigrok-cli")) FAIL() << "sigrok-cli is not installed; tests/run installs it";
  client::BoardClient board = board_of(server_);
  ASSERT_EQ(write(board, Reg::rotation_millirpm, 60'000), board::RegisterError::ok);
  ASSERT_EQ(write(board, Reg::acp_per_turn, 2048), board::RegisterError::ok);
  // The turn in which they change is not one to count.
  const std::uint32_t arps = read(board, Reg::arp_count);
  await_register(board, Reg::arp_count, [&](std::uint32_t now) { return now >= arps + 2; });
  const std::string vcd = folder_.path("turn.vcd");
  const Ending ending = signals({"--vcd", vcd});
  ASSERT_EQ(ending.code, 0) << ending.err;
  const Summary summary = summary_of(ending.out);
  EXPECT_EQ(summary.seconds, 1.0);
  EXPECT_EQ(summary.acps, 2048u);

  Ending sigrok =
      run({"/bin/sh", "-c", "sigrok-cli -I vcd:downsample=50 -i " + vcd + " -O binary"});
  ASSERT_EQ(sigrok.code, 0) << sigrok.err;
  const std::string head = "META samplerate: 20000000\n";
  ASSERT_EQ(sigrok.out.substr(0, head.size()), head);
  EXPECT_EQ(sigrok.out.size() - head.size(), 20'000'000u);
  std::array<unsigned long long, 4> rises{};
  for (std::size_t t = head.size() + 1; t < sigrok.out.size(); ++t) {
    const unsigned before = static_cast<unsigned char>(sigrok.out[t - 1]);
    const unsigned now = static_cast<unsigned char>(sigrok.out[t]);
    if (now == before) continue;
    for (unsigned wire = 0; wire < 4; ++wire) {
      rises[wire] += ((now & ~before) >> wire) & 1u;
    }
  }
  EXPECT_EQ(rises[0], summary.triggers);
  EXPECT_EQ(rises[1], 2048u);
  EXPECT_EQ(rises[2], 1u);
  EXPECT_EQ(rises[3], 1u);
  EXPECT_EQ(summary.headings, 1u);
}

// In the test ramp each sample of a sweep is one more than the last, modulo 2^12; times 8.
bool is_ramp(const std::vector<std::int16_t>& video, std::size_t begin, std::size_t count) {
  for (std::size_t i = begin + 1; i < begin + count; ++i) {
    if (((video[i] - video[i - 1]) & 0x7FFF) != 8) return false;
  }
  return true;
}

TEST_F(BoardSignals, AfterEveryTriggerOfTheWavTheSweepStandsSampleForSample) {
  if (!is_installed("sox")) FAIL() << "sox is not installed; tests/run installs it";
  constexpr std::size_t kSamples = 512;
  client::BoardClient board = board_of(server_);
  ASSERT_EQ(write(board, Reg::samples_a, kSamples), board::RegisterError::ok);
  ASSERT_EQ(write(board, Reg::test_mode_a, 1), board::RegisterError::ok);
  const std::string wav = folder_.path("f.wav"), name = folder_.path("f");
  const Ending ending = signals(
      {"--seconds", "0.05", "--wav", wav, "--sigmf", name, "--channels", "video_a,trigger"});
  ASSERT_EQ(ending.code, 0) << ending.err;
  const Summary summary = summary_of(ending.out);

  const Ending sox = run({"/bin/sh", "-c", "sox -D " + wav + " -t raw -e signed -b 16 -L -"});
  ASSERT_EQ(sox.code, 0) << sox.err;
  ASSERT_EQ(sox.out.size(), 2u * 2u * 1'000'000u);
  std::array<std::vector<std::int16_t>, 2> channels;
  for (std::size_t i = 0; i < sox.out.size(); i += 2) {
    const unsigned low = static_cast<unsigned char>(sox.out[i]);
    const unsigned high = static_cast<unsigned char>(sox.out[i + 1]);
    channels[i / 2 % 2].push_back(static_cast<std::int16_t>(low | high << 8));
  }
  const auto& [video, trigger] = channels;
  unsigned triggers = 0, ramps = 0, silent = 0, whole = 0;
  for (std::size_t t = 0; t < trigger.size(); ++t) {
    if (trigger[t] == 0 || (t > 0 && trigger[t - 1] != 0)) continue;
    ++triggers;
    if (t + kSamples > video.size()) continue;
    ++whole;
    const bool is_silent = std::all_of(video.begin() + static_cast<std::ptrdiff_t>(t),
                                       video.begin() + static_cast<std::ptrdiff_t>(t + kSamples),
                                       [](std::int16_t level) { return level == 0; });
    silent += is_silent;
    ramps += !is_silent && is_ramp(video, t, kSamples);
  }
  EXPECT_EQ(triggers, summary.triggers);
  EXPECT_EQ(ramps + silent, whole);
  EXPECT_EQ(silent, summary.triggers - summary.sweeps);
  EXPECT_GT(ramps, 0u);

  for (std::size_t c = 0; c < 2; ++c) {
    const std::string data =
        text_of_file(name + (c == 0 ? "-video_a.sigmf-data" : "-trigger.sigmf-data"));
    ASSERT_EQ(data.size(), 2 * channels[c].size());
    std::string expected;
    for (const std::int16_t level : channels[c]) {
      expected.push_back(static_cast<char>(level & 0xFF));
      expected.push_back(static_cast<char>(level >> 8));
    }
    EXPECT_TRUE(data == expected);
  }
}

TEST_F(BoardSignals, WhatCannotBeDoneIsSaidBeforeAnythingIsRecorded) {
  Ending ending = signals({"--wav", folder_.path("f.wav"), "--rate", "100MHz"});
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("above the board's sample clock of 20000000 Hz"));
  ending = signals({"--wav", folder_.path("none/f.wav")});
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("there is no folder"));
  ending = signals({"--wav", folder_.path("f.wav"), "--turns", "1000"});
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("of memory, at most"));
  ending = signals({});
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.err, HasSubstr("At least one of --vcd, --wav and --sigmf is required"));
}

TEST_F(BoardSignals, AFullDiskIsNamedAndEndsItWithOne) {
  const Ending ending = signals({"--seconds", "0.01", "--vcd", "/dev/full"});
  EXPECT_EQ(ending.code, 1);
  EXPECT_THAT(ending.err, HasSubstr("cannot write /dev/full: No space left on device"));
}

}  // namespace
}  // namespace skerry::system_test
