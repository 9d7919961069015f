// Sweeps on their way out: channels, patterns, blanking, FIFO, capture, spokes.
#include "protocol/board/digdar_page.hpp"
#include "server/board/test_pattern.hpp"
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
namespace control = board::control;
namespace event = board::event;
namespace status = board::status;

std::vector<board::Sweep> records_in(std::span<const std::uint8_t> bytes,
                                     std::vector<std::uint64_t>* sequences = nullptr) {
  std::vector<board::Sweep> sweeps;
  while (!bytes.empty()) {
    const auto decoded = board::decode_record(bytes);
    if (!decoded.ok()) {
      ADD_FAILURE() << decoded.error().text;
      break;
    }
    sweeps.push_back(std::get<board::Sweep>(decoded->record));
    if (sequences) sequences->push_back(decoded->sequence);
    bytes = bytes.subspan(decoded->size);
  }
  return sweeps;
}

TEST(BoardSweeps, ChannelBOfAnotherRadarHasItsOwnEchoAndOneOfTheSameSharesIt) {
  Harness b(Harness::small({{Reg::source_b, 1}, {as_b(Reg::samples_a), 16}}));
  b.run_to(100ms);
  EXPECT_EQ(b.echoes_found, 2u);
  EXPECT_EQ(b.echoes.size(), 2u);
  EXPECT_EQ(b.output.sweeps.back().samples[0].size(), 8u);
  EXPECT_EQ(b.output.sweeps.back().samples[1].size(), 16u);
  EXPECT_EQ(b.output.sweeps.back().meta.channels[1].detector, board::Detector::linear);
  EXPECT_EQ(b.echoes[0]->wishes.back().pulse_code, 0u);
  const auto asked = b.echoes[0]->asked.size();
  b.write(Reg::source_b, 2);
  b.run_for(100ms);
  EXPECT_EQ(b.echoes[0]->asked.size(), asked);
  EXPECT_EQ(b.echoes_found, 2u);
  EXPECT_NEAR(b.echoes[1]->wishes.back().reach_m, 16 * 7.4948, 0.01) << "the longer of both";
}

TEST(BoardSweeps, EveryTriggerHasNoiseOfItsOwn) {
  Harness b({{Reg::samples_a, 512}});
  b.run_to(100ms);
  ASSERT_EQ(b.output.sweeps.size(), 300u);
  for (std::size_t i = 1; i < 300; ++i) {
    EXPECT_NE(b.output.sweeps[i].samples[0], b.output.sweeps[i - 1].samples[0]);
  }
}

std::vector<board::Sweep> a_turn_of(board::TestMode mode, std::uint32_t value,
                                    Harness::Initial more = {}) {
  more.insert(more.begin(), {{Reg::samples_a, 64},
                             {Reg::test_mode_a, static_cast<std::uint32_t>(mode)},
                             {Reg::test_value_a, value}});
  Harness b(more);
  b.run_to(2510ms);
  auto sweeps = b.run_fresh(2500ms).sweeps;
  EXPECT_EQ(b.echoes_found, 0u) << "patterns need no echo";
  EXPECT_EQ(sweeps.size(), 7500u);
  return sweeps;
}

