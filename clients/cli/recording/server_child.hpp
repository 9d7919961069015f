// ServerChild: a skerryd of this program's own.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace skerry::client {

// This process goes on as skerryd, found as ServerChild finds it.
// Error: std::runtime_error if it cannot be started.
[[noreturn]] void become_server(std::vector<std::string> arguments);

// skerryd as it lies beside this program, or else on PATH.  Its messages go where ours go.  It ends
// with this object, and with this process however that ends.
// Thread: one at a time; the process is a child of the thread that made it.
class ServerChild {
 public:
  // Error: std::runtime_error if it cannot be started.
  explicit ServerChild(std::vector<std::string> arguments);
  ~ServerChild();  // as Ctrl-C does, and waits
  ServerChild(const ServerChild&) = delete;
  ServerChild& operator=(const ServerChild&) = delete;

  // Its native port, once it takes clients; nothing if it ended before, or Ctrl-C came.
  std::optional<std::uint16_t> await_port();
  // Whether it has ended by itself, and how: its exit code, or 128 and the signal's number.
  std::optional<int> ended();

 private:
  pid_t pid_ = 0;  // 0: waited for
  int out_ = -1;
  int code_ = 0;
};

}  // namespace skerry::client
