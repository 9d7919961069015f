// Orders to a board that is at work: resets, armings and other settings in the middle of a turn or
// of a step, and steps that bring more than a batch holds.
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
namespace control = board::control;
namespace event = board::event;
namespace fault = board::fault;
namespace status = board::status;

Board::Operation writing(Reg reg, std::uint32_t value) {
  return {board::address_of(reg), true, value};
}

// 12,500 ticks to an ACP; a turn is 2.5 s.
Harness::Initial even_turns(Harness::Initial more = {}) {
  more.push_back({Reg::sample_clock_hz, 20'480'000});
  return Harness::small(more);
}

TEST(BoardOrders, AfterAResetAMissingArpIsSeen) {
  Harness b(even_turns());
  b.run_to(2510ms);
  b.board.access(
      {writing(Reg::control, control::reset | control::run), writing(Reg::inject_missing_arp, 1)});
  b.run_fresh(4900ms);
  EXPECT_TRUE(b.output.of(board::Line::arp).empty());
  EXPECT_EQ(b.read(Reg::faults), fault::arp_missing);
  EXPECT_EQ(b.output.of(event::fault_raised, fault::arp_missing).size(), 1u);
  b.run_to(10'010ms);
  EXPECT_EQ(b.read(Reg::faults), 0u) << "after a good turn";
}

TEST(BoardOrders, AfterAResetOrOtherSettingsAStallIsSeen) {
  const Board::Operation orders[] = {writing(Reg::control, control::reset | control::run),
                                     writing(Reg::sample_clock_hz, 10'000'000),
                                     writing(Reg::rotation_millirpm, 12'000)};
  for (const Board::Operation& order : orders) {
    Harness b(even_turns());
    b.run_to(2510ms);
    b.board.access({order, writing(Reg::inject_stall_ms, 700)});
    b.output.edges_until = 0;  // of this clock
    b.run_fresh(600ms);
    EXPECT_EQ(b.output.of(board::Line::acp).size(), 1u);
    EXPECT_EQ(b.read(Reg::faults), fault::stalled) << std::hex << order.address;
    b.run_for(200ms);
    EXPECT_EQ(b.read(Reg::faults), 0u);
  }
}

TEST(BoardOrders, OtherAcpsOfATurnLeaveTheAzimuthTrueToTwoOfThemAndSoonToOne) {
  constexpr std::int32_t kArpError = 1000;
  for (const auto& [before, after] : {std::pair{4096u, 360u}, {360u, 4096u}, {4096u, 2048u}}) {
    Harness b(even_turns({{Reg::acp_per_turn, before}, {Reg::arp_error, kArpError}}));
    b.run_to(6700ms);
    b.write(Reg::acp_per_turn, after);
    b.run_fresh(1s);
    ASSERT_EQ(b.output.sweeps.size(), 3000u);
    for (const board::Sweep& sweep : b.output.sweeps) {
      const double truth = static_cast<double>(sweep.meta.trigger_tick) / 51'200'000.0;
      const bool arp_came = truth > 3.0 + kArpError / 65'536.0;
      const bool two_acps_came = (truth - 2.68) * after > 2.0;
      double off = board::azimuth_turns(sweep.meta) - (truth - kArpError / 65'536.0);
      off -= std::floor(off + 0.5);
      ASSERT_LT(std::fabs(off) * after, arp_came        ? 0.01
                                        : two_acps_came ? 1.0
                                                        : 2.0)
          << before << " to " << after << " at turn " << truth;
    }
    EXPECT_EQ(b.read(Reg::faults), 0u);
  }
}

TEST(BoardOrders, AResetWithinAStepLeavesNoSweepOfBeforeInTheFifo) {
  Harness b(Harness::small({{Reg::control, control::run | control::fifo}}));
  b.wanted = false;
  b.run_to(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::fifo_level), 15u);
  b.echoes[1]->on_row = [&] {
    b.echoes[1]->on_row = nullptr;
    b.write(Reg::control, control::reset | control::run | control::fifo);
  };
  b.run_for(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::fifo_level), 0u);
  EXPECT_EQ(b.read(Reg::overruns_a), 0u);
  b.run_for(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::fifo_level), 15u);
  Bytes out;
  std::uint64_t first = 0;
  EXPECT_EQ(b.board.take_fifo(1, 1 << 20, out, first), 1u);
  const auto record = board::decode_record(out);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(std::get<board::Sweep>(record->record).meta.trigger_count, 1u);
}

TEST(BoardOrders, AnArmingWithinAStepIsForTheSettingsThatItCameWith) {
  Harness b(Harness::small({{Reg::control, 0}}));
  b.write(Reg::control, control::arm);
  b.run_to(5ms, 5ms);
  Bytes out;
  std::uint64_t first = 0;
  EXPECT_EQ(b.board.take_fifo(1, 1 << 20, out, first), 1u);
  b.write(Reg::control, control::arm);
  b.echoes[1]->on_row = [&] {
    b.echoes[1]->on_row = nullptr;
    b.board.access({writing(Reg::samples_a, 4), writing(Reg::control, control::arm)});
  };
  b.run_fresh(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::status) & (status::armed | status::captured), status::armed);
  EXPECT_EQ(b.read(Reg::fifo_level), 0u);
  EXPECT_TRUE(b.output.of(event::captured).empty());
  b.run_for(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::status) & (status::armed | status::captured), status::captured);
  EXPECT_EQ(b.output.of(event::captured).size(), 1u);
  out.clear();
  EXPECT_EQ(b.board.take_fifo(1, 1 << 20, out, first), 1u);
  const auto record = board::decode_record(out);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(std::get<board::Sweep>(record->record).samples[0].size(), 4u);
}

