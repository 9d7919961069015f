// Settings that contradict each other.
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
namespace event = board::event;

struct Contradiction {
  const char* name;
  Harness::Initial before;  // allowed
  std::vector<std::pair<Reg, std::uint32_t>> writes;
  std::vector<const char*> named;  // in the reason
  std::pair<Reg, std::uint32_t> mend;
};

const Contradiction kContradictions[] = {
    {"samples beyond the period",
     {},
     {{Reg::decimation_a, 4}},
     {"SAMPLES_A 2048", "DECIMATION_A 4", "8192", "3000.000 Hz", "6666"},
     {Reg::prf_millihertz, 600'000}},
    {"PRF too high for the range",
     {},
     {{Reg::prf_millihertz, 12'000'000}},
     {"SAMPLES_A 2048", "12000.000 Hz", "1666"},
     {Reg::samples_a, 1600}},
    {"delay",
     {},
     {{Reg::trigger_delay, 5000}},
     {"TRIGGER_DELAY 5000", "7048"},
     {Reg::trigger_delay, 4000}},
    {"jitter",
     {{Reg::samples_a, 6600}},
     {{Reg::jitter_ppm, 20'000}},
     {"SAMPLES_A 6600", "6400"},
     {Reg::jitter_ppm, 0}},
    {"channel B",
     {{Reg::source_b, 1}},
     {{as_b(Reg::samples_a), 6668}},
     {"SAMPLES_B 6668"},
     {Reg::source_b, 0}},
    {"FIFO too small",
     {{Reg::source_b, 1}},
     {{Reg::fifo_depth, 4094}},
     {"FIFO_DEPTH 4094", "4096", "SAMPLES_A 2048", "SAMPLES_B 2048"},
     {Reg::source_b, 0}},
    {"sum too wide",
     {{Reg::bits_a, 14}, {Reg::samples_a, 512}, {Reg::decimation_a, 5}},
     {{Reg::decimation_mode_a, 2}},
     {"DECIMATION_A 5", "BITS_A 14", "81915", "65535"},
     {Reg::decimation_a, 4}},
    {"no such pulse",
     {},
     {{Reg::pulse_code, 5}},
     {"PULSE_CODE 5", "PULSE_CODES 4"},
     {Reg::pulse_code, 4}},
    {"duty cycle",
     {{Reg::pulse_code, 4}},
     {{Reg::prf_millihertz, 2'500'000}},
     {"PULSE_CODE 4", "1000 ns", "2500.000 Hz", "0.0025", "2000 Hz"},
     {Reg::prf_millihertz, 2'000'000}},
    {"target out of sight",
     {{Reg::test_mode_a, 4}},
     {{Reg::test_value_a, 2048}},
     {"TEST_VALUE_A 2048", "SAMPLES_A 2048"},
     {Reg::test_mode_a, 2}},
};

TEST(BoardConfig, ContradictionsAreSaidAndTheLastGoodSettingsStay) {
  for (const Contradiction& c : kContradictions) {
    SCOPED_TRACE(c.name);
    Harness b(c.before);
    b.run_to(50ms);
    ASSERT_EQ(b.read(Reg::faults), 0u);
    const board::SweepMeta good = b.output.sweeps.back().meta;
    b.forget();

    for (const auto& [reg, value] : c.writes) EXPECT_EQ(b.write(reg, value), RegisterError::ok);
    EXPECT_EQ(b.read(Reg::faults), board::fault::config) << "at once";
    EXPECT_EQ(b.read(Reg::faults_latched), board::fault::config);
    EXPECT_NE(b.read(Reg::status) & board::status::fault, 0u);
    EXPECT_EQ(b.read(c.writes[0].first), c.writes[0].second) << "what was asked for can be read";
    const std::string reason = b.fault_reason();
    for (const char* word : c.named) {
      EXPECT_NE(reason.find(word), std::string::npos) << word << " is not in: " << reason;
    }
    EXPECT_EQ(b.board.counters().fault_reason, reason) << "is not cut short";
    EXPECT_LT(reason.size(), board::kFaultReasonBytes);

    b.run_for(50ms);
    ASSERT_FALSE(b.output.sweeps.empty());
    const board::SweepMeta& meta = b.output.sweeps.back().meta;
    EXPECT_EQ(meta.channels, good.channels);
    EXPECT_EQ(meta.prf_millihertz, good.prf_millihertz);
    EXPECT_EQ(meta.delay_ticks, good.delay_ticks);
    EXPECT_EQ(meta.faults, board::fault::config);
    EXPECT_EQ(b.output.of(event::fault_raised, board::fault::config).size(), 1u);
    EXPECT_TRUE(b.output.of(event::configured).empty());

    EXPECT_EQ(b.write(c.mend.first, c.mend.second), RegisterError::ok);
    EXPECT_EQ(b.read(Reg::faults), 0u);
    EXPECT_EQ(b.fault_reason(), "");
    b.run_fresh(50ms);
    EXPECT_EQ(b.output.of(event::fault_cleared, board::fault::config).size(), 1u);
    EXPECT_EQ(b.read(Reg::faults_latched), board::fault::config) << "until it is cleared";
  }
}

TEST(BoardConfig, AContradictionFromTheStartLeavesTheMapsOwnInForce) {
  Harness b({{Reg::decimation_a, 100}});
  EXPECT_EQ(b.read(Reg::faults), board::fault::config);
  b.run_to(10ms);
  EXPECT_EQ(b.output.sweeps.back().meta.channels[0].decimation, 1u);
  EXPECT_EQ(b.read(Reg::faults_latched), board::fault::config);
  EXPECT_EQ(b.output.of(event::fault_raised, board::fault::config).size(), 1u);
}

TEST(BoardConfig, AnotherReasonIsRaisedAgain) {
  Harness b(Harness::small());
  b.run_to(50ms);
  b.write(Reg::pulse_code, 5);
  b.run_fresh(50ms);
  EXPECT_EQ(b.output.of(event::fault_raised, board::fault::config).size(), 1u);
  const std::string first = b.fault_reason();
  b.write(Reg::faults_latched, board::fault::config);

  b.write(Reg::gain_a, 100);
  b.run_fresh(50ms);
  EXPECT_TRUE(b.output.of(event::fault_raised).empty()) << "the reason is the same";
  EXPECT_EQ(b.read(Reg::faults_latched), 0u);

  b.write(Reg::pulse_code, 6);
  EXPECT_NE(b.fault_reason(), first);
  EXPECT_EQ(b.read(Reg::faults_latched), board::fault::config) << "at once";
  b.run_fresh(50ms);
  EXPECT_EQ(b.output.of(event::fault_raised, board::fault::config).size(), 1u);
  ASSERT_EQ(b.batch.fault_changes.size(), 1u);
  EXPECT_EQ(b.batch.fault_changes[0].raised, board::fault::config);
  EXPECT_TRUE(b.output.of(event::fault_cleared).empty());
  b.run_fresh(50ms);
  EXPECT_TRUE(b.output.of(event::fault_raised).empty()) << "once";
}

TEST(BoardConfig, WhatFitsThePulseOnTheAirIsNoFaultFromTheStart) {
  Harness b({{Reg::samples_a, 16'384}});
  b.on_air.pulse = {1.0e-6, 3e6, 600.0, 96.0};
  b.run_to(50ms);
  EXPECT_EQ(b.read(Reg::faults), 0u);
  EXPECT_EQ(b.read(Reg::faults_latched), 0u);
  EXPECT_TRUE(b.output.of(event::fault_raised).empty());
  EXPECT_EQ(b.output.sweeps.back().samples[0].size(), 16'384u);
}

TEST(BoardConfig, AnotherPulseOnTheAirIsJudgedToo) {
  Harness b;
  b.on_air.pulse = {1.0e-6, 3e6, 600.0, 96.0};
  b.run_to(100ms);
  EXPECT_EQ(b.output.sweeps.back().meta.prf_millihertz, 600'000u);
  b.write(Reg::samples_a, 16'384);
  b.run_for(100ms);
  EXPECT_EQ(b.output.sweeps.back().samples[0].size(), 16'384u);
  b.on_air.pulse = {0.08e-6, 20e6, 3000.0, 1.5};
  b.run_for(100ms);
  EXPECT_EQ(b.read(Reg::faults), board::fault::config);
  EXPECT_EQ(b.output.sweeps.back().meta.prf_millihertz, 600'000u) << "goes on as it was";
  b.write(Reg::samples_a, 2048);
  b.run_for(100ms);
  EXPECT_EQ(b.read(Reg::faults), 0u);
  EXPECT_EQ(b.output.sweeps.back().meta.prf_millihertz, 3'000'000u);
  EXPECT_EQ(b.output.sweeps.back().meta.pulse_ns, 80u);
}

TEST(BoardConfig, BothChannelsOffGivesNoSweepsAndIsNoFault) {
  Harness b({{Reg::source_a, 0}});
  b.run_to(100ms);
  EXPECT_TRUE(b.output.sweeps.empty());
  EXPECT_EQ(b.read(Reg::faults), 0u);
  EXPECT_EQ(b.output.of(board::Line::trigger).size(), 300u);
}

TEST(BoardConfig, AConfiguredPulseSetsItsPrfAndItsEcho) {
  Harness b(Harness::small({{Reg::pulse_code, 2}}));
  b.run_to(1s);
  EXPECT_EQ(b.output.of(board::Line::trigger).size(), 1800u);
  ASSERT_EQ(b.echoes[1]->wishes.size(), 1u);
  EXPECT_EQ(b.echoes[1]->wishes[0].pulse_code, 2u);
  EXPECT_EQ(b.echoes[1]->wishes[0].rpm, 24.0);
  EXPECT_NEAR(b.echoes[1]->wishes[0].reach_m, 8 * 7.4948, 0.01);
  b.write(Reg::gain_a, 100);
  b.run_for(1s);
  EXPECT_EQ(b.echoes[1]->wishes.size(), 1u) << "the echo is the same";
  b.write(Reg::rotation_millirpm, 48'000);
  b.run_for(100ms);
  EXPECT_EQ(b.echoes[1]->wishes.back().rpm, 48.0);
}

}  // namespace
}  // namespace skerry::server
