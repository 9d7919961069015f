// EtcdCluster: an etcd of this machine, on loopback, whose members are killed and stopped.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/fleet/etcd/etcd_store.hpp"
#include "tests/system/child_process.hpp"

namespace skerry::fleet {

// Heartbeat 50 ms, election 500 ms, as server/fleet/README.md says.  Its files go with the object.
// Thread: one at a time.
class EtcdCluster {
 public:
  struct Plan {
    std::size_t members = 3;
    std::vector<std::string> more_arguments;
    // Folder with ca.pem, host.pem and host.key; empty: in the clear.
    std::string tls_folder;
  };
  EtcdCluster() : EtcdCluster(Plan()) {}
  // Starts all.  Error: std::runtime_error.
  explicit EtcdCluster(Plan plan);

  std::size_t size() const { return members_.size(); }
  void start(std::size_t member);
  void kill(std::size_t member);    // as by a power cut, but for what the kernel still writes
  void stop(std::size_t member);    // SIGSTOP
  void resume(std::size_t member);  // SIGCONT
  bool runs(std::size_t member) const { return members_[member].process != nullptr; }
  bool is_stopped(std::size_t member) const { return members_[member].is_stopped; }
  // All that were killed or stopped.
  void heal();

  std::vector<std::string> addresses() const;
  EtcdAddress address() const;
  std::shared_ptr<const EtcdMembers> connect() const;
  // Until a majority answers.  Error: std::runtime_error after a minute, with the members' logs.
  void await_majority();
  // Who leads by the words of most; nobody, if they do not agree.
  std::optional<std::size_t> leader() const;
  // Until they agree.  Error: std::runtime_error after a minute.
  std::size_t await_leader() const;

  // Of a member that runs.
  void save(std::size_t member, const std::string& file) const;
  // All members are killed, and started from the backup.
  void restore(const std::string& file);
  std::string control(const std::vector<std::string>& arguments) const;  // etcdctl; what it says

 private:
  struct Member {
    std::string name, client, peer, folder;
    std::unique_ptr<system_test::ChildProcess> process;
    bool is_stopped = false;
  };
  std::string initial_cluster() const;
  std::string scheme() const { return plan_.tls_folder.empty() ? "http://" : "https://"; }

  const Plan plan_;
  system_test::TempFolder folder_;
  std::vector<Member> members_;
  int generation_ = 0;
};

// Ports of the loopback interface that nobody had just now.
std::vector<int> free_ports(std::size_t count);

}  // namespace skerry::fleet
