// NotifySocket: a service manager's end of sd_notify(3), for tests.
#pragma once

#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace skerry::test {

class NotifySocket {
 public:
  enum class Kind { file, abstract };

  explicit NotifySocket(Kind kind = Kind::file) {
    if (kind == Kind::file) {
      std::string pattern = (std::filesystem::temp_directory_path() / "skerry-XXXXXX").string();
      if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no folder");
      folder_ = pattern;
    }
    path_ = kind == Kind::file ? (folder_ / "notify").string()
                               : "@skerry-test-" + std::to_string(::getpid());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path_.data(), path_.size());
    std::size_t length = offsetof(sockaddr_un, sun_path) + path_.size();
    if (kind == Kind::abstract) {
      address.sun_path[0] = '\0';
    } else {
      ++length;
    }
    socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const timeval patience{.tv_sec = 60, .tv_usec = 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address),
               static_cast<socklen_t>(length)) != 0) {
      throw std::runtime_error("cannot bind " + path_);
    }
  }
  ~NotifySocket() {
    ::close(socket_);
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  const std::string& path() const { return path_; }  // for NOTIFY_SOCKET

  // The next datagram; empty if none comes for a minute.
  std::string next() const { return received(0); }
  // All datagrams that wait.
  std::vector<std::string> told() const {
    std::vector<std::string> all;
    for (std::string each; !(each = received(MSG_DONTWAIT)).empty();) all.push_back(each);
    return all;
  }

 private:
  std::string received(int flags) const {
    std::array<char, 4096> bytes{};
    const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), flags);
    return size <= 0 ? std::string() : std::string(bytes.data(), static_cast<std::size_t>(size));
  }

  std::filesystem::path folder_;
  std::string path_;
  int socket_ = -1;
};

}  // namespace skerry::test
