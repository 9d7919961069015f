// ControlDesk: where every change of a control is decided, whoever asks for it.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"
#include "server/app/control/change_log.hpp"
#include "server/app/control/con_holders.hpp"
#include "server/app/control/control_locks.hpp"
#include "server/radar/radar_unit.hpp"
#include "server/replay/input_log.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {

// Consoles, displays and instructors are served one after the other; who comes last has it.  All
// are told of every change, for the version grows with it, and the log names who asked.  What the
// instructor has locked only the instructor changes; a Set that would change it is refused whole,
// one that leaves it as it is is not.
//
// A view that follows another has its controls; what is set in it is set in the other, but for its
// own instrumented range, which no lock holds: it belongs to what the view is made for.
// Thread: any.
class ControlDesk {
 public:
  // Timeline, units and `inputs` must outlive the desk.  `locks`: what is locked from the start, of
  // each.  `inputs` is told what the world is given; may be null.
  ControlDesk(Timeline& timeline, std::vector<RadarUnit*> units,
              const std::vector<std::vector<std::string>>& locks = {}, ChangeLog log = {},
              InputLog* inputs = nullptr);
  ~ControlDesk();

  // See RadarHost.
  wire::Reply apply(const wire::Set& set, const std::string& origin);
  wire::Settings settings(std::uint32_t radar, std::uint32_t view) const;
  std::uint64_t settings_version() const { return settings_version_.load(); }
  std::uint64_t world_version() const { return world_version_.load(); }

  // Changes are kept there, too.  Before the first apply().
  void set_audit(AuditPort* audit) { log_.set_audit(audit); }

  // The connection of `origin` has ended.
  void leave(const std::string& origin);
  // The same of all origins that end so.
  void leave_all(const std::string& ending);
  // Who has the con of a radar's own ship; empty: nobody.
  std::string con_of(std::uint32_t radar) const;

  // Whether the console has any con.
  bool has_a_con(const std::string& origin) const;

  // For hosts that agree on orders (server/app/fleet).
  //
  // What of a Set holds on all hosts, always of view 0, and what is of a view that this host alone
  // has; either may be empty, not both.
  struct Parts {
    std::optional<wire::Set> shared, own;
  };
  Parts parts_of(const wire::Set& set) const;
  // Why apply() would refuse it as things are; nothing: it would not.
  std::optional<wire::Reply> refusal_now(const wire::Set& set, const std::string& origin) const;
  // Who has which con, what is locked, and the controls of radars and their shared views.
  struct Kept {
    ConHolders cons;
    ControlLocks::Locked locks;
    std::vector<echo::ViewControls> views;
    std::vector<echo::RadarControls> radars;
  };
  Kept kept() const;
  void restore(const Kept& kept);

  // Logs changes that were held back.  Call it a few times a second.
  void flush_log();

 private:
  struct Next;  // what a Set makes of what it changes
  // Why it is refused, or what it makes.
  std::optional<wire::Reply> prepare(const wire::Set& set, const std::string& origin,
                                     Next& next) const;
  std::optional<wire::Reply> refusal_by_state(const wire::Set& set) const;
  std::optional<wire::Reply> refusal_by_con(const wire::Set& set, const std::string& origin) const;
  // Puts into `next` what `set` asks for and which of it is a change.
  std::optional<wire::Reply> plan(const wire::Set& set, Next& next) const;
  ShipState own_ship_of(std::uint32_t radar) const;
  void plan_orders(const wire::Set& set, Next& next) const;
  std::optional<wire::Reply> plan_world(const wire::Set& set, Next& next) const;
  std::optional<wire::Reply> refusal_by_lock(const wire::Set& set, const Next& next) const;
  std::optional<wire::Reply> carry_out(const wire::Set& set, const std::string& origin, Next& next);
  void give_orders(const wire::Set& set);
  std::optional<wire::Reply> give_con_orders(const wire::Set& set);
  std::optional<wire::Reply> give_exercise_order(const wire::Set& set, const std::string& origin,
                                                 Next& next);
  // Views that follow it keep their instrumented range as a multiple of the range scale.
  static void put_view(RadarUnit& unit, RadarView& view, const echo::ViewControls& controls);
  void log(const wire::Set& set, const std::string& origin, const Next& next);

  Timeline& timeline_;
  std::vector<RadarUnit*> units_;
  ControlLocks locks_;
  ConHolders cons_;
  InputLog* inputs_;
  std::atomic<std::uint64_t> settings_version_{1}, world_version_{1};
  mutable std::mutex mutex_;  // one Set at a time, so that two do not lose each other's values
  ChangeLog log_;
};

}  // namespace skerry::server
