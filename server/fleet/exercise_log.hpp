// ExerciseLog: up to which tick a host may run, and which orders hold at which.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/fleet/exercise_clock.hpp"
#include "server/fleet/log_event.hpp"
#include "server/fleet/order_store.hpp"

namespace skerry::fleet {

// Makes all hosts apply the same orders at the same ticks without any of them waiting for another.
//
// The leader grants time: "run to tick X".  An order holds from the tick behind the last grant that
// was committed before it.  Its tick stands in it, and the store puts it only while that grant is
// in force (OrderStore::append).  A host hears grants and orders in the order of their revisions,
// so:
//
//   INVARIANT.  Who knows a grant to X knows every order that holds at X or before.  For an order
//   that holds at T <= X was put while the grant to T - 1 was in force, and the grant to X came
//   after: its revision is larger, and the host has heard the order first.
//
// A host that keeps to the grants it has heard therefore never meets an order in its past, however
// late anything is.  Three things follow, and the tests fail if one is given up:
//   - A grant counts when it is heard in the log, for its leader as well.  The reply of the store
//     comes on another way: it may overtake an order that was committed before the grant, or not
//     come, while other hosts hear the grant and run.  Nothing here takes a reply for a grant.
//   - An order names the grant it was made for, and is not put under another: its host may not yet
//     have heard of a grant by which others have run past the tick it would give.
//   - A grant names the grant before it, so a late one of the same leader never takes time back.
//
// Grants go ahead of the leader's clock by `lead` and are renewed every `renew`; as long as they
// come hosts never run past them.  When none has come for `lead`, a host runs free: by its clock,
// on the orders it knows, taking no order, and saying so (Standing::free).  Before its first free
// tick it says that its world is to be kept (Step::keep).  An order may have been committed that it
// has not heard: when it hears it and has run past its tick, it must come back, to the kept world
// or another snapshot, and says so with the tick (Conflict).  Otherwise it follows again as if
// nothing had been. A new leader grants from its own now: orders hold in the future of all who run
// by their clocks.
//
// Pure: events and times in, decisions out.  Thread: one at a time.
class ExerciseLog {
 public:
  struct Settings {
    Duration tick = std::chrono::milliseconds(100);  // World::kTick
    Duration lead = std::chrono::milliseconds(300);  // outages of the store up to this are not seen
    Duration renew = std::chrono::milliseconds(100);
    // An order is only given while the grant goes so far ahead: it would otherwise often be
    // committed when hosts have begun to run free.  A few times the store's p99.
    Duration fresh = std::chrono::milliseconds(50);
  };
  // Of a world that a host has: it holds all orders of revisions up to `known` that hold at `tick`
  // or before.  Tick 0 and revision 0: a new one.
  struct Snapshot {
    Tick tick = 0;
    Revision known = 0;
  };
  // A grant further ahead of its own time than this is none.
  static constexpr Duration kMostLead = std::chrono::seconds(10);
  static constexpr Duration kLongest = std::chrono::hours(24 * 366);  // an exercise

  ExerciseLog(std::string host, const Settings& settings, const Snapshot& from);

  // What the log says, in its order: from revision 1, or from an OrderStore::read() of 1 on.
  // Error: broken; the log contradicts itself, and this host must not go on.
  std::optional<StoreError> hear(const LogEvent& event, HostTime now);
  // For the text of refusals alone: what the store's last call came to.
  void store_said(std::optional<StoreError> error) { store_error_ = std::move(error); }

  enum class Standing : std::uint8_t {
    waiting,  // for the first grant, or the next: this host's tick is the last granted, or past it
    following,       // the grants
    free,            // none comes: it runs by its clock
    must_come_back,  // an order holds in its past
  };
  struct Conflict {
    Tick tick = 0;  // the first that was run without it
    OrderSeen order;
  };
  struct Due {
    Tick tick = 0;
    OrderSeen order;
  };
  struct Step {
    Tick run_to = 0;          // inclusive; the host runs each tick up to it, and shows it
    std::vector<Due> orders;  // by tick, then by revision; each before its tick is run
    Standing standing = Standing::waiting;
    bool keep = false;                 // keep the world as of run_to: Snapshot{run_to, known()}
    std::optional<Conflict> conflict;  // of must_come_back
  };
  Step advance(HostTime now);

  // This host leads with that epoch (Holding::held); nothing: it does not.
  void lead(std::optional<Epoch> epoch, HostTime now);
  // The grant to make now, if one is due.  What comes of it is heard in the log.
  std::optional<GrantWish> grant_due(HostTime now);

  struct Refusal {
    std::string text;
    bool soon = false;  // the next grant is awaited: ask again then
  };
  struct Place {  // of OrderWish
    Epoch epoch = 0;
    Revision grant = 0;
    Tick tick = 0;
  };
  // Under which grant an order would be given now.
  std::variant<Place, Refusal> place_of_order(HostTime now) const;

  Tick tick() const { return tick_; }
  Revision known() const { return known_; }
  std::optional<Duration> time(HostTime now) const { return clock_.at(now); }
  const std::optional<GrantSeen>& granted() const { return grant_; }

 private:
  std::optional<StoreError> hear_order(const OrderSeen& order);
  std::optional<StoreError> hear_grant(const GrantSeen& grant, HostTime now);
  StoreError broken(Revision revision, std::string_view what) const;
  Tick granted_to() const { return grant_ ? grant_->to : from_.tick; }
  Tick tick_at(HostTime now) const;
  bool leads() const { return my_epoch_ && leader_.epoch == *my_epoch_; }

  const std::string host_;
  const Settings settings_;
  const Snapshot from_;
  ExerciseClock clock_;
  Tick tick_;           // run
  Revision known_ = 0;  // heard
  std::optional<GrantSeen> grant_;
  HostTime grant_heard_{};
  HolderSeen leader_;
  Tick last_order_tick_ = 0;
  std::deque<OrderSeen> pending_;  // by revision, and so by tick
  bool free_ = false;
  std::optional<Conflict> conflict_;
  std::optional<Epoch> my_epoch_;
  std::optional<HostTime> grant_sent_;
  std::optional<StoreError> store_error_;
};

std::string_view name_of(ExerciseLog::Standing standing);

}  // namespace skerry::fleet
