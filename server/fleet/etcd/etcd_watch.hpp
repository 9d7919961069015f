// EtcdWatch: KeyWatch over an etcd 3.4.
#pragma once

#include <grpcpp/client_context.h>
#include <grpcpp/completion_queue.h>

#include <memory>
#include <string>

#include "server/fleet/etcd/etcd_members.hpp"
#include "server/fleet/etcd/rpc.grpc.pb.h"
#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

// One stream of one member.  It has no thread of its own: what comes is taken in next().
// Thread: one at a time.
class EtcdWatch final : public KeyWatch {
 public:
  EtcdWatch(std::shared_ptr<const EtcdMembers> members, std::size_t member,
            const std::string& prefix, Revision from);
  ~EtcdWatch() override;

  StoreResult<WatchStep> next(HostTime deadline) override;

 private:
  enum class Stage : std::uint8_t { starting, asking, reading, finishing, ended };
  // What the stream does now is done, well or not.
  void go_on(bool well);
  StoreResult<WatchStep> take();
  StoreError how_it_ended() const;

  const std::shared_ptr<const EtcdMembers> members_;
  const std::size_t member_;
  grpc::CompletionQueue done_;
  grpc::ClientContext context_;
  std::unique_ptr<etcdserverpb::Watch::Stub> stub_;
  etcdserverpb::WatchRequest request_;
  etcdserverpb::WatchResponse response_;
  grpc::Status status_;
  std::unique_ptr<
      grpc::ClientAsyncReaderWriter<etcdserverpb::WatchRequest, etcdserverpb::WatchResponse>>
      stream_;
  Stage stage_ = Stage::starting;
  bool has_response_ = false;
};

}  // namespace skerry::fleet
