// SignalGatherer: a SignalRecording out of the records of a board's stream.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "clients/signals/signal_recording.hpp"

namespace skerry::client {

// The signals to gather.
struct SignalWish {
  // Whole turns, from ARP to ARP; 0: `seconds` from the first record on instead.
  std::uint32_t turns = 0;
  double seconds = 0.0;
  bool sweeps = false;  // they come in the stream, and are wanted
  // A recording of turns begins so many ticks before its first ARP and ends as many before its
  // last, so that the first edge is seen to rise: at least one sample of the slowest waveform.
  std::uint64_t lead_ticks = 1;
  std::uint64_t max_bytes = 1ull << 30;  // of memory
};

// Holds the recording in memory, 16 bytes for an edge, 2 for a sample, and breaks off where they
// get too many.  Records may come in any order within kOutOfOrderSeconds; of the edges, each
// stretch must follow the one before.
// Thread: one at a time.
class SignalGatherer {
 public:
  // No ARP for so long on the board's clock: the antenna stands still.
  static constexpr double kLongestTurnSeconds = 60.0;
  static constexpr double kOutOfOrderSeconds = 0.3;

  explicit SignalGatherer(const SignalWish& wish) : wish_(wish) {}

  // How far it is.  broken: error() says why; nothing more can come of it.
  enum class State : std::uint8_t { waiting, gathering, done, broken };
  State add(const board::Record& record);
  // Records are missing: what there is goes, and it begins anew.
  void restart();

  State state() const { return state_; }
  const std::string& error() const { return error_; }
  // Share that is gathered, 0 .. 1, and seconds.
  double done() const;
  double seconds() const;

  // In state done: everything that was asked for.  In state gathering: what has come until now.
  // Requires one of these states.  The gatherer is empty afterwards.
  SignalRecording take();

 private:
  State add_edges(const board::Edges& edges);
  State add_sweep(const board::Sweep& sweep);
  State fail(std::string why);
  State fail_large();
  void find_begin();
  void find_end();
  void forget_before(std::uint64_t tick);
  bool sweeps_are_complete() const;

  SignalWish wish_;
  State state_ = State::waiting;
  std::string error_;
  SignalRecording recording_;
  bool covered_any_ = false;
  std::uint64_t covered_from_ = 0, covered_to_ = 0;  // by edges
  std::optional<std::uint64_t> begin_, end_;
  std::size_t scanned_ = 0;     // edges of it that find_end() has seen
  std::uint32_t turns_ = 0;     // begun
  std::uint64_t last_arp_ = 0;  // or where waiting for one began
  std::uint64_t bytes_ = 0;
};

}  // namespace skerry::client
