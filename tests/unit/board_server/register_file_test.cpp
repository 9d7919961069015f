// The register map as a client meets it.
#include <atomic>
#include <thread>

#include "protocol/board/digdar_page.hpp"
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using board::Access;

std::vector<board::RegisterInfo> every_register() {
  std::vector<board::RegisterInfo> all(board::all_registers().begin(),
                                       board::all_registers().end());
  for (std::uint32_t n = 0; n < board::kFaultReasonBytes / 4; ++n) {
    all.push_back(*board::find_register(board::address_of(Reg::fault_reason) + 4 * n));
  }
  all.insert(all.end(), board::digdar_infos().begin(), board::digdar_infos().end());
  return all;
}

std::map<std::uint32_t, std::uint32_t> map_of(const Harness& b) {
  std::map<std::uint32_t, std::uint32_t> map;
  for (const board::RegisterInfo& info : every_register()) map[info.address] = b.read(info.address);
  return map;
}

TEST(RegisterFile, BeginsWithTheMapsValuesAndTheSetups) {
  Harness b({{Reg::samples_a, 512}, {as_b(Reg::gain_a), static_cast<std::uint32_t>(-1200)}});
  for (const board::RegisterInfo& info : board::all_registers()) {
    std::int64_t expected = info.reset;
    switch (static_cast<Reg>(info.address)) {
      case Reg::source_a:
        expected = Harness::kRadar + 1;
        break;
      case Reg::radar:
        expected = Harness::kRadar;
        break;
      case Reg::pulse_codes:
        expected = 4;
        break;
      case Reg::status:
        expected = board::status::running | board::status::radiating;
        break;
      case Reg::samples_a:
        expected = 512;
        break;
      default:
        break;
    }
    if (info.name == "GAIN_B") expected = -1200;
    EXPECT_EQ(board::value_of(info, b.read(info.address)), expected) << info.name;
  }
}

