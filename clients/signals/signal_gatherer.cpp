#include "clients/signals/signal_gatherer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skerry::client {
namespace {

std::uint64_t bytes_of(const board::Sweep& sweep) {
  return sizeof(sweep) + 2 * (sweep.samples[0].size() + sweep.samples[1].size());
}

// Ticks beyond any board's life, and stretches beyond any turn.
constexpr std::uint64_t kMaxTick = 1ull << 62;

bool is_sane(const board::Edges& edges) {
  if (edges.sample_clock_hz == 0 || edges.to_tick > kMaxTick) return false;
  if (edges.from_tick > edges.to_tick) return false;
  const double seconds =
      static_cast<double>(edges.to_tick - edges.from_tick) / edges.sample_clock_hz;
  if (seconds > SignalGatherer::kLongestTurnSeconds) return false;
  std::uint64_t before = edges.from_tick;
  for (const board::Edge& edge : edges.edges) {
    if (edge.tick < before || edge.tick >= edges.to_tick) return false;
    before = edge.tick;
  }
  return true;
}

bool triggered_before(const board::Sweep& sweep, std::uint64_t tick) {
  return sweep.meta.trigger_tick < tick;
}

}  // namespace

SignalGatherer::State SignalGatherer::fail(std::string why) {
  error_ = std::move(why);
  return state_ = State::broken;
}

SignalGatherer::State SignalGatherer::fail_large() {
  return fail(fmt::format("the recording grew beyond {} MiB after {:.1f} s", wish_.max_bytes >> 20,
                          seconds()));
}

void SignalGatherer::restart() {
  if (state_ == State::broken) return;
  *this = SignalGatherer(wish_);
}

SignalGatherer::State SignalGatherer::add(const board::Record& record) {
  if (state_ == State::done || state_ == State::broken) return state_;
  if (const auto* edges = std::get_if<board::Edges>(&record)) return add_edges(*edges);
  if (const auto* sweep = std::get_if<board::Sweep>(&record)) return add_sweep(*sweep);
  return state_;
}

SignalGatherer::State SignalGatherer::add_edges(const board::Edges& edges) {
  if (!is_sane(edges)) return fail("the board sent edges that are not in order");
  if (covered_any_ && edges.sample_clock_hz != recording_.sample_clock_hz) {
    return fail(fmt::format("the sample clock changed from {} to {} Hz meanwhile",
                            recording_.sample_clock_hz, edges.sample_clock_hz));
  }
  if (covered_any_ && edges.from_tick != covered_to_) {
    // A gap, or the board's clock was set back: what came before does not belong to it.
    restart();
  }
  if (!std::exchange(covered_any_, true)) {
    recording_.sample_clock_hz = edges.sample_clock_hz;
    covered_from_ = last_arp_ = edges.from_tick;
  }
  covered_to_ = edges.to_tick;
  recording_.edges.insert(recording_.edges.end(), edges.edges.begin(), edges.edges.end());
  bytes_ += edges.edges.size() * sizeof(board::Edge);
  if (!begin_) find_begin();
  if (begin_ && !end_) find_end();
  for (const board::Edge& edge : edges.edges) {
    if (edge.line == board::Line::arp) last_arp_ = edge.tick;
  }
  const double no_arp = static_cast<double>(covered_to_ - last_arp_) / recording_.sample_clock_hz;
  if (wish_.turns > 0 && !end_ && no_arp > kLongestTurnSeconds) {
    return fail(fmt::format("no ARP for {:.0f} s: the antenna stands still", no_arp));
  }
  if (bytes_ > wish_.max_bytes) return fail_large();
  if (!begin_) {
    const std::uint64_t kept = wish_.lead_ticks;
    forget_before(covered_to_ > kept ? covered_to_ - kept : 0);
  } else if (end_ && covered_to_ >= *end_ && sweeps_are_complete()) {
    state_ = State::done;
  }
  return state_;
}

