// RunningServer: the real skerryd as a child process on free ports of loopback.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/system/child_process.hpp"

namespace skerry::system_test {

// The built programs.
std::string skerryd_program();
std::string skerry_program();

// skerryd with any free TCP and HTTP port, and no datagrams but those asked for in `arguments`
// (--udp, --cat240).  Ready for clients once constructed.
class ServerProcess {
 public:
  // Error: std::runtime_error with what the server wrote, if it does not start.
  explicit ServerProcess(const std::vector<std::string>& arguments);

  std::uint16_t tcp_port() const { return tcp_port_; }
  std::uint16_t http_port() const { return http_port_; }
  // User and system time so far.
  double cpu_seconds() const;
  // The same of its threads, by their names without what follows a hyphen: "radar", "net", "coast".
  std::map<std::string, double> cpu_seconds_by_thread() const;
  bool stopped() const { return stopped_; }
  void signal(int number) { process_.signal(number); }
  // Asks it to stop, as Ctrl-C does.  An exit code other than 0 is a crash or a sanitizer's report,
  // which stands in Ending::err.
  Ending stop();

 private:
  ChildProcess process_;
  std::uint16_t tcp_port_ = 0;
  std::uint16_t http_port_ = 0;
  bool stopped_ = false;
};

// The same for a test, which fails if the server has not ended well.
class RunningServer : public ServerProcess {
 public:
  using ServerProcess::ServerProcess;
  ~RunningServer();

  // Runs `skerry COMMAND --port (of this server) ARGUMENTS`.
  Ending skerry(const std::string& command, const std::vector<std::string>& arguments = {}) const;
};

}  // namespace skerry::system_test
