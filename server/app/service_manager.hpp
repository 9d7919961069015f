// ServiceManager: what systemd is told of the server, as sd_notify(3) has it.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace skerry::server {

// Each call sends one datagram to the service manager that started this program, and returns at
// once; one that cannot be sent is dropped.  Where there is no manager, nothing is sent.
// Thread: any.
class ServiceManager {
 public:
  // `socket`: a path, or '@' and a name; empty: no manager.  `watchdog`: the longest time that it
  // waits between two alive(); nothing: it does not watch.
  // Error: if `socket` is neither, or nobody is there: a line of the log, and no manager.
  explicit ServiceManager(const std::string& socket,
                          std::optional<std::chrono::microseconds> watchdog = {});
  // As NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID of the environment say.
  static ServiceManager of_environment();
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  bool is_there() const { return socket_ >= 0; }
  std::optional<std::chrono::microseconds> watchdog() const { return watchdog_; }

  // `status` is what `systemctl status` shows from then on.  Its first line.
  void ready(std::string_view status) const;
  // Before that: it goes on being waited for.
  void starting(std::string_view status) const;
  void alive() const;
  void reloading() const;  // until the next ready()
  void stopping() const;

 private:
  void send(const std::string& state) const;

  int socket_ = -1;
  std::optional<std::chrono::microseconds> watchdog_;
};

}  // namespace skerry::server
