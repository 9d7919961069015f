// ShipSeats: the thread that holds this host's presence and the own ships it runs.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/fleet/holding.hpp"
#include "server/fleet/member/member_plan.hpp"

namespace skerry::fleet {

// The name under which a host is present.
std::string presence_name(const std::string& host);
std::optional<std::string> present_host(const std::string& name);

// Each is a holding of its own: two requests for each in half a second.
class ShipSeats {
 public:
  // A host whose presence had lapsed takes no ship of others for so long after it is back: others
  // may have gone on with theirs while they were told that it is without the store (Member::alone),
  // and find out that it is not within kAloneAnswer.
  static constexpr std::chrono::seconds kBackFirst{2};
  static constexpr std::chrono::seconds kAloneAnswer{1};

  // What this host knows of the fleet, and what it tells of itself.
  struct Known {
    bool takes = false;                // this host may run ships: it follows the log
    std::vector<std::string> holders;  // of each ship; empty: nobody
    std::set<std::string> present;     // hosts
    std::string note;                  // HostNote
  };
  // All must outlive it.  `look` is called from its thread, at most 20 times a second, less while
  // it waits for the store. `let_go`: no spoke of that ship is made here when it has returned true.
  ShipSeats(const MemberPlan& plan, StoreMark& mark, std::function<Known()> look,
            std::function<bool(std::size_t)> let_go);
  ~ShipSeats() { stop(); }

  void start();
  // Gives all up.
  void stop();
  // Until when each ship is this host's; a time that has passed: it is not.  Thread: any.
  std::vector<HostTime> until() const;
  // Which ships it would go on holding if the store answered.  Thread: any.
  std::vector<bool> claimed() const;
  // Whether it would take ships, for its part.  Thread: any.
  bool may_take() const { return may_take_.load(); }
  // Whether the store holds this host present, as far as it knows.  Thread: any.
  bool is_present(HostTime now) const { return presence_.held(now).has_value(); }

 private:
  void run(const std::stop_token& stop);
  void share(const Known& known);
  void keep(std::size_t ship);
  void give_up(std::size_t ship, HostTime deadline);
  void give_up(std::size_t ship);
  void set_until(std::size_t ship, HostTime until);
  void look_at_presence(HostTime now);

  const MemberPlan& plan_;
  StoreMark& mark_;
  std::function<Known()> look_;
  std::function<bool(std::size_t)> let_go_;
  std::unique_ptr<KeyStore> keys_;
  Holding presence_;
  std::map<std::size_t, std::unique_ptr<Holding>> ships_;  // its thread's
  mutable std::mutex mutex_;
  std::vector<HostTime> until_;  // guarded by mutex_, as is the next
  std::vector<bool> claimed_;
  bool was_present_ = false;  // its thread's, as is the next
  HostTime takes_from_{};     // ships
  std::atomic<bool> may_take_{false};
  std::jthread thread_;
};

}  // namespace skerry::fleet