TEST(BoardOrders, AFullFifoThatIsTheOnlyReaderCostsNoVideo) {
  Harness b(Harness::small({{Reg::fifo_depth, 80}, {Reg::control, control::run | control::fifo}}));
  b.wanted = false;
  b.run_to(100ms);
  EXPECT_EQ(b.read(Reg::fifo_level), 10u);
  EXPECT_EQ(b.read(Reg::overruns_a), 290u);
  EXPECT_EQ(b.read(Reg::faults), fault::overrun);
  EXPECT_EQ(b.board.counters().sweeps, 10u);
  const std::size_t rows = b.echoes[1]->asked.size();
  b.run_for(100ms);
  EXPECT_EQ(b.read(Reg::overruns_a), 590u);
  EXPECT_EQ(b.echoes[1]->asked.size(), rows);
  Bytes out;
  std::uint64_t first = 0;
  EXPECT_EQ(b.board.take_fifo(10, 1 << 20, out, first), 10u);
  b.run_for(1ms);
  EXPECT_EQ(b.board.take_fifo(10, 1 << 20, out, first), 3u);
  EXPECT_EQ(first, 600u) << "those that were lost have numbers, too";
}

TEST(BoardOrders, ABatchIsBoundedWhateverAStepBrings) {
  // The most that a board makes: 25 kB 20,000 times a second.
  const Harness::Initial most = {{Reg::sample_clock_hz, 125'000'000},
                                 {Reg::prf_millihertz, 20'000'000},
                                 {Reg::samples_a, 6250},
                                 {Reg::source_b, 2},
                                 {as_b(Reg::samples_a), 6250},
                                 {Reg::test_mode_a, 1},
                                 {as_b(Reg::test_mode_a), 1}};
  Harness b(most), often(most);
  int batches = 1;
  b.between_batches = [&] {
    // Other settings between two batches neither lose nor double a pulse.
    b.write(Reg::gain_a, static_cast<std::uint32_t>(batches++));
  };
  b.run_to(100ms, 100ms);
  often.run_to(100ms, 5ms);
  EXPECT_GE(batches, 6) << "of 50 MB";
  EXPECT_LT(b.biggest_batch, BoardBatch::kMostBytes + (1u << 16));
  EXPECT_LT(often.biggest_batch, BoardBatch::kMostBytes);
  ASSERT_EQ(b.output.sweeps.size(), 2000u);
  ASSERT_EQ(often.output.sweeps.size(), 2000u);
  for (std::size_t i = 0; i < 2000; ++i) {
    ASSERT_EQ(b.output.sweeps[i].meta, often.output.sweeps[i].meta) << i;
  }
  EXPECT_EQ(b.output.edges, often.output.edges);
  EXPECT_EQ(b.read_wide(Reg::clocks_low), 12'500'000u);
  EXPECT_GT(b.batch.records.capacity(), BoardBatch::kKeptBytes);
  b.run_for(2ms, 1ms);
  EXPECT_LE(b.batch.records.capacity(), BoardBatch::kKeptBytes) << "given back";
}

}  // namespace
}  // namespace skerry::server
