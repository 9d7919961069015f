// Steps of any size, months at once, and being late.
#include "echo/kernel/hash.hpp"
#include "protocol/board/digdar_page.hpp"
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
namespace event = board::event;

Harness::Initial everything() {
  return Harness::small({{Reg::wow_ppm, 50'000},
                         {Reg::wow_per_turn, 3},
                         {Reg::gust_ppm, 200'000},
                         {Reg::jitter_ppm, 100'000},
                         {Reg::stagger_ppm, 50'000},
                         {Reg::arp_error, 777},
                         {Reg::blanking, 1},
                         {Reg::blank_1_from, 3000},
                         {Reg::blank_1_to, 100},
                         {Reg::source_b, 1}});
}

TEST(BoardSteps, OfAnySizeGiveTheSameRecords) {
  const auto run = [](std::uint64_t seed) {
    Harness b(everything());
    const auto until = [&](Duration to) {
      while (b.now < to) {
        // From a microsecond to a quarter of a second, as likely at every scale.
        const double exponent =
            echo::as_unit(echo::mixed(seed, static_cast<std::uint64_t>(b.now.count())));
        const Duration step =
            seed == 0 ? Duration(250ms)
                      : Duration(static_cast<std::int64_t>(1000.0 * std::pow(250'000.0, exponent)));
        b.run_to(std::min(b.now + step, to), step);
      }
    };
    until(3s);
    b.write(Reg::inject_missing_acp, 20);
    b.write(Reg::inject_stall_ms, 300);
    b.write(Reg::inject_extra_acp, 9);
    until(6s);
    b.write(Reg::inject_missing_arp, 1);
    b.write(Reg::prf_millihertz, 1'234'567);
    until(12s);
    b.write(Reg::rotation_millirpm, 40'000);
    b.write(Reg::sample_clock_hz, 33'333'333);
    b.write(Reg::acp_per_turn, 450);
    until(15s);
    return std::move(b.output);
  };
  const Output one = run(0);
  EXPECT_GT(one.sweeps.size(), 20'000u);
  EXPECT_EQ(one.of(event::fault_raised).size(), 3u);
  for (const std::uint64_t seed : {1ull, 2ull, 3ull}) {
    const Output other = run(seed);
    EXPECT_TRUE(other.sweeps == one.sweeps);
    EXPECT_TRUE(other.edges == one.edges);
    EXPECT_TRUE(other.events == one.events);
  }
}

TEST(BoardSteps, ThirtyDaysHaveNoTickTooManyOrTooFew) {
  Harness b(Harness::small());
  b.wanted = false;
  // To random places of the month, and a little on from there.
  for (std::uint64_t i = 1; i <= 30; ++i) {
    const auto day = std::chrono::hours(24 * static_cast<int>(i - 1));
    const auto place = Duration(static_cast<std::int64_t>(echo::mixed(i) % 80'000'000'000'000ull));
    b.run_to(day + place, std::chrono::hours(1000));
    b.run_fresh(200ms);
    const Tick now = tick_at(ScenarioTime(b.now), 20'000'000);
    // 20 MHz, 3000 Hz, 24 rpm: pulse n at n * 20e6 / 3000, ACP k at k * 50e6 / 4096, both at the
    // nearest tick, by integers of 128 bits.
    const auto before = [&](Wide numerator, Wide denominator) {
      const Wide n = (static_cast<Wide>(now) * denominator + numerator - 1) / numerator;
      const auto tick = [&](Wide k) {
        return (2 * k * numerator + denominator) / (2 * denominator);
      };
      Wide k = n + 2;
      while (k > 0 && tick(k - 1) >= static_cast<Wide>(now)) --k;
      return static_cast<std::uint64_t>(k);
    };
    const std::uint64_t triggers = before(20'000'000, 3000);
    const std::uint64_t acps = before(50'000'000, 4096);
    ASSERT_EQ(b.read_wide(Reg::trigger_count_low), triggers);
    ASSERT_EQ(b.read(board::address_of(board::Digdar::acp_count)),
              static_cast<std::uint32_t>(acps));
    ASSERT_EQ(b.read(Reg::arp_count), (now + 49'999'999) / 50'000'000);
    ASSERT_EQ(b.read(Reg::acp_per_arp), 4096u);
    ASSERT_EQ(b.read_wide(Reg::clocks_low), now);
    Wide n = static_cast<Wide>(triggers);
    const auto edges = b.output.of(board::Line::trigger);
    ASSERT_EQ(edges.size(), 600u);
    for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge) {
      ASSERT_EQ(static_cast<Wide>(*edge), (2 * --n * 20'000'000 + 3000) / 6000);
    }
  }
  // Whole turns at the end of it.
  b.run_to(720h, 1000h);
  b.run_fresh(2 * 2500ms);
  EXPECT_EQ(b.output.of(board::Line::trigger).size(), 15'000u);
  EXPECT_EQ(b.output.of(board::Line::acp).size(), 8192u);
  const auto arps = b.output.of(board::Line::arp);
  ASSERT_EQ(arps.size(), 2u);
  EXPECT_EQ(arps[0], 720ull * 3600 * 20'000'000);
  EXPECT_EQ(arps[1], 720ull * 3600 * 20'000'000 + 50'000'000);
  EXPECT_EQ(b.read(Reg::faults_latched), 0u);
}

TEST(BoardSteps, TimeLeftOutIsCountedAsIfItHadBeenSeen) {
  // Every two seconds of it seen, against a jump; with all that disturbs, blanking by trigger too.
  Harness seen(everything()), jumped(everything());
  seen.wanted = jumped.wanted = false;
  for (Harness* b : {&seen, &jumped}) {
    b->run_to(100ms);
    b->write(Reg::inject_missing_acp, 10);
    b->write(Reg::inject_stall_ms, 1500);
  }
  seen.run_to(70s, 200ms);
  jumped.run_to(70s, 70s);
  for (const board::RegisterInfo& info : board::all_registers()) {
    EXPECT_EQ(seen.read(info.address), jumped.read(info.address)) << info.name;
  }
  for (const board::RegisterInfo& info : board::digdar_infos()) {
    EXPECT_EQ(seen.read(info.address), jumped.read(info.address)) << info.name;
  }
  EXPECT_EQ(jumped.read(Reg::faults), 0u);
  EXPECT_EQ(jumped.read(Reg::faults_latched), board::fault::acp_missing | board::fault::stalled);
  EXPECT_TRUE(seen.run_fresh(100ms).edges == jumped.run_fresh(100ms).edges);
}

TEST(BoardSteps, SweepsTooFarBehindAreCountedAndNotMade) {
  Harness b(Harness::small());
  b.run_to(1s);
  b.run_fresh(1s, 1s);
  // The last quarter of the second is made.
  EXPECT_EQ(b.output.sweeps.size(), 750u);
  EXPECT_EQ(b.read(Reg::sweeps_late), 2250u);
  EXPECT_EQ(b.board.counters().sweeps_late, 2250u);
  EXPECT_EQ(b.read_wide(Reg::trigger_count_low), 6000u) << "counted they are all";
  EXPECT_EQ(b.output.sweeps.front().meta.trigger_count, 5251u);
  EXPECT_EQ(b.read(Reg::faults), board::fault::late);
  EXPECT_EQ(b.output.of(event::fault_raised, board::fault::late).size(), 1u);
  EXPECT_EQ(b.output.edges.front().tick, 35'000'000u) << "edges likewise";
  b.run_fresh(50ms);
  EXPECT_EQ(b.read(Reg::faults), 0u);
  EXPECT_EQ(b.output.of(event::fault_cleared, board::fault::late).size(), 1u);
}

TEST(BoardSteps, WithoutWishesNoEchoIsAskedForAndNothingIsLate) {
  Harness b;
  b.wanted = false;
  b.run_to(10s, 3s);
  EXPECT_EQ(b.echoes_found, 0u);
  EXPECT_EQ(b.read(Reg::sweeps_late), 0u);
  EXPECT_EQ(b.board.counters().sweeps, 0u);
  EXPECT_EQ(b.board.counters().triggers, 30'000u);
  EXPECT_EQ(b.read_wide(Reg::latched_trigger_count_low), 30'000u) << "it runs all the same";
}

TEST(BoardSteps, TimeThatStandsOrGoesBackGivesNothing) {
  Harness b(Harness::small());
  b.run_to(1s);
  b.forget();
  for (const Duration now : {1000ms, 900ms, 0ms}) {
    b.board.advance(ScenarioTime(now), Harness::utc_zero(), true, b.batch);
    EXPECT_TRUE(b.batch.records.empty());
  }
  b.run_to(1100ms);
  EXPECT_EQ(b.output.sweeps.size(), 300u);
}

}  // namespace
}  // namespace skerry::server
