#include "tests/unit/fleet/memory_store.hpp"

#include <algorithm>
#include <utility>

namespace skerry::fleet {

bool MemoryCluster::holds(const Condition& condition) const {
  const auto key = keys_.find(condition.key);
  if (ignores_conditions_on_revisions && condition.is != 0) return true;
  if (key == keys_.end()) return condition.is == 0;
  return condition.is ==
         (condition.of == Condition::Of::created ? key->second.created : key->second.modified);
}

TransactionReply MemoryCluster::apply(const Transaction& transaction) {
  TransactionReply reply;
  reply.done = std::all_of(transaction.conditions.begin(), transaction.conditions.end(),
                           [&](const Condition& condition) { return holds(condition); });
  if (reply.done && !transaction.puts.empty()) {
    ++revision_;
    for (const Put& put : transaction.puts) {
      KeyValue& key = keys_[put.key];
      if (key.created == 0) key.created = revision_;
      key.key = put.key;
      key.value = put.value;
      key.modified = revision_;
      key.lease = put.lease;
      history_.push_back({key, false});
    }
  }
  for (const std::string& name : transaction.reads) {
    const auto key = keys_.find(name);
    reply.found.push_back(key == keys_.end() ? std::optional<KeyValue>() : key->second);
  }
  reply.header = header();
  return reply;
}

void MemoryCluster::end_lease(LeaseId id) {
  leases_.erase(id);
  bool any = false;
  for (auto key = keys_.begin(); key != keys_.end();) {
    if (key->second.lease != id) {
      ++key;
      continue;
    }
    if (!any) ++revision_;
    any = true;
    KeyValue gone;
    gone.key = key->first;
    gone.modified = revision_;
    history_.push_back({gone, true});
    key = keys_.erase(key);
  }
}

void MemoryCluster::run_to(HostTime now) {
  for (;;) {
    const auto lease =
        std::min_element(leases_.begin(), leases_.end(),
                         [](const auto& a, const auto& b) { return a.second.end < b.second.end; });
    const bool ends = has_majority && lease != leases_.end() && lease->second.end <= now;
    const bool comes = has_majority && !late_.empty() && late_.begin()->first <= now;
    if (comes && (!ends || late_.begin()->first <= lease->second.end)) {
      const Transaction transaction = std::move(late_.begin()->second);
      late_.erase(late_.begin());
      (void)apply(transaction);
    } else if (ends) {
      end_lease(lease->first);
    } else {
      return;
    }
  }
}

TransactionReply MemoryCluster::transact(const Transaction& transaction, HostTime now) {
  run_to(now);
  return apply(transaction);
}

void MemoryCluster::transact_late(Transaction transaction, HostTime at) {
  late_.emplace(at, std::move(transaction));
}

LeaseReply MemoryCluster::grant_lease(std::chrono::seconds ttl, HostTime now) {
  run_to(now);
  leases_[next_lease_] = {ttl, now + ttl};
  return {header(), next_lease_++, ttl};
}

LeaseReply MemoryCluster::keep_lease(LeaseId id, HostTime now) {
  run_to(now);
  const auto lease = leases_.find(id);
  if (lease == leases_.end()) return {header(), id, std::chrono::seconds(0)};
  lease->second.end = now + lease->second.ttl;
  return {header(), id, lease->second.ttl};
}

StoreHeader MemoryCluster::revoke_lease(LeaseId id, HostTime now) {
  run_to(now);
  if (leases_.contains(id)) end_lease(id);
  return header();
}

void MemoryCluster::lead_anew(HostTime now) {
  for (auto& [id, lease] : leases_) lease.end = now + lease.ttl;
}

bool MemoryStore::happens(double share) {
  return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < share;
}

StoreError MemoryStore::no_answer(HostTime deadline) {
  time_ = std::max(time_, deadline);
  return {Trouble::slow, "no answer in time", true};
}

std::optional<StoreError> MemoryStore::hindrance(HostTime deadline) {
  time_ += std::chrono::milliseconds(std::uniform_int_distribution<int>(1, 5)(random_));
  if (is_cut) {
    time_ = std::max(time_, deadline);
    return StoreError{Trouble::unreachable, "cannot be reached", false};
  }
  if (time_ > deadline) return no_answer(deadline);
  if (!cluster_.has_majority) return StoreError{Trouble::no_majority, "too few agree", true};
  cluster_.run_to(time_);
  if (happens(faults.lose_request)) return no_answer(deadline);
  return std::nullopt;
}

StoreResult<TransactionReply> MemoryStore::transact(const Transaction& transaction,
                                                    HostTime deadline) {
  if (const auto error = hindrance(deadline)) return Failure{*error};
  if (cluster_.is_full && !transaction.puts.empty())
    return Failure{StoreError{Trouble::full, "space exceeded", false}};
  if (happens(faults.come_late)) {
    const auto late = std::uniform_int_distribution<int>(1, 2000)(random_);
    cluster_.transact_late(transaction, deadline + std::chrono::milliseconds(late));
    return Failure{no_answer(deadline)};
  }
  auto reply = cluster_.transact(transaction, time_);
  if (happens(faults.lose_reply)) return Failure{no_answer(deadline)};
  return reply;
}

StoreResult<RangeReply> MemoryStore::range(const std::string& begin, const std::string& end,
                                           std::size_t most, HostTime deadline) {
  if (const auto error = hindrance(deadline)) return Failure{*error};
  RangeReply reply{cluster_.header(), {}, false};
  const auto& keys = cluster_.keys();
  for (auto key = keys.lower_bound(begin); key != keys.end() && key->first < end; ++key) {
    if (reply.found.size() == most) {
      reply.more = true;
      break;
    }
    reply.found.push_back(key->second);
  }
  return reply;
}

StoreResult<LeaseReply> MemoryStore::grant_lease(std::chrono::seconds ttl, HostTime deadline) {
  if (const auto error = hindrance(deadline)) return Failure{*error};
  auto reply = cluster_.grant_lease(ttl, time_);
  if (happens(faults.lose_reply)) return Failure{no_answer(deadline)};
  return reply;
}

StoreResult<LeaseReply> MemoryStore::keep_lease(LeaseId id, HostTime deadline) {
  if (const auto error = hindrance(deadline)) return Failure{*error};
  auto reply = cluster_.keep_lease(id, time_);
  if (happens(faults.lose_reply)) return Failure{no_answer(deadline)};
  return reply;
}

StoreResult<StoreHeader> MemoryStore::revoke_lease(LeaseId id, HostTime deadline) {
  if (const auto error = hindrance(deadline)) return Failure{*error};
  return cluster_.revoke_lease(id, time_);
}

// Gives some of the changes at a time, whole revisions.
class MemoryWatch final : public KeyWatch {
 public:
  MemoryWatch(MemoryStore& store, std::string prefix, Revision from)
      : store_(store), prefix_(std::move(prefix)), next_(from) {}

