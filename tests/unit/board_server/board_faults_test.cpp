// Every fault as a board shows it: in the edges, the counts, the azimuths, the bits and the events,
// and how it goes away.
#include "tests/unit/board_server/board_harness.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
namespace fault = board::fault;
namespace event = board::event;

// 20.48 MHz at 24 rpm: 12,500 ticks to an ACP of 4096; a turn is 2.5 s.
constexpr Duration kTurn = 2500ms;
constexpr double kTurnTicks = 51'200'000.0;

class BoardFaults : public testing::Test {
 protected:
  BoardFaults() : b(Harness::small({{Reg::sample_clock_hz, 20'480'000}})) {
    // Into the second whole turn.
    b.run_to(kTurn + 10ms);
    EXPECT_EQ(b.read(Reg::faults), 0u);
    b.forget();
  }

  // Azimuth counted minus azimuth undisturbed, in ACPs, of the sweep next to a time.
  double skew_at(Duration when) const {
    const Tick tick = tick_at(ScenarioTime(when), 20'480'000);
    for (const board::Sweep& sweep : b.output.sweeps) {
      if (sweep.meta.trigger_tick < tick) continue;
      const double truth = std::fmod(static_cast<double>(sweep.meta.trigger_tick), kTurnTicks);
      double off = board::azimuth_turns(sweep.meta) - truth / kTurnTicks;
      off -= std::floor(off + 0.5);
      return off * 4096;
    }
    ADD_FAILURE() << "no sweep";
    return 0.0;
  }
  void expect_recovered() {
    b.run_fresh(2 * kTurn);
    EXPECT_EQ(b.read(Reg::faults), 0u);
    EXPECT_EQ(b.read(Reg::acp_per_arp), 4096u);
    EXPECT_NEAR(skew_at(b.now - 1s), 0.0, 1e-4);
    EXPECT_TRUE(b.output.of(event::fault_raised).empty());
  }

  Harness b;
};

TEST_F(BoardFaults, WithoutFaultsNothingIsRaisedAndAzimuthsAreTrue) {
  b.run_to(2 * kTurn + 10ms);
  EXPECT_EQ(b.output.of(board::Line::acp).size(), 4096u);
  EXPECT_EQ(b.output.of(board::Line::trigger).size(), 7500u);
  EXPECT_EQ(b.output.sweeps.size(), 7500u);
  EXPECT_EQ(b.output.of(board::Line::arp).size(), 1u);
  EXPECT_EQ(b.output.of(board::Line::heading).size(), 1u);
  EXPECT_EQ(b.output.of(event::heading).size(), 1u);
  ASSERT_EQ(b.output.of(event::arp).size(), 1u);
  EXPECT_EQ(b.output.of(event::arp)[0].value, 3u);
  EXPECT_EQ(b.output.of(event::arp)[0].tick, 102'400'000u);
  for (auto when = kTurn + 20ms; when < 2 * kTurn; when += 100ms) {
    EXPECT_NEAR(skew_at(when), 0.0, 1e-4);
  }
  EXPECT_EQ(b.read(Reg::faults_latched), 0u);
}