SignalGatherer::State SignalGatherer::add_sweep(const board::Sweep& sweep) {
  const std::uint64_t tick = sweep.meta.trigger_tick;
  if (!wish_.sweeps || (begin_ && tick < *begin_)) return state_;
  if (sweep.meta.spokes_per_turn != 0) {
    return fail("the board forms spokes (SPOKES_PER_TURN), a trigger has no video of its own");
  }
  auto& sweeps = recording_.sweeps;
  const auto at = std::lower_bound(sweeps.begin(), sweeps.end(), tick, triggered_before);
  if (at != sweeps.end() && at->meta.trigger_tick == tick) return state_;
  bytes_ += bytes_of(sweep);
  sweeps.insert(at, sweep);
  if (bytes_ > wish_.max_bytes) return fail_large();
  if (end_ && covered_to_ >= *end_ && sweeps_are_complete()) state_ = State::done;
  return state_;
}

void SignalGatherer::find_begin() {
  if (wish_.turns == 0) {
    begin_ = covered_from_;
  } else {
    for (const board::Edge& edge : recording_.edges) {
      if (edge.line != board::Line::arp) continue;
      if (edge.tick < covered_from_ + wish_.lead_ticks) continue;
      begin_ = edge.tick - wish_.lead_ticks;
      break;
    }
  }
  if (!begin_) return;
  forget_before(*begin_);
  state_ = State::gathering;
}

void SignalGatherer::find_end() {
  if (wish_.turns == 0) {
    end_ = *begin_ + static_cast<std::uint64_t>(
                         std::llround(std::max(wish_.seconds * recording_.sample_clock_hz, 1.0)));
    return;
  }
  for (; scanned_ < recording_.edges.size() && !end_; ++scanned_) {
    const board::Edge& edge = recording_.edges[scanned_];
    if (edge.line != board::Line::arp) continue;
    if (turns_ == wish_.turns) {
      end_ = edge.tick - wish_.lead_ticks;
    } else {
      ++turns_;
    }
  }
}

void SignalGatherer::forget_before(std::uint64_t tick) {
  const auto first_edge = std::find_if(recording_.edges.begin(), recording_.edges.end(),
                                       [&](const board::Edge& edge) { return edge.tick >= tick; });
  recording_.edges.erase(recording_.edges.begin(), first_edge);
  const auto first_sweep =
      std::lower_bound(recording_.sweeps.begin(), recording_.sweeps.end(), tick, triggered_before);
  recording_.sweeps.erase(recording_.sweeps.begin(), first_sweep);
  bytes_ = recording_.edges.size() * sizeof(board::Edge);
  for (const board::Sweep& sweep : recording_.sweeps) bytes_ += bytes_of(sweep);
}

// Every trigger has its sweep, or they would have come by now.
bool SignalGatherer::sweeps_are_complete() const {
  if (!wish_.sweeps) return true;
  const auto late = static_cast<std::uint64_t>(kOutOfOrderSeconds * recording_.sample_clock_hz);
  if (covered_to_ >= *end_ + late) return true;
  const auto triggers =
      std::count_if(recording_.edges.begin(), recording_.edges.end(), [&](const board::Edge& edge) {
        return edge.line == board::Line::trigger && edge.tick < *end_;
      });
  const auto sweeps = std::lower_bound(recording_.sweeps.begin(), recording_.sweeps.end(), *end_,
                                       triggered_before) -
                      recording_.sweeps.begin();
  return sweeps >= triggers;
}

double SignalGatherer::seconds() const {
  if (!begin_ || covered_to_ <= *begin_) return 0.0;
  return static_cast<double>(covered_to_ - *begin_) / recording_.sample_clock_hz;
}

double SignalGatherer::done() const {
  if (state_ == State::done) return 1.0;
  if (!begin_) return 0.0;
  if (wish_.turns == 0) return std::min(seconds() / wish_.seconds, 1.0);
  return turns_ == 0 ? 0.0 : (turns_ - 1.0) / wish_.turns;
}

SignalRecording SignalGatherer::take() {
  SignalRecording recording = std::move(recording_);
  recording.from_tick = *begin_;
  recording.to_tick = end_ && *end_ <= covered_to_ ? *end_ : covered_to_;
  const auto first_edge =
      std::find_if(recording.edges.begin(), recording.edges.end(),
                   [&](const board::Edge& edge) { return edge.tick >= recording.to_tick; });
  recording.edges.erase(first_edge, recording.edges.end());
  recording.sweeps.erase(std::lower_bound(recording.sweeps.begin(), recording.sweeps.end(),
                                          recording.to_tick, triggered_before),
                         recording.sweeps.end());
  *this = SignalGatherer(wish_);
  return recording;
}

}  // namespace skerry::client
