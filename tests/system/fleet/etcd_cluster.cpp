#include "tests/system/fleet/etcd_cluster.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/fleet/until_answered.hpp"

namespace skerry::fleet {

std::vector<int> free_ports(std::size_t count) {
  // Below those that the kernel gives to connections: who tries to reach a member that does not run
  // would some day be given its port.
  constexpr int kFirst = 20000, kPorts = 12000;
  std::vector<int> ports;
  for (int i = 0; i < kPorts && ports.size() < count; ++i) {
    const int port = kFirst + (::getpid() * 41 + i) % kPorts;
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (socket < 0) break;
    if (::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0)
      ports.push_back(port);
    ::close(socket);
  }
  if (ports.size() < count) throw std::runtime_error("no free ports");
  return ports;
}

EtcdCluster::EtcdCluster(Plan plan) : plan_(std::move(plan)) {
  const auto ports = free_ports(2 * plan_.members);
  for (std::size_t i = 0; i < plan_.members; ++i) {
    Member& member = members_.emplace_back();
    member.name = "m" + std::to_string(i);
    member.client = fmt::format("127.0.0.1:{}", ports[2 * i]);
    member.peer = fmt::format("127.0.0.1:{}", ports[2 * i + 1]);
    member.folder = folder_.path(member.name);
  }
  for (std::size_t i = 0; i < size(); ++i) start(i);
  await_majority();
}

std::string EtcdCluster::initial_cluster() const {
  std::string text;
  for (const Member& member : members_)
    text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", member.name, scheme(), member.peer);
  return text;
}

void EtcdCluster::start(std::size_t i) {
  Member& member = members_[i];
  std::vector<std::string> arguments = {"/usr/bin/etcd",
                                        "--name=" + member.name,
                                        "--data-dir=" + member.folder,
                                        "--listen-client-urls=" + scheme() + member.client,
                                        "--advertise-client-urls=" + scheme() + member.client,
                                        "--listen-peer-urls=" + scheme() + member.peer,
                                        "--initial-advertise-peer-urls=" + scheme() + member.peer,
                                        "--initial-cluster=" + initial_cluster(),
                                        "--initial-cluster-token=skerry-fleet",
                                        "--initial-cluster-state=new",
                                        "--heartbeat-interval=50",
                                        "--election-timeout=500",
                                        "--logger=zap",
                                        "--log-level=error",
                                        "--log-outputs=stderr"};
  if (const std::string& tls = plan_.tls_folder; !tls.empty()) {
    for (const char* side : {"", "peer-"}) {
      arguments.push_back(fmt::format("--{}trusted-ca-file={}/ca.pem", side, tls));
      arguments.push_back(fmt::format("--{}cert-file={}/host.pem", side, tls));
      arguments.push_back(fmt::format("--{}key-file={}/host.key", side, tls));
      arguments.push_back(fmt::format("--{}client-cert-auth", side));
    }
  }
  arguments.insert(arguments.end(), plan_.more_arguments.begin(), plan_.more_arguments.end());
  member.process = std::make_unique<system_test::ChildProcess>(std::move(arguments));
}

void EtcdCluster::kill(std::size_t i) {
  members_[i].process.reset();
  members_[i].is_stopped = false;
}

void EtcdCluster::stop(std::size_t i) {
  members_[i].process->signal(SIGSTOP);
  members_[i].is_stopped = true;
}

void EtcdCluster::resume(std::size_t i) {
  members_[i].process->signal(SIGCONT);
  members_[i].is_stopped = false;
}

void EtcdCluster::heal() {
  for (std::size_t i = 0; i < size(); ++i) {
    if (!runs(i)) start(i);
    if (is_stopped(i)) resume(i);
  }
}

std::vector<std::string> EtcdCluster::addresses() const {
  std::vector<std::string> addresses;
  for (const Member& member : members_) addresses.push_back(member.client);
  return addresses;
}

EtcdAddress EtcdCluster::address() const {
  EtcdAddress address{addresses(), std::nullopt};
  const auto text = [&](const char* file) {
    return system_test::text_of_file(plan_.tls_folder + "/" + file);
  };
  if (!plan_.tls_folder.empty())
    address.tls = EtcdTls{text("ca.pem"), text("host.pem"), text("host.key")};
  return address;
}

std::shared_ptr<const EtcdMembers> EtcdCluster::connect() const {
  return std::make_shared<EtcdMembers>(address());
}

void EtcdCluster::await_majority() {
  EtcdStore store(connect());
  Transaction nothing;
  nothing.reads = {"/nothing"};
  const auto reply =
      until_answered(store, host_now() + std::chrono::minutes(1),
                     [&](HostTime attempt) { return store.transact(nothing, attempt); });
  if (!reply) throw std::runtime_error("etcd does not come up: " + reply.error().text);
}

std::optional<std::size_t> EtcdCluster::leader() const {
  std::map<std::uint64_t, std::size_t> votes, member_of;
  EtcdStore store(connect());
  for (std::size_t i = 0; i < size(); ++i, store.turn()) {
    if (!runs(i) || is_stopped(i)) continue;
    const auto state = store.state(host_now() + std::chrono::seconds(1));
    if (!state) continue;
    member_of[state->member] = i;
    if (state->leader != 0) ++votes[state->leader];
  }
  for (const auto& [id, count] : votes) {
    if (2 * count > size() && member_of.contains(id)) return member_of[id];
  }
  return std::nullopt;
}

std::string EtcdCluster::control(const std::vector<std::string>& arguments) const {
  std::vector<std::string> all = {"/usr/bin/env", "ETCDCTL_API=3", "/usr/bin/etcdctl"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const auto ending = system_test::run(all);
  if (ending.code != 0)
    throw std::runtime_error("etcdctl " + arguments.front() + ": " + ending.out + ending.err);
  return ending.out;
}

std::size_t EtcdCluster::await_leader() const {
  for (const HostTime end = host_now() + std::chrono::minutes(1); host_now() < end;) {
    if (const auto member = leader()) return *member;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  throw std::runtime_error("etcd has no leader");
}

void EtcdCluster::save(std::size_t member, const std::string& file) const {
  control({"--endpoints=" + members_[member].client, "snapshot", "save", file});
}

void EtcdCluster::restore(const std::string& file) {
  ++generation_;
  for (std::size_t i = 0; i < size(); ++i) {
    kill(i);
    Member& member = members_[i];
    member.folder = folder_.path(fmt::format("{}-{}", member.name, generation_));
    control({"snapshot", "restore", file, "--name=" + member.name, "--data-dir=" + member.folder,
             "--initial-cluster=" + initial_cluster(), "--initial-cluster-token=skerry-fleet",
             "--initial-advertise-peer-urls=" + scheme() + member.peer});
  }
  for (std::size_t i = 0; i < size(); ++i) start(i);
  await_majority();
}

}  // namespace skerry::fleet