TEST_F(BoardFaults, MissingAcps) {
  EXPECT_EQ(b.write(Reg::inject_missing_acp, 5), RegisterError::ok);
  EXPECT_EQ(b.read(Reg::inject_missing_acp), 5u);
  b.run_to(2 * kTurn + 10ms);
  EXPECT_EQ(b.read(Reg::inject_missing_acp), 0u);
  const auto acps = b.output.of(board::Line::acp);
  EXPECT_EQ(acps.size(), 4091u);
  int gaps = 0;
  for (std::size_t i = 1; i < acps.size(); ++i) {
    const Tick gap = acps[i] - acps[i - 1];
    EXPECT_TRUE(gap == 12'500u || gap == 25'000u) << gap;
    if (gap == 25'000u) ++gaps;
  }
  EXPECT_EQ(gaps, 5);
  EXPECT_EQ(b.read(Reg::acp_per_arp), 4091u);
  EXPECT_EQ(b.read(Reg::faults), fault::acp_missing);
  EXPECT_NEAR(skew_at(2 * kTurn - 500ms), -5.0, 1e-3) << "until the ARP";
  EXPECT_NEAR(skew_at(2 * kTurn + 5ms), 0.0, 1e-3) << "from the ARP on";
  const auto raised = b.output.of(event::fault_raised);
  ASSERT_EQ(raised.size(), 1u);
  EXPECT_EQ(raised[0].faults, fault::acp_missing);
  EXPECT_EQ(raised[0].value, 4091u);
  EXPECT_EQ(raised[0].tick, 102'400'000u);
  b.run_fresh(kTurn);
  EXPECT_EQ(b.output.of(event::fault_cleared, fault::acp_missing).size(), 1u);
  EXPECT_EQ(b.read(Reg::faults_latched), fault::acp_missing);
  EXPECT_EQ(b.write(Reg::faults_latched, fault::acp_missing), RegisterError::ok);
  EXPECT_EQ(b.read(Reg::faults_latched), 0u);
  expect_recovered();
}

TEST_F(BoardFaults, ExtraAcps) {
  EXPECT_EQ(b.write(Reg::inject_extra_acp, 7), RegisterError::ok);
  b.run_to(2 * kTurn + 10ms);
  const auto acps = b.output.of(board::Line::acp);
  EXPECT_EQ(acps.size(), 4103u);
  int halves = 0;
  for (std::size_t i = 1; i < acps.size(); ++i) halves += acps[i] - acps[i - 1] == 6250u ? 1 : 0;
  EXPECT_EQ(halves, 14);
  EXPECT_EQ(b.read(Reg::acp_per_arp), 4103u);
  EXPECT_EQ(b.read(Reg::faults), fault::acp_extra);
  EXPECT_NEAR(skew_at(2 * kTurn - 500ms), 7.0, 1e-3);
  EXPECT_NEAR(skew_at(2 * kTurn + 5ms), 0.0, 1e-3);
  EXPECT_EQ(b.output.of(event::fault_raised, fault::acp_extra).size(), 1u);
  expect_recovered();
}

TEST_F(BoardFaults, MissingArps) {
  EXPECT_EQ(b.write(Reg::inject_missing_arp, 1), RegisterError::ok);
  b.run_to(3 * kTurn - 10ms);
  EXPECT_TRUE(b.output.of(board::Line::arp).empty());
  EXPECT_TRUE(b.output.of(event::arp).empty());
  EXPECT_EQ(b.output.of(board::Line::heading).size(), 1u) << "the bow's own pulse still comes";
  EXPECT_EQ(b.read(Reg::faults), fault::arp_missing);
  EXPECT_GT(b.read(Reg::acp_count), 8000u);
  const auto raised = b.output.of(event::fault_raised);
  ASSERT_EQ(raised.size(), 1u);
  EXPECT_EQ(raised[0].tick, (4096u + 6145u) * 12'500u) << "one and a half turns of ACPs, and one";
  EXPECT_NEAR(skew_at(2 * kTurn + 1s), 0.0, 1e-3) << "a whole turn on is no skew";
  b.run_to(3 * kTurn + 10ms);
  EXPECT_EQ(b.read(Reg::acp_per_arp), 8192u);
  EXPECT_EQ(b.read(Reg::faults), fault::arp_missing) << "until a good turn";
  expect_recovered();
}

TEST_F(BoardFaults, AStallOfTheAntenna) {
  EXPECT_EQ(b.write(Reg::inject_stall_ms, 700), RegisterError::ok);
  b.run_for(5ms, 5ms);
  EXPECT_EQ(b.read(Reg::inject_stall_ms), 696u) << "it began with an ACP, less than 1 ms on";
  b.run_to(kTurn + 600ms);
  EXPECT_EQ(b.read(Reg::faults), fault::stalled);
  auto raised = b.output.of(event::fault_raised);
  ASSERT_EQ(raised.size(), 1u);
  const Tick stood = b.output.of(board::Line::acp).back();
  EXPECT_EQ(raised[0].tick, stood + 8 * 12'500u);
  EXPECT_GT(b.output.of(board::Line::trigger).size(), 1700u) << "the transmitter goes on";
  const double stands = board::azimuth_turns(b.output.sweeps.back().meta);
  EXPECT_NEAR(stands, (static_cast<double>(stood) / 12'500.0 - 4096 + 1) / 4096, 1e-6)
      << "a digitiser goes on counting by time, up to the next ACP that does not come";
  b.run_to(2 * kTurn);
  EXPECT_EQ(b.read(Reg::faults), 0u);
  const auto acps = b.output.of(board::Line::acp);
  const auto after = std::upper_bound(acps.begin(), acps.end(), stood);
  ASSERT_NE(after, acps.end());
  EXPECT_EQ(*after, stood + 12'500u + 700u * 20'480u);
  const auto cleared = b.output.of(event::fault_cleared, fault::stalled);
  ASSERT_EQ(cleared.size(), 1u);
  EXPECT_EQ(cleared[0].tick, *after);
  // No ACP was lost: the turn ends with all of them, 0.7 s late.
  b.run_to(2 * kTurn + 710ms);
  EXPECT_EQ(b.read(Reg::acp_per_arp), 4096u);
  EXPECT_EQ(b.output.of(board::Line::arp).back(), 102'400'000u + 700u * 20'480u);
  EXPECT_EQ(b.read(Reg::faults), 0u);
}

TEST_F(BoardFaults, TheEchoFollowsTheAntennaAndNotThePulses) {
  b.write(Reg::inject_missing_acp, 100);
  b.write(Reg::inject_missing_arp, 1);
  b.write(Reg::inject_extra_acp, 30);
  b.echoes[1]->asked.clear();
  b.run_to(3 * kTurn);
  ASSERT_GT(b.echoes[1]->asked.size(), 4096u);
  for (const FakeEchoes::Asked& asked : b.echoes[1]->asked) {
    // Rows n and n + 1 about where it points.
    const double turns = static_cast<double>(asked.when.time_since_epoch().count()) / 2.5e9;
    const double ahead = static_cast<double>(asked.row) - turns * 4096;
    ASSERT_GT(ahead, -1.001);
    ASSERT_LT(ahead, 1.001);
  }
}

TEST_F(BoardFaults, SweepsSayTheFaultsOfTheirTrigger) {
  b.write(Reg::inject_missing_acp, 1);
  b.run_to(2 * kTurn + 10ms);
  for (const board::Sweep& sweep : b.output.sweeps) {
    const bool later = sweep.meta.trigger_tick >= 102'400'000u;
    ASSERT_EQ(sweep.meta.faults, later ? fault::acp_missing : 0u);
  }
}

TEST_F(BoardFaults, EventsThatAreNotEnabledAreCountedButNotSent) {
  b.write(Reg::events, 0x7F);
  b.write(Reg::event_enable, event::fault_raised);
  b.write(Reg::inject_missing_acp, 1);
  b.run_to(3 * kTurn + 10ms);
  EXPECT_EQ(b.output.events.size(), 1u);
  EXPECT_EQ(b.output.of(event::fault_raised).size(), 1u);
  EXPECT_EQ(b.read(Reg::events),
            event::arp | event::heading | event::fault_raised | event::fault_cleared);
  b.write(Reg::events, event::arp | event::fault_raised);
  EXPECT_EQ(b.read(Reg::events), event::heading | event::fault_cleared);
}

TEST_F(BoardFaults, AWriteSetsHowManyInjectionsAreStillToCome) {
  EXPECT_EQ(b.write(Reg::inject_missing_arp, 600), RegisterError::ok);
  EXPECT_EQ(b.write(Reg::inject_missing_arp, 1000), RegisterError::ok);
  EXPECT_EQ(b.write(Reg::inject_missing_arp, 1001), RegisterError::out_of_range);
  EXPECT_EQ(b.read(Reg::inject_missing_arp), 1000u);
  b.run_for(kTurn);
  EXPECT_EQ(b.read(Reg::inject_missing_arp), 999u);
  EXPECT_EQ(b.write(Reg::inject_missing_arp, 1), RegisterError::ok);
  EXPECT_EQ(b.read(Reg::inject_missing_arp), 1u);
  b.run_for(kTurn);
  EXPECT_EQ(b.read(Reg::inject_missing_arp), 0u);
  b.run_fresh(2 * kTurn);
  EXPECT_EQ(b.output.of(board::Line::arp).size(), 2u);
}

TEST_F(BoardFaults, ZeroCancelsWhatWasToBeInjected) {
  const Reg all[] = {Reg::inject_missing_acp, Reg::inject_extra_acp, Reg::inject_missing_arp};
  for (const Reg reg : all) b.write(reg, 1000);
  b.run_for(10ms);
  EXPECT_EQ(b.read(Reg::inject_missing_acp), 999u) << "16 ACPs in 9.8 ms";
  for (const Reg reg : all) {
    EXPECT_EQ(b.write(reg, 0), RegisterError::ok);
    EXPECT_EQ(b.read(reg), 0u);
  }
  b.run_for(10ms);
  for (const Reg reg : all) EXPECT_EQ(b.read(reg), 0u);
  b.run_for(2 * kTurn);
  expect_recovered();
}

TEST_F(BoardFaults, AStallInProgressIsCutShortOrMadeLonger) {
  b.write(Reg::inject_stall_ms, 60'000);
  b.run_for(200ms);
  EXPECT_EQ(b.read(Reg::faults), fault::stalled);
  const Tick stood = b.output.of(board::Line::acp).back();
  b.write(Reg::inject_stall_ms, 300);
  b.run_for(100ms);
  EXPECT_EQ(b.read(Reg::inject_stall_ms), 200u);
  EXPECT_EQ(b.output.of(board::Line::acp).back(), stood);
  b.write(Reg::inject_stall_ms, 0);
  EXPECT_EQ(b.read(Reg::inject_stall_ms), 0u);
  const Tick now = tick_at(ScenarioTime(b.now), 20'480'000);
  b.run_for(100ms);
  EXPECT_EQ(b.read(Reg::inject_stall_ms), 0u);
  EXPECT_EQ(b.read(Reg::faults), 0u);
  const auto acps = b.output.of(board::Line::acp);
  const auto after = std::upper_bound(acps.begin(), acps.end(), stood);
  ASSERT_NE(after, acps.end());
  EXPECT_EQ(*after, now + 12'500u);
  b.run_to(2 * kTurn + 400ms);
  EXPECT_EQ(b.read(Reg::acp_per_arp), 4096u) << "no ACP was lost";
  EXPECT_EQ(b.output.of(board::Line::arp).back(), 102'400'000u + (now - stood));
}

TEST_F(BoardFaults, AllBitsClearWhatIsLatched) {
  b.write(Reg::inject_missing_acp, 1);
  b.run_to(2 * kTurn + 10ms);
  EXPECT_NE(b.read(Reg::faults_latched), 0u);
  EXPECT_NE(b.read(Reg::events), 0u);
  EXPECT_EQ(b.write(Reg::faults_latched, 0xFFFF'FFFF), RegisterError::ok);
  EXPECT_EQ(b.write(Reg::events, 0xFFFF'FFFF), RegisterError::ok);
  EXPECT_EQ(b.read(Reg::faults_latched), 0u);
  EXPECT_EQ(b.read(Reg::events), 0u);
}

TEST_F(BoardFaults, ChangesOfFaultsAreToldWhateverEventsAreEnabled) {
  b.write(Reg::event_enable, 0);
  b.write(Reg::inject_missing_acp, 1);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> changes;
  while (b.now < 3 * kTurn + 10ms) {
    b.run_for(50ms);
    for (const auto& [raised, cleared] : b.batch.fault_changes) {
      changes.emplace_back(raised, cleared);
    }
  }
  EXPECT_TRUE(b.output.events.empty());
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> expected = {{fault::acp_missing, 0},
                                                                         {0, fault::acp_missing}};
  EXPECT_EQ(changes, expected);
}

}  // namespace
}  // namespace skerry::server