  StoreResult<WatchStep> next(HostTime deadline) override {
    if (store_.is_cut || !store_.cluster_.has_majority || store_.happens(store_.faults.cut_watch))
      return Failure{StoreError{Trouble::unreachable, "the watch was cut", false}};
    MemoryCluster& cluster = store_.cluster_;
    store_.time_ = std::min(store_.time_ + std::chrono::milliseconds(1), deadline);
    cluster.run_to(store_.time_);
    if (next_ <= cluster.compacted())
      return Failure{StoreError{Trouble::compacted, "compacted: read instead", false}};
    WatchStep step{cluster.header(), {}};
    const auto most = std::uniform_int_distribution<std::size_t>(1, 4)(store_.random_);
    for (const KeyEvent& event : cluster.history()) {
      if (event.key.modified < next_ || !event.key.key.starts_with(prefix_)) continue;
      if (step.events.size() >= most && step.events.back().key.modified != event.key.modified)
        break;
      step.events.push_back(event);
    }
    if (step.events.empty())
      store_.time_ = std::max(store_.time_, deadline);
    else
      next_ = step.events.back().key.modified + 1;
    return step;
  }

 private:
  MemoryStore& store_;
  const std::string prefix_;
  Revision next_;
};

std::unique_ptr<KeyWatch> MemoryStore::watch(const std::string& prefix, Revision from) {
  return std::make_unique<MemoryWatch>(*this, prefix, from);
}

}  // namespace skerry::fleet
