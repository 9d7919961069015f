// A store in memory for hosts that run at once, in real time: each has a way to it that can be cut.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>

#include "server/fleet/host_clock.hpp"
#include "server/fleet/key_store.hpp"
#include "tests/unit/fleet/memory_store.hpp"

namespace skerry::fleet {

// Thread: any.
class SharedCluster {
 public:
  template <typename Do>
  auto with(Do action) {
    const std::lock_guard lock(mutex_);
    return action(cluster_, host_now());
  }

 private:
  std::mutex mutex_;
  MemoryCluster cluster_;
};

// Calls of a host that is cut off last as long as they may.  `is_cut` must outlive the store.
class SharedStore final : public KeyStore {
 public:
  SharedStore(SharedCluster& cluster, const std::atomic<bool>& is_cut)
      : cluster_(cluster), is_cut_(is_cut) {}

  StoreResult<TransactionReply> transact(const Transaction& transaction,
                                         HostTime deadline) override;
  StoreResult<RangeReply> range(const std::string& begin, const std::string& end, std::size_t most,
                                HostTime deadline) override;
  StoreResult<LeaseReply> grant_lease(std::chrono::seconds ttl, HostTime deadline) override;
  StoreResult<LeaseReply> keep_lease(LeaseId id, HostTime deadline) override;
  StoreResult<StoreHeader> revoke_lease(LeaseId id, HostTime deadline) override;
  std::unique_ptr<KeyWatch> watch(const std::string& prefix, Revision from) override;

  void turn() override {}
  std::size_t members() const override { return 1; }
  HostTime now() const override { return host_now(); }
  void wait_until(HostTime time) override;

 private:
  class Watch;
  StoreError cut(HostTime deadline);

  SharedCluster& cluster_;
  const std::atomic<bool>& is_cut_;
};

}  // namespace skerry::fleet