TEST(BoardSweeps, TestPatternsAreExact) {
  for (const board::Sweep& s : a_turn_of(board::TestMode::ramp, 1, {{Reg::bits_a, 8}})) {
    for (std::size_t i = 0; i < 64; ++i) {
      ASSERT_EQ(s.samples[0][i], (i + s.meta.trigger_count) % 256);
    }
  }
  for (const board::Sweep& s : a_turn_of(board::TestMode::rings, 20)) {
    for (std::size_t i = 0; i < 64; ++i) {
      ASSERT_EQ(s.samples[0][i], i == 20 || i == 40 || i == 60 ? 4095 : 0);
    }
  }
  int lit = 0;
  for (const board::Sweep& s : a_turn_of(board::TestMode::wedge, 450, {{Reg::polarity_a, 1}})) {
    const bool in = board::azimuth_turns(s.meta) < 0.125;
    lit += in ? 1 : 0;
    for (const auto code : s.samples[0]) ASSERT_EQ(code, in ? 0 : 4095);
  }
  EXPECT_NEAR(lit, 937.5, 1.0);
  lit = 0;
  for (const board::Sweep& s : a_turn_of(board::TestMode::target, 33, {{Reg::bits_a, 14}})) {
    const double turns = board::azimuth_turns(s.meta);
    const bool in = turns <= 1.0 / 720 || turns >= 1.0 - 1.0 / 720;
    lit += in ? 1 : 0;
    for (std::size_t i = 0; i < 64; ++i) ASSERT_EQ(s.samples[0][i], in && i == 33 ? 16'383 : 0);
  }
  EXPECT_NEAR(lit, 7500.0 / 360, 1.0);
  for (const board::Sweep& s : a_turn_of(board::TestMode::checkerboard, 16, {{Reg::bits_a, 10}})) {
    const auto column = static_cast<std::size_t>(board::azimuth_turns(s.meta) * 32);
    for (std::size_t i = 0; i < 64; ++i) {
      ASSERT_EQ(s.samples[0][i], (i / 16 + column) % 2 == 1 ? 1023 : 0);
    }
  }
}

TEST(BoardSweeps, BlankedSectorsHaveNoTriggersOrNoVideo) {
  const Harness::Initial sectors{{Reg::blank_1_from, 3500},
                                 {Reg::blank_1_to, 200},
                                 {Reg::blank_2_from, 900},
                                 {Reg::blank_2_to, 1000},
                                 {Reg::samples_a, 256}};
  const auto blanked = [](Tick tick) {
    const double degrees = std::fmod(static_cast<double>(tick) / 50e6, 1.0) * 360;
    return degrees >= 350 || degrees < 20 || (degrees >= 90 && degrees < 100);
  };
  for (const std::uint32_t mode : {1u, 2u}) {
    for (const std::uint32_t inverted : {0u, 1u}) {
      Harness b(sectors);
      b.write(Reg::blanking, mode);
      b.write(Reg::polarity_a, inverted);
      b.run_to(2500ms);
      std::size_t triggers = 0, dark = 0;
      for (const Tick tick : b.output.of(board::Line::trigger)) {
        ++triggers;
        ASSERT_TRUE(mode == 2 || !blanked(tick));
      }
      // 40 of 360 degrees.
      EXPECT_NEAR(static_cast<double>(triggers), mode == 1 ? 7500.0 * 320 / 360 : 7500.0, 2.0);
      EXPECT_EQ(b.read_wide(Reg::trigger_count_low), triggers);
      ASSERT_EQ(b.output.sweeps.size(), triggers);
      for (const board::Sweep& s : b.output.sweeps) {
        const std::uint16_t none = inverted == 1 ? 4095 : 0;
        const bool is_dark = std::all_of(s.samples[0].begin(), s.samples[0].end(),
                                         [&](std::uint16_t code) { return code == none; });
        ASSERT_EQ(is_dark, blanked(s.meta.trigger_tick)) << s.meta.trigger_tick;
        dark += is_dark ? 1 : 0;
      }
      EXPECT_NEAR(static_cast<double>(dark), mode == 2 ? 7500.0 * 40 / 360 : 0.0, 2.0);
    }
  }
}

TEST(BoardSweeps, TheFifoHoldsWhatItsDepthAllowsAndCountsTheRest) {
  // Ten sweeps of 8 + 4 samples.
  Harness b(Harness::small({{Reg::fifo_depth, 125},
                            {Reg::source_b, 2},
                            {as_b(Reg::samples_a), 4},
                            {Reg::control, control::run | control::fifo}}));
  b.wanted = false;
  EXPECT_TRUE(b.board.captures());
  b.run_to(5ms);  // 15 triggers
  EXPECT_EQ(b.read(Reg::fifo_level), 10u);
  EXPECT_EQ(b.read(Reg::overruns_a), 5u);
  EXPECT_EQ(b.read(Reg::overruns_b), 5u);
  EXPECT_EQ(b.read(Reg::faults), board::fault::overrun);
  EXPECT_EQ(b.output.of(event::fault_raised, board::fault::overrun).size(), 1u);
  EXPECT_TRUE(b.output.sweeps.empty()) << "nobody reads the stream";

  Bytes out;
  std::uint64_t first = 77;
  EXPECT_EQ(b.board.take_fifo(4, 1 << 20, out, first), 4u);
  EXPECT_EQ(first, 0u);
  auto sweeps = records_in(out);
  ASSERT_EQ(sweeps.size(), 4u);
  EXPECT_EQ(sweeps[0].meta.trigger_count, 1u);
  EXPECT_EQ(sweeps[3].meta.trigger_count, 4u);
  EXPECT_EQ(b.read(Reg::fifo_level), 6u);

  b.run_for(1ms);  // 3 more
  EXPECT_EQ(b.read(Reg::faults), 0u);
  out.clear();
  std::vector<std::uint64_t> sequences;
  EXPECT_EQ(b.board.take_fifo(64, 1 << 20, out, first), 9u);
  sweeps = records_in(out, &sequences);
  EXPECT_EQ(first, 4u);
  EXPECT_EQ(sequences.back(), 17u) << "five were lost in between";
  EXPECT_EQ(sequences[5], 9u);
  EXPECT_EQ(sequences[6], 15u);
  EXPECT_EQ(sweeps[6].meta.trigger_count, 16u);
  EXPECT_EQ(b.read(Reg::underruns_a), 55u);
  EXPECT_EQ(b.read(Reg::underruns_b), 55u);
  EXPECT_EQ(b.read(Reg::fifo_level), 0u);
}

TEST(BoardSweeps, AnOverrunEndsWhenThereIsRoomForASweepAgain) {
  Harness b(Harness::small({{Reg::fifo_depth, 80}, {Reg::control, control::run | control::fifo}}));
  b.run_to(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::faults), board::fault::overrun);
  b.write(Reg::control, 0);
  b.run_for(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::faults), board::fault::overrun) << "it is still full";
  Bytes out;
  std::uint64_t first = 0;
  EXPECT_EQ(b.board.take_fifo(1, 1 << 20, out, first), 1u);
  b.run_fresh(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::faults), 0u);
  EXPECT_EQ(b.output.of(event::fault_cleared, board::fault::overrun).size(), 1u);
  EXPECT_EQ(b.read(Reg::faults_latched), board::fault::overrun);
}

