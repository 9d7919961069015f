// The page of the open digitiser, against the board's own registers.
#include "protocol/board/digdar_page.hpp"

#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using board::Digdar;
using board::DigdarUse;

std::uint32_t at(Digdar offset) { return board::address_of(offset); }
std::uint32_t at_trigger(Digdar offset) {
  return board::address_of(offset) + board::kDigdarAtTrigger - board::kDigdarMetadata;
}

TEST(DigdarPage, WhatIsTheSameReadsAndWritesTheSame) {
  Harness b(Harness::small());
  b.run_to(6s);
  for (const board::DigdarRegister& row : board::digdar_page()) {
    if (row.use != DigdarUse::same) continue;
    EXPECT_EQ(b.read(row.info->address), b.read(*row.reg)) << row.info->name;
    if (row.info->access != board::Access::read_write) continue;
    for (const std::int64_t value : {row.info->min, row.info->min + row.info->step}) {
      const auto bits = static_cast<std::uint32_t>(value);
      EXPECT_EQ(b.board.write(row.info->address, bits), RegisterError::ok) << row.info->name;
      EXPECT_EQ(b.read(*row.reg), bits);
      EXPECT_EQ(b.write(*row.reg, static_cast<std::uint32_t>(row.info->max)), RegisterError::ok);
      EXPECT_EQ(b.read(row.info->address), static_cast<std::uint32_t>(row.info->max));
    }
  }
}

TEST(DigdarPage, ThresholdsAreKeptAndHaveNoEffect) {
  Harness b(Harness::small());
  for (const board::DigdarRegister& row : board::digdar_page()) {
    if (row.use != DigdarUse::stored) continue;
    for (const std::int64_t value : {row.info->min, row.info->max}) {
      const auto bits = static_cast<std::uint32_t>(value);
      EXPECT_EQ(b.board.write(row.info->address, bits), RegisterError::ok) << row.info->name;
      EXPECT_EQ(b.read(row.info->address), bits) << row.info->name;
    }
  }
  b.run_to(1s);
  EXPECT_EQ(b.output.sweeps.size(), 3000u);
  EXPECT_TRUE(b.output.of(board::event::configured).empty());
}

TEST(DigdarPage, OptionsAreDecimationPolarityAndCounting) {
  Harness b(Harness::small());
  const auto write = [&](std::uint32_t bits) {
    EXPECT_EQ(b.board.write(at(Digdar::options), bits), RegisterError::ok);
  };
  write(board::digdar_option::average | board::digdar_option::negate);
  EXPECT_EQ(b.read(Reg::decimation_mode_a),
            static_cast<std::uint32_t>(board::DecimationMode::mean));
  EXPECT_EQ(b.read(Reg::polarity_a), 1u);
  EXPECT_EQ(b.read(at(Digdar::options)), 5u);
  write(board::digdar_option::sum | board::digdar_option::counting);
  EXPECT_EQ(b.read(Reg::decimation_mode_a), static_cast<std::uint32_t>(board::DecimationMode::sum));
  EXPECT_EQ(b.read(Reg::polarity_a), 0u);
  EXPECT_EQ(b.read(Reg::test_mode_a), static_cast<std::uint32_t>(board::TestMode::ramp));
  EXPECT_EQ(b.read(at(Digdar::options)), 10u);
  b.run_to(100ms);
  EXPECT_EQ(b.output.sweeps.back().samples[0][3],
            (b.output.sweeps.back().meta.trigger_count + 3) % 256);
  write(0);
  EXPECT_EQ(b.read(Reg::decimation_mode_a), 0u);
  EXPECT_EQ(b.read(Reg::test_mode_a), 0u);
  b.write(Reg::decimation_mode_a, 1);
  b.write(Reg::test_mode_a, 3);
  EXPECT_EQ(b.read(at(Digdar::options)), 1u);
}

TEST(DigdarPage, ItsProgramsWayToCaptureASweep) {
  Harness b(Harness::small({{Reg::control, 0}}));
  b.run_to(100ms);
  const auto captured = [&] { return b.read(Reg::fifo_level); };
  // Select a trigger, arm, wait until the source reads 0, read the sweep.
  EXPECT_EQ(b.board.write(at(Digdar::trig_source), 0), RegisterError::ok);
  EXPECT_EQ(b.board.write(at(Digdar::command), board::digdar_command::arm), RegisterError::ok);
  b.run_for(100ms);
  EXPECT_EQ(captured(), 0u) << "without a source";
  EXPECT_EQ(b.board.write(at(Digdar::trig_source), 2), RegisterError::ok);
  EXPECT_EQ(b.read(at(Digdar::trig_source)), 2u);
  EXPECT_EQ(b.board.write(at(Digdar::command), board::digdar_command::arm), RegisterError::ok);
  EXPECT_EQ(b.read(at(Digdar::command)), 0u);
  EXPECT_NE(b.read(Reg::status) & board::status::armed, 0u);
  b.run_for(100ms);
  EXPECT_EQ(b.read(at(Digdar::trig_source)), 0u);
  EXPECT_EQ(captured(), 1u);
  EXPECT_EQ(b.board.write(at(Digdar::command), board::digdar_command::reset), RegisterError::ok);
  EXPECT_EQ(captured(), 0u);
  EXPECT_EQ(b.read(at(Digdar::trig_count)), 0u);
}

