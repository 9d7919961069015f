// EtcdStore: KeyStore over an etcd 3.4.
#pragma once

#include <memory>
#include <string>

#include "server/fleet/etcd/etcd_members.hpp"
#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

struct EtcdState {
  std::uint64_t member = 0;
  std::uint64_t leader = 0;  // 0: none
  std::int64_t bytes = 0;    // of its file
  std::string version;
  std::vector<std::string> alarms;  // etcd's words
};

// Thread: one at a time; the members may be shared.
class EtcdStore final : public KeyStore {
 public:
  explicit EtcdStore(std::shared_ptr<const EtcdMembers> members);
  ~EtcdStore() override;

  StoreResult<TransactionReply> transact(const Transaction& transaction,
                                         HostTime deadline) override;
  StoreResult<RangeReply> range(const std::string& begin, const std::string& end, std::size_t most,
                                HostTime deadline) override;
  StoreResult<LeaseReply> grant_lease(std::chrono::seconds ttl, HostTime deadline) override;
  StoreResult<LeaseReply> keep_lease(LeaseId id, HostTime deadline) override;
  StoreResult<StoreHeader> revoke_lease(LeaseId id, HostTime deadline) override;
  std::unique_ptr<KeyWatch> watch(const std::string& prefix, Revision from) override;

  void turn() override;
  std::size_t members() const override { return members_->size(); }
  HostTime now() const override { return host_now(); }
  void wait_until(HostTime time) override;

  // Of the member that is asked next.
  StoreResult<EtcdState> state(HostTime deadline);

 private:
  struct Call;
  StoreError error(const grpc::Status& status) const;

  const std::shared_ptr<const EtcdMembers> members_;
  std::size_t member_ = 0;
};

}  // namespace skerry::fleet
