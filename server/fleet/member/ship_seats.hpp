// ShipSeats: the thread that holds this host's presence and the own ships it runs.
#pragma once

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
  // What this host knows of the fleet, and what it tells of itself.
  struct Known {
    bool takes = false;                // this host may run ships: it follows the log
    std::vector<std::string> holders;  // of each ship; empty: nobody
    std::set<std::string> present;     // hosts
    std::string note;                  // HostNote
  };
  // All must outlive it.  `look` is called from its thread, some ten times a second.
  ShipSeats(const MemberPlan& plan, StoreMark& mark, std::function<Known()> look);
  ~ShipSeats() { stop(); }

  void start();
  // Gives all up.
  void stop();
  // Until when each ship is this host's; a time that has passed: it is not.  Thread: any.
  std::vector<HostTime> until() const;

 private:
  void run(const std::stop_token& stop);
  void share(const Known& known);
  void keep(std::size_t ship);
  void give_up(std::size_t ship);
  void set_until(std::size_t ship, HostTime until);

  const MemberPlan& plan_;
  StoreMark& mark_;
  std::function<Known()> look_;
  std::unique_ptr<KeyStore> keys_;
  Holding presence_;
  std::map<std::size_t, std::unique_ptr<Holding>> ships_;  // its thread's
  mutable std::mutex mutex_;
  std::vector<HostTime> until_;  // guarded by mutex_
  std::jthread thread_;
};

}  // namespace skerry::fleet