TEST(DigdarPage, CountsAndClocksAreThoseOfThePulses) {
  Harness b(Harness::small({{Reg::arp_error, 1000}}));
  b.run_to(6s);
  const auto triggers = b.output.of(board::Line::trigger);
  const auto acps = b.output.of(board::Line::acp);
  const auto arps = b.output.of(board::Line::arp);
  const auto wide = [&](Digdar offset) { return b.read_wide(at(offset)); };
  const auto count_until = [](const std::vector<Tick>& ticks, Tick tick) {
    return std::upper_bound(ticks.begin(), ticks.end(), tick) - ticks.begin();
  };
  EXPECT_EQ(wide(Digdar::trig_clock), triggers.back());
  EXPECT_EQ(wide(Digdar::trig_prev_clock), *(triggers.end() - 2));
  EXPECT_EQ(wide(Digdar::acp_clock), acps.back());
  EXPECT_EQ(wide(Digdar::acp_prev_clock), *(acps.end() - 2));
  EXPECT_EQ(wide(Digdar::arp_clock), arps.back());
  EXPECT_EQ(wide(Digdar::arp_prev_clock), *(arps.end() - 2));
  EXPECT_EQ(b.read(at(Digdar::trig_count)), triggers.size());
  EXPECT_EQ(b.read(at(Digdar::acp_count)), acps.size());
  EXPECT_EQ(b.read(at(Digdar::arp_count)), arps.size());
  EXPECT_EQ(b.read(at(Digdar::acp_per_arp)), 4096u);
  const auto acps_then = count_until(acps, arps.back());
  EXPECT_EQ(b.read(at(Digdar::acp_at_arp)), acps_then);
  EXPECT_EQ(b.read(at(Digdar::clock_since_acp_at_arp)),
            arps.back() - acps[static_cast<std::size_t>(acps_then - 1)]);
  EXPECT_EQ(b.read(at(Digdar::trig_at_arp)), count_until(triggers, arps.back()));
  EXPECT_EQ(wide(Digdar::clocks), 120'000'000u);
  EXPECT_EQ(b.read(at(Digdar::adc_counter)), 120'000'000u % 16'384);
  // At the last trigger all but the ACPs and its tick are as they are now.
  const Tick last = triggers.back();
  EXPECT_EQ(b.read_wide(at_trigger(Digdar::trig_clock)), last);
  EXPECT_EQ(b.read(at_trigger(Digdar::acp_count)), count_until(acps, last));
  EXPECT_EQ(b.read(at_trigger(Digdar::adc_counter)), last % 16'384);
  EXPECT_EQ(b.read_wide(at_trigger(Digdar::arp_clock)), arps.back());
  EXPECT_EQ(b.read(at_trigger(Digdar::acp_per_arp)), 4096u);
  EXPECT_EQ(b.read(at_trigger(Digdar::acp_at_arp)), acps_then);
}

TEST(DigdarPage, CountsSurviveAnotherClock) {
  Harness b(Harness::small());
  b.run_to(6s);
  const std::uint32_t acps = b.read(at(Digdar::acp_count));
  const std::uint32_t acps_at_arp = b.read(at(Digdar::acp_at_arp));
  const std::uint32_t triggers_at_arp = b.read(at(Digdar::trig_at_arp));
  EXPECT_GT(acps_at_arp, 8000u);
  EXPECT_GT(triggers_at_arp, 14'000u);
  b.write(Reg::sample_clock_hz, 10'000'000);
  b.output.edges_until = 0;  // of this clock
  b.run_for(100ms);
  EXPECT_NEAR(b.read(at(Digdar::acp_count)), acps + 164.0, 1.0);
  EXPECT_EQ(b.read(at(Digdar::acp_at_arp)), acps_at_arp);
  EXPECT_EQ(b.read(at(Digdar::trig_at_arp)), triggers_at_arp);
  EXPECT_EQ(b.read(at(Digdar::acp_count)) - acps_at_arp, b.read(Reg::acp_count));
}

}  // namespace
}  // namespace skerry::server
