// A store in memory that does what etcd does, and what networks do to it, by a script and a seed.
#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

// The store that all hosts share; a value: a copy is a backup.  Time is the caller's.
class MemoryCluster {
 public:
  explicit MemoryCluster(std::uint64_t id = 0xC1) : id_(id) {}

  // As of `now`: what was under way until then comes first, and leases that ran out end.
  TransactionReply transact(const Transaction& transaction, HostTime now);
  LeaseReply grant_lease(std::chrono::seconds ttl, HostTime now);
  LeaseReply keep_lease(LeaseId id, HostTime now);
  StoreHeader revoke_lease(LeaseId id, HostTime now);
  // Applied at that time, whoever still waits for it.
  void transact_late(Transaction transaction, HostTime at);
  void run_to(HostTime now);
  // As etcd's next leader does: no lease runs out before its whole time has passed again.
  void lead_anew(HostTime now);

  void compact(Revision revision) { compacted_ = revision; }
  Revision compacted() const { return compacted_; }
  Revision revision() const { return revision_; }
  StoreHeader header() const { return {id_, 1, revision_}; }
  const std::map<std::string, KeyValue>& keys() const { return keys_; }
  const std::vector<KeyEvent>& history() const { return history_; }
  void rename(std::uint64_t id) { id_ = id; }

  bool has_majority = true;
  bool is_full = false;
  // Breaks the store, to see that the tests see it.
  bool ignores_conditions_on_revisions = false;

 private:
  struct Lease {
    std::chrono::seconds ttl{0};
    HostTime end{};
  };
  bool holds(const Condition& condition) const;
  void end_lease(LeaseId id);
  TransactionReply apply(const Transaction& transaction);

  std::uint64_t id_;
  std::map<std::string, KeyValue> keys_;
  std::vector<KeyEvent> history_;
  std::map<LeaseId, Lease> leases_;
  std::multimap<HostTime, Transaction> late_;
  Revision revision_ = 1;
  Revision compacted_ = 0;
  LeaseId next_lease_ = 100;
};

// Shares of calls, 0 to 1.
struct Faults {
  double lose_request = 0.0;
  double lose_reply = 0.0;
  double come_late = 0.0;  // applied after the caller has given up
  double cut_watch = 0.0;
};

// One host's way to it.  Calls take 1 to 5 ms of the shared time, lost ones all of their deadline.
class MemoryStore final : public KeyStore {
 public:
  MemoryStore(MemoryCluster& cluster, HostTime& time, std::uint64_t seed)
      : cluster_(cluster), time_(time), random_(seed) {}

  StoreResult<TransactionReply> transact(const Transaction& transaction,
                                         HostTime deadline) override;
  StoreResult<RangeReply> range(const std::string& begin, const std::string& end, std::size_t most,
                                HostTime deadline) override;
  StoreResult<LeaseReply> grant_lease(std::chrono::seconds ttl, HostTime deadline) override;
  StoreResult<LeaseReply> keep_lease(LeaseId id, HostTime deadline) override;
  StoreResult<StoreHeader> revoke_lease(LeaseId id, HostTime deadline) override;
  std::unique_ptr<KeyWatch> watch(const std::string& prefix, Revision from) override;
  void turn() override { ++turns; }
  std::size_t members() const override { return 3; }
  HostTime now() const override { return time_; }
  void wait_until(HostTime time) override { time_ = std::max(time_, time); }

  Faults faults;
  bool is_cut = false;
  std::uint64_t turns = 0;

 private:
  friend class MemoryWatch;
  bool happens(double share);
  // What comes instead of an answer; and whether the request is lost on the way.
  std::optional<StoreError> hindrance(HostTime deadline);
  StoreError no_answer(HostTime deadline);

  MemoryCluster& cluster_;
  HostTime& time_;
  std::mt19937_64 random_;
};

}  // namespace skerry::fleet
