#include "server/fleet/etcd/etcd_store.hpp"

#include <grpcpp/client_context.h>

#include <thread>
#include <utility>

#include "server/fleet/etcd/etcd_status.hpp"
#include "server/fleet/etcd/etcd_values.hpp"
#include "server/fleet/etcd/etcd_watch.hpp"
#include "server/fleet/etcd/rpc.grpc.pb.h"

namespace skerry::fleet {
namespace {

etcdserverpb::TxnRequest request_of(const Transaction& transaction) {
  etcdserverpb::TxnRequest request;
  for (const Condition& condition : transaction.conditions) {
    auto& compare = *request.add_compare();
    compare.set_result(etcdserverpb::Compare::EQUAL);
    compare.set_key(condition.key);
    if (condition.of == Condition::Of::created) {
      compare.set_target(etcdserverpb::Compare::CREATE);
      compare.set_create_revision(condition.is);
    } else {
      compare.set_target(etcdserverpb::Compare::MOD);
      compare.set_mod_revision(condition.is);
    }
  }
  for (const Put& put : transaction.puts) {
    auto& op = *request.add_success()->mutable_request_put();
    op.set_key(put.key);
    op.set_value(put.value);
    op.set_lease(put.lease);
  }
  for (const std::string& key : transaction.reads) {
    request.add_success()->mutable_request_range()->set_key(key);
    request.add_failure()->mutable_request_range()->set_key(key);
  }
  return request;
}

}  // namespace

// Asks only members that know of a leader: one that is cut off answers at once that it does not.
struct EtcdStore::Call {
  explicit Call(HostTime deadline) {
    context.set_deadline(as_deadline(deadline, host_now()));
    context.AddMetadata("hasleader", "true");
  }
  grpc::ClientContext context;
};

EtcdStore::EtcdStore(std::shared_ptr<const EtcdMembers> members) : members_(std::move(members)) {}
EtcdStore::~EtcdStore() = default;

StoreError EtcdStore::error(const grpc::Status& status) const {
  const bool connected = members_->channel(member_)->GetState(false) == GRPC_CHANNEL_READY;
  return store_error_of(status, members_->name(member_), connected);
}

StoreResult<TransactionReply> EtcdStore::transact(const Transaction& transaction,
                                                  HostTime deadline) {
  Call call(deadline);
  etcdserverpb::TxnResponse response;
  const auto status = etcdserverpb::KV::NewStub(members_->connected(member_, deadline))
                          ->Txn(&call.context, request_of(transaction), &response);
  if (!status.ok()) return Failure{error(status)};
  TransactionReply reply{header_of(response.header()), response.succeeded(), {}};
  for (auto& op : *response.mutable_responses()) {
    if (!op.has_response_range()) continue;
    auto& found = *op.mutable_response_range()->mutable_kvs();
    if (found.empty())
      reply.found.emplace_back();
    else
      reply.found.emplace_back(key_of(std::move(found[0])));
  }
  return reply;
}

StoreResult<RangeReply> EtcdStore::range(const std::string& begin, const std::string& end,
                                         std::size_t most, HostTime deadline) {
  Call call(deadline);
  etcdserverpb::RangeRequest request;
  request.set_key(begin);
  request.set_range_end(end);
  request.set_limit(static_cast<std::int64_t>(most));
  etcdserverpb::RangeResponse response;
  const auto status = etcdserverpb::KV::NewStub(members_->connected(member_, deadline))
                          ->Range(&call.context, request, &response);
  if (!status.ok()) return Failure{error(status)};
  RangeReply reply{header_of(response.header()), {}, response.more()};
  for (auto& key : *response.mutable_kvs()) reply.found.push_back(key_of(std::move(key)));
  return reply;
}

StoreResult<LeaseReply> EtcdStore::grant_lease(std::chrono::seconds ttl, HostTime deadline) {
  Call call(deadline);
  etcdserverpb::LeaseGrantRequest request;
  request.set_ttl(ttl.count());
  etcdserverpb::LeaseGrantResponse response;
  const auto status = etcdserverpb::Lease::NewStub(members_->connected(member_, deadline))
                          ->LeaseGrant(&call.context, request, &response);
  if (!status.ok()) return Failure{error(status)};
  return LeaseReply{header_of(response.header()), response.id(),
                    std::chrono::seconds(response.ttl())};
}

StoreResult<LeaseReply> EtcdStore::keep_lease(LeaseId id, HostTime deadline) {
  Call call(deadline);
  const auto stub = etcdserverpb::Lease::NewStub(members_->connected(member_, deadline));
  const auto stream = stub->LeaseKeepAlive(&call.context);
  etcdserverpb::LeaseKeepAliveRequest request;
  request.set_id(id);
  etcdserverpb::LeaseKeepAliveResponse response;
  if (!stream->Write(request) || !stream->Read(&response)) return Failure{error(stream->Finish())};
  call.context.TryCancel();
  (void)stream->Finish();
  return LeaseReply{header_of(response.header()), id,
                    std::chrono::seconds(std::max<std::int64_t>(response.ttl(), 0))};
}

StoreResult<StoreHeader> EtcdStore::revoke_lease(LeaseId id, HostTime deadline) {
  Call call(deadline);
  etcdserverpb::LeaseRevokeRequest request;
  request.set_id(id);
  etcdserverpb::LeaseRevokeResponse response;
  const auto status = etcdserverpb::Lease::NewStub(members_->connected(member_, deadline))
                          ->LeaseRevoke(&call.context, request, &response);
  if (!status.ok() && status.error_code() != grpc::StatusCode::NOT_FOUND)
    return Failure{error(status)};
  return header_of(response.header());
}

std::unique_ptr<KeyWatch> EtcdStore::watch(const std::string& prefix, Revision from) {
  return std::make_unique<EtcdWatch>(members_, member_, prefix, from);
}

void EtcdStore::turn() { member_ = (member_ + 1) % members_->size(); }

void EtcdStore::wait_until(HostTime time) { std::this_thread::sleep_for(time - host_now()); }

StoreResult<EtcdState> EtcdStore::state(HostTime deadline) {
  grpc::ClientContext context;
  context.set_deadline(as_deadline(deadline, host_now()));
  etcdserverpb::StatusResponse response;
  const auto status = etcdserverpb::Maintenance::NewStub(members_->connected(member_, deadline))
                          ->Status(&context, etcdserverpb::StatusRequest(), &response);
  if (!status.ok()) return Failure{error(status)};
  return EtcdState{response.header().member_id(),
                   response.leader(),
                   response.dbsize(),
                   response.version(),
                   {response.errors().begin(), response.errors().end()}};
}

}  // namespace skerry::fleet
