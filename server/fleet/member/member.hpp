// Member: one host of a fleet that runs an exercise together.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/fleet/exercise_log.hpp"
#include "server/fleet/member/exercise.hpp"
#include "server/fleet/member/leader_seat.hpp"
#include "server/fleet/member/log_reader.hpp"
#include "server/fleet/member/order_desk.hpp"
#include "server/fleet/member/ship_seats.hpp"

namespace skerry::fleet {

// What a host of the fleet is known to be.
struct HostSeen {
  std::string name;
  std::string native, web, standing;  // as it told; empty: not yet
  HostTime heard{};                   // its last note; HostTime{}: none
  std::vector<std::size_t> ships;     // that it holds
  Tick tick = 0;                      // of the digest; 0: none
  WorldDigest digest{};
  bool takes = false;  // ships, as it told
};

struct MemberView {
  std::string standing;          // Fleet.standing of protocol/wire/fleet.proto
  std::string refusal, problem;  // empty: none
  std::string leader;
  std::vector<HostSeen> hosts;  // present, by name
  std::uint64_t version = 0;    // grows with each change but of `heard`
};

// Follows the log (ExerciseLog), runs the exercise by it and holds what is this host's to run, on a
// thread of its own ("fleet") beside those of its parts.
class Member {
 public:
  // An order holds some 0.3 s after it was appended; the world is compared each so many ticks of
  // 100 ms.
  static constexpr Tick kDigestTicks = 10;

  // `exercise` must outlive it.  Error: std::invalid_argument, a name is none.
  Member(MemberPlan plan, Exercise& exercise);
  ~Member() { stop(); }

  void start();
  // Gives up what it holds; orders that wait are refused.
  void stop();

  // The exercise's time now; nothing: not known yet, or ticks of the past
  // are still being made (it has just come, or comes back).  Thread: any, as of all below.
  std::optional<Duration> time() const;
  // Why this host will never be a member; nothing: it is, or tries to be.
  std::optional<std::string> ended() const;

  // Appends an order; Exercise::give() or refused() is called for its id, later.  Thread: any.
  // `id`: a name that no other order ever has.
  void order(std::string id, std::string order);
  bool leads() const;
  // Whether this host's presence has run out by its own clock: 1.8 s after it last asked the store
  // and was answered.  It takes no ships then.
  bool alone() const;
  // All other hosts are without the store as well, so none can have taken this one's ships: it goes
  // on with them until `asked` + ShipSeats::kAloneAnswer.  `asked`: before the first was asked.
  void go_on_alone(HostTime asked);
  MemberView view() const;

 private:
  void run(const std::stop_token& stop);
  void step();
  bool may_be_seated() const;
  bool let_go();
  void hear(LogReader::Heard heard, HostTime now);
  void hear(const LogEvent& event, HostTime now);
  void hear_note(const NoteSeen& note, HostTime now);
  void run_to(Tick tick, bool compare);
  void end(const std::string& why);
  void come_back(Exercise::Back to);
  void compare(const std::string& host, Tick tick, const WorldDigest& digest);
  void look_around(ExerciseLog::Standing standing, HostTime now);
  std::vector<HostTime> held_until(HostTime now);
  ShipSeats::Known known() const;

  const MemberPlan plan_;
  Exercise& exercise_;
  StoreMark mark_;

  mutable std::mutex mutex_;        // of what follows, to `queue_`
  std::optional<ExerciseLog> log_;  // never empty
  std::string leader_host_;         // empty: nobody
  MemberView view_;
  std::map<std::string, HostSeen> notes_;
  std::set<std::string> present_;
  std::vector<std::string> holders_;  // of each ship
  std::optional<std::string> ended_;
  bool runs_ = false;                 // its world is that of now
  bool awaits_log_ = true;            // the whole log is to come
  HostTime settled_{};                // kSettle after the whole log has come: its time is believed
  std::vector<HostTime> made_until_;  // of each ship, as it was told the radars last
  HostTime alone_until_{};            // go_on_alone(): until then ships are kept without the store
  bool behind_ = false;               // it makes ticks of long ago
  int differed_ = 0;                  // times that it came back because its world was another
  int grants_heard_ = 0;              // since it has come
  Tick digest_tick_ = 0;
  WorldDigest digest_{};
  std::vector<LogReader::Heard> queue_;

  // The member's thread's.
  WorldHashes hashes_;
  std::optional<ExerciseLog::Snapshot> kept_;
  ExerciseLog::Snapshot from_;
  Tick made_ = 0;
  std::optional<HostTime> told_;  // that worlds differ

  std::atomic<std::uint64_t> holds_{0};  // calls of Exercise::hold()
  std::atomic<bool> stops_{false};

  LogReader reader_;
  OrderDesk desk_;
  LeaderSeat leader_;
  ShipSeats seats_;
  std::jthread thread_;
};

}  // namespace skerry::fleet
