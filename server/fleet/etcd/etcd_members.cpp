#include "server/fleet/etcd/etcd_members.hpp"

#include <grpc/support/log.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include <algorithm>
#include <stdexcept>

#include "server/fleet/etcd/etcd_status.hpp"

namespace skerry::fleet {
namespace {

// Of one answer: 500 orders of a page, or the 1000 changes that etcd sends a late watch at once, at
// kMostOrder each and something over.
constexpr int kMostAnswer = 72 << 20;
// A member that is started again is found so soon; gRPC would take up to two minutes, and look up
// its name each 30 s, even if that is an address.
constexpr int kFirstAgainMs = 50, kLastAgainMs = 500;

}  // namespace

EtcdMembers::EtcdMembers(const EtcdAddress& address) {
  // gRPC writes to standard error what it also says in the errors that it returns.
  gpr_set_log_function([](gpr_log_func_args*) {});
  if (address.members.empty())
    throw std::invalid_argument("the store: no member; expected host:port of each");
  std::shared_ptr<grpc::ChannelCredentials> credentials = grpc::InsecureChannelCredentials();
  if (const auto& tls = address.tls) {
    if (tls->authority.empty() || tls->certificate.empty() || tls->key.empty())
      throw std::invalid_argument(
          "the store: TLS needs the authority's certificate, and this host's with its key");
    credentials = grpc::SslCredentials({tls->authority, tls->key, tls->certificate});
  }
  for (const std::string& name : address.members) {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(kMostAnswer);
    arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, kFirstAgainMs);
    arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, kLastAgainMs);
    arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, kLastAgainMs);
    arguments.SetInt(GRPC_ARG_DNS_MIN_TIME_BETWEEN_RESOLUTIONS_MS, kLastAgainMs);
    // Members are what they are called: no proxy, no settings of a service from the DNS.
    arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
    arguments.SetInt(GRPC_ARG_SERVICE_CONFIG_DISABLE_RESOLUTION, 1);
    arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
    members_.push_back({name, grpc::CreateCustomChannel(name, credentials, arguments)});
  }
}

const std::shared_ptr<grpc::Channel>& EtcdMembers::connected(std::size_t member,
                                                             HostTime deadline) const {
  const auto& channel = members_[member].channel;
  const HostTime now = host_now();
  (void)channel->WaitForConnected(as_deadline(std::min(deadline, now + kConnect), now));
  return channel;
}

}  // namespace skerry::fleet
