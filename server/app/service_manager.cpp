#include "server/app/service_manager.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace skerry::server {
namespace {

// The number that a variable of the environment holds; nothing if it is absent or holds none.
std::optional<std::int64_t> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  std::int64_t number = 0;
  const char* end = text + std::strlen(text);
  const auto read = std::from_chars(text, end, number);
  if (read.ec != std::errc{} || read.ptr != end || number <= 0) return std::nullopt;
  return number;
}

std::int64_t monotonic_us() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000 + now.tv_nsec / 1000;
}

}  // namespace

ServiceManager::ServiceManager(const std::string& socket,
                               std::optional<std::chrono::microseconds> watchdog)
    : watchdog_(watchdog) {
  if (socket.empty()) {
    watchdog_.reset();
    return;
  }
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if ((socket[0] != '/' && socket[0] != '@') || socket.size() < 2 ||
      socket.size() >= sizeof address.sun_path) {
    spdlog::warn(
        "NOTIFY_SOCKET: '{}' is no socket of a service manager, which will not hear that the "
        "server is ready; expected a path, or @ and a name, of 2 to {} bytes",
        socket, sizeof address.sun_path - 1);
    watchdog_.reset();
    return;
  }
  std::memcpy(address.sun_path, socket.data(), socket.size());
  std::size_t length = offsetof(sockaddr_un, sun_path) + socket.size();
  if (socket[0] == '@') {
    address.sun_path[0] = '\0';  // a name of the abstract namespace has no file
  } else {
    ++length;
  }
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket_ >= 0 && ::connect(socket_, reinterpret_cast<const sockaddr*>(&address),
                                static_cast<socklen_t>(length)) != 0) {
    spdlog::warn("NOTIFY_SOCKET: {}: {}; nobody will hear that the server is ready", socket,
                 std::strerror(errno));
    ::close(socket_);
    socket_ = -1;
  }
  if (socket_ < 0) watchdog_.reset();
}

ServiceManager ServiceManager::of_environment() {
  const char* socket = std::getenv("NOTIFY_SOCKET");
  std::optional<std::chrono::microseconds> watchdog;
  const auto watched = number_in("WATCHDOG_PID");
  if (!watched || *watched == ::getpid()) {
    if (const auto time = number_in("WATCHDOG_USEC")) watchdog = std::chrono::microseconds(*time);
  }
  return ServiceManager(socket != nullptr ? socket : "", watchdog);
}

ServiceManager::~ServiceManager() {
  if (socket_ >= 0) ::close(socket_);
}

void ServiceManager::send(const std::string& state) const {
  if (socket_ < 0) return;
  while (::send(socket_, state.data(), state.size(), MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

void ServiceManager::ready(std::string_view status) const {
  // A line more would be an order of its own.
  send(fmt::format("READY=1\nSTATUS={}\n", status.substr(0, status.find('\n'))));
}
void ServiceManager::starting(std::string_view status) const {
  send(fmt::format("STATUS={}\nEXTEND_TIMEOUT_USEC=30000000\n",
                   status.substr(0, status.find('\n'))));
}
void ServiceManager::alive() const { send("WATCHDOG=1\n"); }
// systemd 253 and later wait for this time as well.
void ServiceManager::reloading() const {
  send(fmt::format("RELOADING=1\nMONOTONIC_USEC={}\n", monotonic_us()));
}
void ServiceManager::stopping() const { send("STOPPING=1\nSTATUS=stopping\n"); }

}  // namespace skerry::server
