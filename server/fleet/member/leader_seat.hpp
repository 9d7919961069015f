// LeaderSeat: the thread that leads, or stands by to lead, and grants time while it does.
#pragma once

#include <functional>
#include <optional>
#include <thread>

#include "server/fleet/exercise_log.hpp"
#include "server/fleet/holding.hpp"
#include "server/fleet/member/member_plan.hpp"

namespace skerry::fleet {

class LeaderSeat {
 public:
  using Due = std::function<std::optional<GrantWish>()>;
  using Said = std::function<void(std::optional<StoreError>)>;
  using May = std::function<bool()>;
  // All must outlive it.  `may`: whether this host could grant time: if not, it leaves the seat to
  // others; `due`: the grant to make now; `said`: what the store's last call came to.  All are
  // called from its thread.
  LeaderSeat(const MemberPlan& plan, StoreMark& mark, May may, Due due, Said said);
  ~LeaderSeat() { stop(); }

  void start();
  // Gives the leading up.
  void stop();
  // Thread: any.
  std::optional<Epoch> held(HostTime now) const { return holding_.held(now); }

 private:
  void run(const std::stop_token& stop);

  const MemberPlan& plan_;
  StoreMark& mark_;
  May may_;
  Due due_;
  Said said_;
  std::unique_ptr<KeyStore> keys_;
  Holding holding_;
  std::jthread thread_;
};

}  // namespace skerry::fleet
