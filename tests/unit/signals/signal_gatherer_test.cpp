#include "clients/signals/signal_gatherer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/signals/synthetic_recording.hpp"

namespace skerry::client {
namespace {

using namespace testing_signals;
using board::Edge;
using board::Line;
using State = SignalGatherer::State;

constexpr std::uint32_t kClock = 20'000'000;
constexpr std::uint64_t kTurn = 50'000'000;  // 2.5 s

// A board with an ARP at kTurn, 2 * kTurn, ..., an ACP with it and 15 more each turn, a trigger
// every 100 000 ticks, and what happens within [from, to).
struct SmallBoard {
  std::uint32_t samples = 4;

  board::Edges edges(std::uint64_t from, std::uint64_t to) const {
    board::Edges all{.sample_clock_hz = kClock, .from_tick = from, .to_tick = to, .edges = {}};
    for (std::uint64_t t = from; t < to; t += 100'000 - t % 100'000) {
      if (t % 100'000 == 0 && t % kTurn != 0) all.edges.push_back({t, Line::trigger});
      if (t % (kTurn / 20) == 0) all.edges.push_back({t, Line::acp});
      if (t % kTurn == 0) all.edges.push_back({t, Line::arp});
    }
    return all;
  }
  std::vector<board::Sweep> sweeps(std::uint64_t from, std::uint64_t to) const {
    std::vector<board::Sweep> all;
    for (const Edge& edge : edges(from, to).edges) {
      if (edge.line != Line::trigger) continue;
      board::Sweep sweep;
      sweep.meta.trigger_tick = edge.tick;
      sweep.meta.sample_clock_hz = kClock;
      sweep.samples[0].assign(samples, 7);
      all.push_back(sweep);
    }
    return all;
  }
};

constexpr std::uint64_t kStep = 123'457;

// The board's records from `from` on until the gatherer has all; false after ten turns.
enum class Order : std::uint8_t { edges_first, sweeps_first, sweeps_a_step_late };
bool gather(SignalGatherer& gatherer, std::uint64_t from, Order order) {
  const SmallBoard board;
  const std::uint64_t begin = from;
  for (; from < begin + 10 * kTurn; from += kStep) {
    if (order == Order::edges_first) gatherer.add(board.edges(from, from + kStep));
    const std::uint64_t delay = order == Order::sweeps_a_step_late ? kStep : 0;
    if (from - begin >= delay) {
      for (const board::Sweep& sweep : board.sweeps(from - delay, from - delay + kStep)) {
        gatherer.add(sweep);
      }
    }
    if (order != Order::edges_first) gatherer.add(board.edges(from, from + kStep));
    if (gatherer.state() == State::done) return true;
  }
  return false;
}

std::ptrdiff_t count(const SignalRecording& recording, Line line) {
  return std::count_if(recording.edges.begin(), recording.edges.end(),
                       [&](const Edge& edge) { return edge.line == line; });
}

TEST(SignalGatherer, TurnsBeginTheLeadBeforeAnArpAndAreWhole) {
  for (const Order order : {Order::edges_first, Order::sweeps_first, Order::sweeps_a_step_late}) {
    SignalGatherer gatherer({.turns = 2, .sweeps = true, .lead_ticks = 10});
    ASSERT_TRUE(gather(gatherer, 12'345, order));
    EXPECT_EQ(gatherer.done(), 1.0);
    const SignalRecording recording = gatherer.take();
    EXPECT_EQ(recording.sample_clock_hz, kClock);
    EXPECT_EQ(recording.from_tick, kTurn - 10);
    EXPECT_EQ(recording.to_tick, 3 * kTurn - 10);
    EXPECT_EQ(count(recording, Line::arp), 2);
    EXPECT_EQ(count(recording, Line::acp), 40);
    EXPECT_EQ(count(recording, Line::trigger), 998);
    ASSERT_EQ(recording.sweeps.size(), 998u);
    for (std::size_t k = 1; k < recording.sweeps.size(); ++k) {
      ASSERT_LT(recording.sweeps[k - 1].meta.trigger_tick, recording.sweeps[k].meta.trigger_tick);
    }
  }
}

TEST(SignalGatherer, AnArpTooEarlyForItsLeadIsNotTheFirst) {
  SignalGatherer gatherer({.turns = 1, .sweeps = true, .lead_ticks = 10});
  ASSERT_TRUE(gather(gatherer, kTurn - 9, Order::edges_first));
  EXPECT_EQ(gatherer.take().from_tick, 2 * kTurn - 10);
}

TEST(SignalGatherer, SecondsBeginAtTheFirstRecord) {
  SignalGatherer gatherer({.seconds = 0.25, .sweeps = true});
  ASSERT_TRUE(gather(gatherer, 777, Order::edges_first));
  const SignalRecording recording = gatherer.take();
  EXPECT_EQ(recording.from_tick, 777u);
  EXPECT_EQ(recording.to_tick, 777u + kClock / 4);
  EXPECT_EQ(recording.sweeps.size(), 50u);
  EXPECT_EQ(recording.seconds(), 0.25);
}

TEST(SignalGatherer, IsNotKeptWaitingBySweepsThatTheBoardNeverMade) {
  const SmallBoard board;
  SignalGatherer gatherer({.seconds = 0.25, .sweeps = true});
  std::uint64_t tick = 0;
  while (gatherer.add(board.edges(tick, tick + kStep)) == State::gathering) tick += kStep;
  EXPECT_EQ(gatherer.state(), State::done);
  EXPECT_GE(tick + kStep, static_cast<std::uint64_t>(0.55 * kClock));
  EXPECT_LT(tick, static_cast<std::uint64_t>(0.55 * kClock));
  EXPECT_TRUE(gatherer.take().sweeps.empty());
}

TEST(SignalGatherer, BeginsAnewWhereEdgesAreMissing) {
  const SmallBoard board;
  SignalGatherer gatherer({.turns = 1, .lead_ticks = 1});
  gatherer.add(board.edges(0, kTurn + 5));
  EXPECT_EQ(gatherer.state(), State::gathering);
  gatherer.add(board.edges(kTurn + 6, kTurn + 100));  // one tick is missing
  EXPECT_EQ(gatherer.state(), State::waiting);
  gatherer.add(board.edges(kTurn + 100, 3 * kTurn));
  EXPECT_EQ(gatherer.add(board.edges(3 * kTurn, 3 * kTurn + 100)), State::done);
  EXPECT_EQ(gatherer.take().from_tick, 2 * kTurn - 1);
}

TEST(SignalGatherer, GivesWhatThereIsWhenItIsEndedEarly) {
  const SmallBoard board;
  SignalGatherer gatherer({.turns = 3, .sweeps = true});
  gatherer.add(board.edges(0, kTurn + kTurn / 2));
  for (const board::Sweep& sweep : board.sweeps(kTurn, 2 * kTurn)) gatherer.add(sweep);
  EXPECT_EQ(gatherer.state(), State::gathering);
  EXPECT_LT(gatherer.done(), 1.0);
  const SignalRecording recording = gatherer.take();
  EXPECT_EQ(recording.to_tick, kTurn + kTurn / 2);
  EXPECT_EQ(recording.sweeps.back().meta.trigger_tick, kTurn + kTurn / 2 - 100'000);
  EXPECT_EQ(gatherer.state(), State::waiting);
}

TEST(SignalGatherer, WillNotWaitForAnAntennaThatStandsStill) {
  SignalGatherer gatherer({.turns = 1});
  State state = State::waiting;
  for (std::uint64_t t = 1; state == State::waiting; t += kClock) {
    state = gatherer.add(board::Edges{
        .sample_clock_hz = kClock, .from_tick = t, .to_tick = t + kClock, .edges = {}});
  }
  EXPECT_EQ(state, State::broken);
  EXPECT_EQ(gatherer.error(), "no ARP for 61 s: the antenna stands still");
}

TEST(SignalGatherer, BelievesNothingUnchecked) {
  const auto broken = [](const board::Record& record) {
    SignalGatherer gatherer({.seconds = 1.0, .sweeps = true});
    return gatherer.add(record) == State::broken;
  };
  EXPECT_TRUE(broken(board::Edges{.sample_clock_hz = kClock,
                                  .from_tick = 100,
                                  .to_tick = 200,
                                  .edges = {{150, Line::acp}, {149, Line::acp}}}));
  EXPECT_TRUE(broken(board::Edges{
      .sample_clock_hz = kClock, .from_tick = 100, .to_tick = 200, .edges = {{200, Line::acp}}}));
  EXPECT_TRUE(broken(
      board::Edges{.sample_clock_hz = kClock, .from_tick = 100, .to_tick = 99, .edges = {}}));
  EXPECT_TRUE(
      broken(board::Edges{.sample_clock_hz = 0, .from_tick = 1, .to_tick = 2, .edges = {}}));
  EXPECT_TRUE(broken(board::Edges{
      .sample_clock_hz = kClock, .from_tick = 1, .to_tick = 1 + 61ull * kClock, .edges = {}}));
  EXPECT_TRUE(broken(board::Edges{
      .sample_clock_hz = kClock, .from_tick = ~0ull - 10, .to_tick = ~0ull - 1, .edges = {}}));
  board::Sweep spoke;
  spoke.meta.spokes_per_turn = 2048;
  EXPECT_TRUE(broken(spoke));
}

TEST(SignalGatherer, MemoryIsBounded) {
  const SmallBoard board{.samples = 16384};
  SignalGatherer gatherer({.seconds = 3600.0, .sweeps = true, .max_bytes = 32u << 20});
  State state = State::gathering;
  std::uint64_t tick = 0;
  for (; state != State::broken; tick += kTurn) {
    state = gatherer.add(board.edges(tick, tick + kTurn));
    for (const board::Sweep& sweep : board.sweeps(tick, tick + kTurn)) {
      if (state != State::broken) state = gatherer.add(sweep);
    }
  }
  EXPECT_THAT(gatherer.error(), testing::StartsWith("the recording grew beyond 32 MiB after"));
  // 33 KB each, 200 a second.
  EXPECT_NEAR(static_cast<double>(tick) / kClock, 5.1, 2.5);
}

}  // namespace
}  // namespace skerry::client