TEST(BoardSweeps, TheFifoGivesNoMoreBytesThanAskedFor) {
  Harness b(Harness::small({{Reg::control, control::run | control::fifo}}));
  b.run_to(5ms);
  Bytes out(3, 0xAB);
  std::uint64_t first = 0;
  EXPECT_EQ(b.board.take_fifo(1, 1 << 20, out, first), 1u);
  const std::size_t one = out.size() - 3;
  EXPECT_EQ(b.board.take_fifo(10, 3 * one + 5, out, first), 3u);
  EXPECT_EQ(out.size(), 3 + 4 * one);
  EXPECT_EQ(out[2], 0xAB) << "appended";
  EXPECT_EQ(b.board.take_fifo(10, 5, out, first), 0u);
  EXPECT_EQ(b.read(Reg::underruns_a), 0u);
  EXPECT_EQ(b.read(Reg::fifo_level), 11u);
}

TEST(BoardSweeps, ArmedItCapturesOneTrigger) {
  Harness b(Harness::small({{Reg::control, 0}}));
  b.run_to(100ms);
  EXPECT_TRUE(b.output.sweeps.empty()) << "it does not run";
  EXPECT_EQ(b.output.of(board::Line::trigger).size(), 300u);
  EXPECT_FALSE(b.board.captures());
  EXPECT_EQ(b.read_wide(Reg::latched_trigger_count_low), 0u);
  EXPECT_EQ(b.write(Reg::control, control::arm), RegisterError::ok);
  EXPECT_EQ(b.read(Reg::control), 0u) << "reads 0";
  EXPECT_EQ(b.read(Reg::status) & (status::armed | status::captured), status::armed);
  EXPECT_TRUE(b.board.captures());
  b.run_fresh(100ms);
  EXPECT_EQ(b.read(Reg::status) & (status::armed | status::captured), status::captured);
  EXPECT_FALSE(b.board.captures());
  EXPECT_EQ(b.read(Reg::fifo_level), 1u);
  EXPECT_TRUE(b.output.sweeps.empty()) << "into the FIFO alone";
  ASSERT_EQ(b.output.of(event::captured).size(), 1u);
  EXPECT_EQ(b.output.of(event::captured)[0].value, 301u);
  EXPECT_EQ(b.read_wide(Reg::latched_trigger_count_low), 301u) << "and is kept";
  EXPECT_EQ(b.read_wide(Reg::latched_clock_low), b.output.of(event::captured)[0].tick);
  EXPECT_EQ(b.read_wide(Reg::trigger_count_low), 600u) << "while it counts on";
  b.run_for(100ms);
  EXPECT_EQ(b.read_wide(Reg::latched_trigger_count_low), 301u);
  b.write(Reg::control, control::arm);
  EXPECT_EQ(b.read(Reg::status) & status::captured, 0u) << "since it was last armed";
}

