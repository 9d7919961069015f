// ChildServer: a skerryd of its own, on free ports of loopback.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace skerry::bench {

// Starts on construction, on the built-in scenario unless `arguments` name another; is asked to
// stop, and waited for, on destruction. Error: std::runtime_error if it cannot be started or ends
// before it listens.
class ChildServer {
 public:
  // `log`: where its log goes, behind what the file has.
  explicit ChildServer(const std::vector<std::string>& arguments = {},
                       const std::string& log = "/dev/null");
  ~ChildServer();
  ChildServer(const ChildServer&) = delete;
  ChildServer& operator=(const ChildServer&) = delete;

  std::uint16_t tcp_port() const { return tcp_port_; }
  std::uint16_t http_port() const { return http_port_; }
  double cpu_seconds() const;  // user and system, of all threads so far
  double thread_cpu_seconds(const std::string& name) const;  // 0 if it has no such thread
  // All its threads run on that core from now on.  Error: std::runtime_error if it cannot be.
  void pin_to(int core) const;
  double resident_mib() const;  // VmRSS
  pid_t pid() const { return pid_; }
  // Asks it to stop and waits; its exit code, or 128 and the number of the signal that ended it.
  int stop();

 private:
  pid_t pid_ = 0;
  std::uint16_t tcp_port_ = 0, http_port_ = 0;
};

}  // namespace skerry::bench
