// Player: plays a recording's items at their pace into the views and the state of a playback.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "server/core/utc_clock.hpp"
#include "server/playback/pace_watch.hpp"
#include "server/playback/piece_reader.hpp"
#include "server/playback/play_clock.hpp"
#include "server/playback/recorded_radars.hpp"
#include "server/playback/turn_finder.hpp"
#include "server/relayed/relayed_state.hpp"
#include "server/relayed/relayed_view.hpp"

namespace skerry::server {

inline constexpr double kSlowestRate = 0.1, kFastestRate = 100.0;
inline constexpr int kMostSteps = 1000;  // of one order, to either side

// An operator's order to a playback; absent members change nothing.  A seek comes before steps.
struct PlayOrder {
  std::optional<bool> playing = {};
  std::optional<double> rate = {};  // kSlowestRate .. kFastestRate
  std::optional<bool> loop = {};
  std::optional<UtcTime> seek = {};  // within the recording
  int steps = 0;                     // turns; then pause
};

struct PlayerStanding {
  UtcTime place{};  // while it catches up: where to
  bool playing = false;
  double rate = 1.0;
  bool loop = false;
  std::string problem;  // what could not be read; that it falls behind the rate, while it does
};

struct PlayerOptions {
  bool playing = true;
  double rate = 1.0;
  bool loop = false;
  std::optional<UtcTime> from = {};  // absent: the begin
  bool current_timestamps = false;
};

// Spokes leave in sectors of up to 16, when the last of them is due: an absolute time, the rate's
// fraction of the recorded one from the last change on.  One that falls behind by kGiveUp (a disk
// or a machine that is too slow for the rate) goes on from there, and says so: nothing is left out.
//
// After a seek or a step the turn before it is played quickly (kCatchUp), so that consoles have
// the picture as of then; and once more when a reader joins a playback that stands still.  Ships as
// they really were are those of the place itself at once.
// Thread: its own, "playback"; all functions are any thread's.
class Player {
 public:
  static constexpr double kCatchUp = 16.0;  // times the recorded pace
  static constexpr Duration kGiveUp = std::chrono::milliseconds(250);
  static constexpr Duration kLookAround = std::chrono::milliseconds(50);  // for readers, paused
  // Sectors held for readers: this much time at the present rate, within these bounds.
  static constexpr Duration kHeld = std::chrono::milliseconds(500);
  static constexpr std::size_t kLeastHeld = 1 << 20, kMostHeld = 64 << 20;  // bytes of a format
  static constexpr std::size_t kRingSectors = 4096;
  // Octets of a format that are kHeld of such a radar at that rate, whatever the format: a spoke's
  // own, or a turn of an emulated radar's, which may have more spokes than were recorded.
  static std::size_t held_bytes(const wire::RadarInfo& info, double rate);

  using RadarViews = std::vector<std::unique_ptr<RelayedViewList>>;  // by played radar

  // All of them must outlive it.
  Player(const recording::RecordingReader& reader, const RecordedRadars& radars,
         const RadarViews& views, RelayedState& state, const PlayerOptions& options);
  ~Player();

  void start();
  void stop();

  void order(const PlayOrder& order);
  PlayerStanding standing() const;
  // The time that ships and spokes bear now; nothing where it is the recorded one.
  std::optional<UtcTime> present_utc() const;
  // Grows with every change but that of the place of a running playback.
  std::uint64_t version() const;

 private:
  using SteadyTime = PlayClock::SteadyTime;
  struct Orders {
    std::optional<UtcTime> seek;
    int steps = 0;
  };

  void run(const std::stop_token& stop);
  Orders take_orders();
  void carry_out(const Orders& orders);
  // Until an order comes, the end, or where a jump goes to.
  void advance(const std::stop_token& stop);
  void rest(const std::stop_token& stop);
  // False if an order or the stop came first.
  bool wait_until(SteadyTime due, const std::stop_token& stop);
  void play(Piece& piece);

  void jump(UtcTime place);  // with the turn before it
  void step(int turns);
  // What is in force there, and the first item next; truth is that of `place`.
  void begin_at(UtcTime from, UtcTime place);
  void take_last(const recording::Topic& topic, UtcTime place);
  void reach(UtcTime goal);
  void reach_end();

  // Require the lock.
  UtcTime place(SteadyTime now) const;
  bool runs() const { return playing_ || goal_; }
  void settle(UtcTime at, SteadyTime now);  // from a goal, to play on or to stand
  void tell_pace();

  std::uint64_t joins() const;
  bool somebody_joined(UtcTime here);
  void hold_enough(double rate);
  void note_faults();

  const recording::RecordingReader& reader_;
  const RecordedRadars& radars_;
  const RadarViews& views_;
  RelayedState& state_;
  const bool current_timestamps_;
  const UtcTime begin_, end_;

  // The thread's alone.
  PieceReader pieces_;
  std::vector<TurnFinder> turns_;                                // of the radars that have video
  std::optional<Piece> next_;                                    // read, not yet due
  std::map<recording::Topic, std::vector<std::uint8_t>> first_;  // items of what is in force
  std::uint64_t joins_seen_ = 0;
  UtcTime joined_at_ = UtcTime::min();  // where it stood when a reader joined
  std::uint64_t seen_ = 0;              // of changes_
  PaceWatch pace_;
  SteadyTime began_{};
  std::optional<ClockFollower> utc_;  // from start(); its thread's, as the next
  SteadyTime looked_{};               // at the clocks

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t changes_ = 0;  // orders so far
  std::uint64_t version_ = 1;
  Orders orders_;
  bool playing_, loop_;
  double rate_;
  UtcTime paused_at_;            // where it stands unless it runs
  std::optional<UtcTime> goal_;  // it catches up to there
  PlayClock clock_;
  std::string problem_, behind_;
  std::uint64_t faults_ = 0;

  std::jthread thread_;  // last: ends before what it uses
};

}  // namespace skerry::server