TEST(BoardSweeps, LatchedRegistersAreTheMetadataOfTheLastSweep) {
  Harness b(Harness::small({{Reg::arp_error, 100}}));
  b.run_to(4s);
  const board::SweepMeta& meta = b.output.sweeps.back().meta;
  EXPECT_EQ(b.read_wide(Reg::latched_trigger_count_low), meta.trigger_count);
  EXPECT_EQ(b.read_wide(Reg::latched_clock_low), meta.trigger_tick);
  EXPECT_EQ(b.read(Reg::latched_acp_count), meta.acp_count);
  EXPECT_EQ(b.read(Reg::latched_ticks_since_acp), meta.ticks_since_acp);
  EXPECT_EQ(b.read(Reg::latched_acp_period), meta.acp_period);
  EXPECT_EQ(b.read(Reg::latched_arp_count), meta.arp_count);
  EXPECT_EQ(b.read_wide(Reg::latched_utc_ns_low), meta.utc_ns);
}

TEST(BoardSweeps, SpokesAreFormedAndGoTheSameWays) {
  Harness b(Harness::small({{Reg::spokes_per_turn, 512},
                            {Reg::test_mode_a, 5},
                            {Reg::test_value_a, 2},
                            {Reg::control, control::run | control::fifo}}));
  b.run_to(2500ms);
  b.run_fresh(2500ms);
  EXPECT_NEAR(static_cast<double>(b.output.sweeps.size()), 512.0, 1.0);
  std::uint32_t last = b.output.sweeps[0].meta.spoke;
  for (std::size_t i = 1; i < b.output.sweeps.size(); ++i) {
    const board::SweepMeta& meta = b.output.sweeps[i].meta;
    EXPECT_EQ(meta.spokes_per_turn, 512u);
    EXPECT_EQ(meta.spoke, (last + 1) % 512);
    EXPECT_NEAR(meta.pulses, 14.6, 1.0);
    last = meta.spoke;
  }
  EXPECT_NEAR(b.read(Reg::fifo_level), 1024, 2);
  b.write(Reg::spokes_per_turn, 0);
  b.run_fresh(100ms);
  EXPECT_EQ(b.output.sweeps.back().meta.spokes_per_turn, 0u);
}

TEST(BoardSweeps, ARadarWhoseEchoesAreNotToBeHadIsBlank) {
  BoardSetup setup;
  setup.initial = {{board::address_of(Reg::samples_a), 16},
                   {board::address_of(Reg::event_enable), 0}};
  Board board(std::move(setup));
  BoardBatch batch;
  board.advance(ScenarioTime(10ms), Harness::utc_zero(), true, batch);
  EXPECT_EQ(batch.sweeps, 30u);
  // The last record is that of the edges.
  const auto end = batch.record_ends[batch.record_ends.size() - 2];
  const auto sweeps = records_in(std::span(batch.records).first(end));
  ASSERT_EQ(sweeps.size(), 30u);
  for (const board::Sweep& sweep : sweeps) {
    EXPECT_EQ(sweep.samples[0], std::vector<std::uint16_t>(16, 0));
  }
}

}  // namespace
}  // namespace skerry::server