TEST(RegisterFile, WhatIsRefusedChangesNothing) {
  Harness b(Harness::small());
  b.run_to(100ms);
  const auto before = map_of(b);
  const auto refused = [&](std::uint32_t address, std::uint32_t value, RegisterError error) {
    EXPECT_EQ(b.board.write(address, value), error) << std::hex << address << " = " << value;
    EXPECT_EQ(map_of(b), before) << std::hex << address << " = " << value;
  };
  for (const board::RegisterInfo& info : every_register()) {
    refused(info.address + 1, 0, RegisterError::misaligned);
    refused(info.address + 2, 1, RegisterError::misaligned);
    if (info.access == Access::read_only) {
      refused(info.address, b.read(info.address), RegisterError::read_only);
      refused(info.address, 0xFFFF'FFFF, RegisterError::read_only);
      continue;
    }
    if (info.access == Access::write_ones_to_clear) {
      continue;  // takes any value
    }
    refused(info.address, static_cast<std::uint32_t>(info.max + 1), RegisterError::out_of_range);
    refused(info.address, 0x7FFF'FFFF, RegisterError::out_of_range);
    if (info.min > 1 || (info.min == 1 && !info.or_zero) || info.is_signed) {
      refused(info.address, static_cast<std::uint32_t>(info.min - 1), RegisterError::out_of_range);
    }
    if (info.step == 2) {
      refused(info.address, static_cast<std::uint32_t>(info.min + 1), RegisterError::out_of_range);
    }
  }
  for (const std::uint32_t unknown : {0x028u, 0x02Cu, 0x114u, 0x1ACu, 0x368u, 0xFFCu, 0x103Cu,
                                      0x10F0u, 0x2000u, 0x8000'0000u, 0xFFFF'FFFCu}) {
    refused(unknown, 1, RegisterError::unknown_register);
    EXPECT_EQ(b.board.read(unknown).error, RegisterError::unknown_register);
    EXPECT_EQ(b.board.read(unknown + 2).error, RegisterError::misaligned);
  }
  // Radars 0 and 1 are on this ship, 2 is not.
  refused(board::address_of(Reg::source_b), 3, RegisterError::out_of_range);
  b.run_for(100ms);
  EXPECT_EQ(b.output.sweeps.size(), 600u) << "and it runs on";
}

TEST(RegisterFile, BothEndsOfEveryRangeAreTaken) {
  for (const board::RegisterInfo& info : board::all_registers()) {
    if (info.access != Access::read_write || info.address == board::address_of(Reg::control)) {
      continue;
    }
    for (const std::int64_t end : {info.min, info.max, info.or_zero ? 0 : info.min}) {
      Harness b(Harness::small());
      const std::int64_t value =
          info.name.starts_with("SOURCE") ? std::min<std::int64_t>(end, 2) : end;
      const auto bits = static_cast<std::uint32_t>(value);
      EXPECT_EQ(b.board.write(info.address, bits), RegisterError::ok) << info.name << value;
      EXPECT_EQ(b.read(info.address), bits) << info.name;
      b.run_to(300ms);
      EXPECT_GT(b.read_wide(Reg::trigger_count_low), 0u) << info.name << " " << value;
    }
  }
}

TEST(RegisterFile, ABatchIsOneInstant) {
  Harness b(Harness::small());
  b.run_to(100ms);
  // Each alone would contradict the other; together they do not.
  const auto samples = board::address_of(Reg::samples_a),
             prf = board::address_of(Reg::prf_millihertz);
  const auto values = b.board.access({{samples, true, 16'384},
                                      {board::address_of(Reg::identity), true, 1},
                                      {prf, true, 600'000},
                                      {samples},
                                      {0x13, false},
                                      {board::address_of(Reg::faults)}});
  ASSERT_EQ(values.size(), 6u);
  EXPECT_EQ(values[0].error, RegisterError::ok);
  EXPECT_EQ(values[1].error, RegisterError::read_only);
  EXPECT_EQ(values[3].value, 16'384u);
  EXPECT_EQ(values[4].error, RegisterError::misaligned);
  EXPECT_EQ(values[5].value, 0u);
  EXPECT_EQ(b.fault_reason(), "");
  b.run_fresh(100ms);
  EXPECT_EQ(b.output.of(board::event::configured).size(), 1u);
  EXPECT_EQ(b.output.sweeps.back().samples[0].size(), 16'384u);
}

TEST(RegisterFile, ARunningClockAndItsHalvesBelongTogether) {
  Harness b({{Reg::sample_clock_hz, 125'000'000}});
  b.wanted = false;
  b.run_to(100s, 100s);
  const auto values = b.board.access({{board::address_of(Reg::clocks_low)},
                                      {board::address_of(Reg::clocks_high)},
                                      {board::address_of(Reg::utc_ns_low)},
                                      {board::address_of(Reg::utc_ns_high)}});
  EXPECT_EQ(values[0].value | std::uint64_t{values[1].value} << 32, 12'500'000'000u);
  EXPECT_EQ(values[2].value | std::uint64_t{values[3].value} << 32, 1'700'000'100'000'000'000u);
}

TEST(RegisterFile, ResetForgetsCountsFaultsAndFifoAtOnceAndLeavesSettings) {
  Harness b(Harness::small({{Reg::control, 9}}));
  b.run_to(6s);
  b.write(Reg::inject_missing_acp, 100);
  b.run_to(12s);
  b.write(Reg::inject_missing_acp, 100);
  EXPECT_NE(b.read(Reg::faults_latched), 0u);
  EXPECT_EQ(b.write(Reg::control, board::control::reset | board::control::run), RegisterError::ok);
  const auto zero = [&] {
    for (const Reg reg :
         {Reg::faults_latched, Reg::trigger_count_low, Reg::acp_count, Reg::arp_count,
          Reg::acp_per_arp, Reg::latched_trigger_count_low, Reg::fifo_level, Reg::overruns_a,
          Reg::sweeps_late, Reg::events, Reg::inject_missing_acp}) {
      EXPECT_EQ(b.read(reg), 0u) << std::hex << board::address_of(reg);
    }
  };
  zero();
  EXPECT_EQ(b.read(Reg::control), board::control::run) << "reset reads 0";
  EXPECT_EQ(b.read(Reg::samples_a), 8u);
  b.run_fresh(1s);
  EXPECT_EQ(b.read_wide(Reg::trigger_count_low), 3000u);
  EXPECT_EQ(b.output.sweeps.front().meta.trigger_count, 1u);
  EXPECT_EQ(b.output.of(board::event::reset).size(), 1u);
  EXPECT_EQ(b.read(Reg::inject_missing_acp), 0u) << "nor do they come after it";
  EXPECT_EQ(b.read(Reg::faults), 0u);
}

TEST(RegisterFile, StandbyOfTheRadarIsSeenInTheStatus) {
  Harness b(Harness::small());
  b.run_to(10ms);
  EXPECT_NE(b.read(Reg::status) & board::status::radiating, 0u);
  b.on_air.radiates = false;
  b.run_for(10ms);
  EXPECT_EQ(b.read(Reg::status) & board::status::radiating, 0u);
}

TEST(RegisterFile, AccessesFromOtherThreadsNeitherWaitNorTear) {
  Harness b(Harness::small({{Reg::control, 9}, {Reg::sample_clock_hz, 125'000'000}}));
  std::atomic<bool> stop = false;
  std::atomic<std::uint64_t> reads = 0;
  std::thread reader([&] {
    std::uint64_t last_clock = 0, last_triggers = 0;
    while (!stop) {
      const auto v = b.board.access({{board::address_of(Reg::clocks_low)},
                                     {board::address_of(Reg::clocks_high)},
                                     {board::address_of(Reg::trigger_count_low)},
                                     {board::address_of(Reg::status)}});
      const std::uint64_t clock = v[0].value | std::uint64_t{v[1].value} << 32;
      EXPECT_GE(clock, last_clock);
      EXPECT_GE(v[2].value, last_triggers);
      // 125 MHz, 3000 Hz: the counts are of the same instant.
      EXPECT_EQ(v[2].value, (clock * 3 + 124'999) / 125'000);
      last_clock = clock;
      last_triggers = v[2].value;
      ++reads;
      std::this_thread::yield();
    }
  });
  std::thread writer([&] {
    for (std::uint32_t i = 0; !stop; ++i) {
      b.write(Reg::gain_a, i % 100);
      b.write(as_b(Reg::samples_a), 2 + i % 5 * 2);
      Bytes out;
      std::uint64_t first = 0;
      b.board.take_fifo(3, 1 << 20, out, first);
      EXPECT_LE(b.board.counters().triggers, 6000u);
      std::this_thread::yield();
    }
  });
  b.run_to(2s, 5ms);
  while (reads < 10) std::this_thread::yield();
  stop = true;
  reader.join();
  writer.join();
  EXPECT_EQ(b.output.sweeps.size(), 6000u);
}

}  // namespace
}  // namespace skerry::server
