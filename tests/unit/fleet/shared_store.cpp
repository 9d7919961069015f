#include "tests/unit/fleet/shared_store.hpp"

#include <thread>
#include <utility>

namespace skerry::fleet {

void SharedStore::wait_until(HostTime time) {
  const auto left = time - host_now();
  if (left > Duration{}) std::this_thread::sleep_for(left);
}

StoreError SharedStore::cut(HostTime deadline) {
  wait_until(deadline);
  return {Trouble::unreachable, "cannot be reached", false};
}

StoreResult<TransactionReply> SharedStore::transact(const Transaction& transaction,
                                                    HostTime deadline) {
  if (is_cut_) return Failure{cut(deadline)};
  return cluster_.with(
      [&](MemoryCluster& cluster, HostTime now) { return cluster.transact(transaction, now); });
}

StoreResult<RangeReply> SharedStore::range(const std::string& begin, const std::string& end,
                                           std::size_t most, HostTime deadline) {
  if (is_cut_) return Failure{cut(deadline)};
  return cluster_.with([&](MemoryCluster& cluster, HostTime now) {
    cluster.run_to(now);
    RangeReply reply{cluster.header(), {}, false};
    const auto& keys = cluster.keys();
    for (auto key = keys.lower_bound(begin); key != keys.end() && key->first < end; ++key) {
      if (reply.found.size() == most) {
        reply.more = true;
        break;
      }
      reply.found.push_back(key->second);
    }
    return reply;
  });
}

StoreResult<LeaseReply> SharedStore::grant_lease(std::chrono::seconds ttl, HostTime deadline) {
  if (is_cut_) return Failure{cut(deadline)};
  return cluster_.with(
      [&](MemoryCluster& cluster, HostTime now) { return cluster.grant_lease(ttl, now); });
}

StoreResult<LeaseReply> SharedStore::keep_lease(LeaseId id, HostTime deadline) {
  if (is_cut_) return Failure{cut(deadline)};
  return cluster_.with(
      [&](MemoryCluster& cluster, HostTime now) { return cluster.keep_lease(id, now); });
}

StoreResult<StoreHeader> SharedStore::revoke_lease(LeaseId id, HostTime deadline) {
  if (is_cut_) return Failure{cut(deadline)};
  return cluster_.with(
      [&](MemoryCluster& cluster, HostTime now) { return cluster.revoke_lease(id, now); });
}

class SharedStore::Watch final : public KeyWatch {
 public:
  Watch(SharedStore& store, std::string prefix, Revision from)
      : store_(store), prefix_(std::move(prefix)), next_(from) {}

  StoreResult<WatchStep> next(HostTime deadline) override {
    for (;;) {
      if (store_.is_cut_) return Failure{store_.cut(deadline)};
      WatchStep step = store_.cluster_.with([&](MemoryCluster& cluster, HostTime now) {
        cluster.run_to(now);
        WatchStep found{cluster.header(), {}};
        const auto& history = cluster.history();
        for (; read_ < history.size(); ++read_) {
          const KeyEvent& event = history[read_];
          if (event.key.modified >= next_ && event.key.key.starts_with(prefix_))
            found.events.push_back(event);
        }
        return found;
      });
      if (!step.events.empty() || host_now() >= deadline) return step;
      store_.wait_until(host_now() + std::chrono::milliseconds(2));
    }
  }

 private:
  SharedStore& store_;
  const std::string prefix_;
  const Revision next_;
  std::size_t read_ = 0;  // of the history
};

std::unique_ptr<KeyWatch> SharedStore::watch(const std::string& prefix, Revision from) {
  return std::make_unique<Watch>(*this, prefix, from);
}

}  // namespace skerry::fleet
