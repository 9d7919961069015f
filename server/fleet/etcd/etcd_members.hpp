// EtcdMembers: how a host reaches the members of its etcd.
#pragma once

#include <grpcpp/channel.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/fleet/host_clock.hpp"

namespace skerry::fleet {

// Both sides show a certificate; texts in PEM.
struct EtcdTls {
  std::string authority;
  std::string certificate;  // of this host
  std::string key;
};

struct EtcdAddress {
  std::vector<std::string> members;  // "host:port" each, of clients' URLs
  std::optional<EtcdTls> tls;        // nothing: in the clear, for tests and one machine
};

// A connection for each member, made when it is first used and again when it is lost.  gRPC's own
// log is off in a program that has made one. Thread: any.
class EtcdMembers {
 public:
  // Error: std::invalid_argument, without a member, or with TLS that lacks a text.
  explicit EtcdMembers(const EtcdAddress& address);

  std::size_t size() const { return members_.size(); }
  const std::string& name(std::size_t member) const { return members_[member].name; }
  const std::shared_ptr<grpc::Channel>& channel(std::size_t member) const {
    return members_[member].channel;
  }
  // The channel, connected if that comes about by the deadline, and within kConnect.  A call on one
  // that is not fails at once, saying why.
  const std::shared_ptr<grpc::Channel>& connected(std::size_t member, HostTime deadline) const;

  // Connecting within a site takes some milliseconds.  gRPC goes on with it only while somebody
  // waits for something, or each 5 s: without waiting here a member would be found so late.
  static constexpr std::chrono::milliseconds kConnect{100};

 private:
  struct Member {
    std::string name;
    std::shared_ptr<grpc::Channel> channel;
  };
  std::vector<Member> members_;
};

}  // namespace skerry::fleet
