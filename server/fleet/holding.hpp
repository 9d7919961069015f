// Holding: a name that one host of the fleet holds at a time: "leader", "ship/3".
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "server/fleet/log_event.hpp"
#include "server/fleet/log_keys.hpp"
#include "server/fleet/store_mark.hpp"

namespace skerry::fleet {

// Held by a lease of the store, which runs out at the store when it is not kept, and by an epoch,
// which no other holding of the name ever has.
//
// A holder may act until the lease's time has passed by its own clock since it asked for it, less
// kMarginShare of it.  The store counts from when it had the request, which is later, and longer
// after an election of its own; so the name is granted to another only after its holder knows that
// it has lost it, without a message.  Two things may make it wrong: clocks whose rates differ by
// more than the margin, and etcd 3.4.23 (Debian 12), whose member that was stopped or waited long
// for its disk may end leases that were kept meanwhile (etcd issues 12528 and 15247).  Therefore a
// holder's clock guards what it shows, and its epoch what it writes: no order, no grant is ever
// appended under an epoch that is over (OrderStore).
class Holding {
 public:
  static constexpr int kMarginShare = 10;  // a tenth; clocks' rates differ by a thousandth at most
  static constexpr std::chrono::seconds kLease{2};

  struct Wish {
    std::string exercise, name;
    std::string host;
    std::chrono::seconds ttl = kLease;  // the store may give more
  };
  enum class Standing : std::uint8_t {
    holds,
    other_holds,
    unknown,  // the store did not answer: held() says whether it may still act
  };
  struct Status {
    Standing standing = Standing::unknown;
    std::string holder;               // host; empty: not known
    std::optional<StoreError> error;  // of unknown
  };

  // Error: std::invalid_argument, if a name is none.
  Holding(KeyStore& keys, StoreMark& mark, Wish wish);

  // Takes the name if it is free, keeps it if it is held.  To be called again each quarter of the
  // lease's time.  Thread: one at a time.
  Status step(HostTime deadline);
  // Gives it up, so that another can take it at once.  Thread: that of step().
  void release(HostTime deadline);

  // The epoch, if this host may act at that time.  To be asked before each act.  Thread: any.
  std::optional<Epoch> held(HostTime now) const;
  // Until when it may act as it stands; HostTime{}: it may not.  Thread: any.
  HostTime held_until() const;

 private:
  std::optional<StoreError> keep(HostTime deadline);
  Status take(HostTime deadline);
  void set(Epoch epoch, HostTime until);

  KeyStore& keys_;
  StoreMark& mark_;
  const Wish wish_;
  const std::string key_;
  LeaseId lease_ = 0;     // 0: none
  HostTime lease_until_;  // by this host's clock

  mutable std::mutex mutex_;  // of what follows
  Epoch epoch_ = 0;
  HostTime until_;
};

}  // namespace skerry::fleet
