#include "tests/unit/net/display_socket.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace skerry::server {
namespace {

sockaddr_in address_of(const Ipv4Endpoint& endpoint) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_addr.s_addr = htonl(endpoint.address);
  out.sin_port = htons(endpoint.port);
  return out;
}

void must(int result, const char* what) {
  if (result != 0) throw std::runtime_error(std::string("a display's socket: cannot ") + what);
}

}  // namespace

DisplaySocket::DisplaySocket(Ipv4Endpoint group, std::uint32_t interface_address)
    : hears_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)),
      sends_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const int on = 1, off = 0, buffer = 8 * 1024 * 1024;
  ::setsockopt(hears_, SOL_SOCKET, SO_RCVBUF, &buffer, sizeof buffer);
  ::setsockopt(hears_, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on);
  if (group.is_multicast()) ::setsockopt(hears_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in at =
      address_of(group.is_multicast() ? group : Ipv4Endpoint{interface_address, group.port});
  must(::bind(hears_, reinterpret_cast<const sockaddr*>(&at), sizeof at), "bind");
  socklen_t size = sizeof at;
  ::getsockname(hears_, reinterpret_cast<sockaddr*>(&at), &size);
  port_ = ntohs(at.sin_port);
  if (group.is_multicast()) {
    must(::setsockopt(hears_, IPPROTO_IP, IP_MULTICAST_ALL, &off, sizeof off), "choose groups");
    const ip_mreq membership{{htonl(group.address)}, {htonl(interface_address)}};
    must(::setsockopt(hears_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership),
         "join");
  }
  const sockaddr_in own = address_of({interface_address, 0});
  must(::bind(sends_, reinterpret_cast<const sockaddr*>(&own), sizeof own),
       "bind to the interface");
  const in_addr interface { htonl(interface_address) };
  must(::setsockopt(sends_, IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface),
       "send by that interface");
}

DisplaySocket::~DisplaySocket() {
  ::close(hears_);
  ::close(sends_);
}

void DisplaySocket::send(const Ipv4Endpoint& to, std::span<const std::uint8_t> payload) {
  const sockaddr_in there = address_of(to);
  if (::sendto(sends_, payload.data(), payload.size(), 0, reinterpret_cast<const sockaddr*>(&there),
               sizeof there) < 0) {
    throw std::runtime_error("a display cannot send to " + text_of(to));
  }
}

void DisplaySocket::send(const Ipv4Endpoint& to, const std::string& text) {
  send(to, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::optional<DisplaySocket::Received> DisplaySocket::receive(std::uint32_t from,
                                                              std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    pollfd waits{hears_, POLLIN, 0};
    if (::poll(&waits, 1, static_cast<int>(std::max<std::int64_t>(0, left.count()))) <= 0) {
      return std::nullopt;
    }
    Received received;
    received.payload.resize(65536);
    sockaddr_in source{};
    iovec piece{received.payload.data(), received.payload.size()};
    alignas(cmsghdr) std::array<char, 128> control{};
    msghdr message{};
    message.msg_name = &source;
    message.msg_namelen = sizeof source;
    message.msg_iov = &piece;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const auto length = ::recvmsg(hears_, &message, 0);
    if (length < 0) throw std::runtime_error("a display's socket was taken away");
    for (cmsghdr* one = CMSG_FIRSTHDR(&message); one != nullptr; one = CMSG_NXTHDR(&message, one)) {
      if (one->cmsg_level != SOL_SOCKET || one->cmsg_type != SCM_TIMESTAMPNS) continue;
      timespec time{};
      std::memcpy(&time, CMSG_DATA(one), sizeof time);
      received.time = std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
    }
    received.payload.resize(static_cast<std::size_t>(length));
    received.from = {ntohl(source.sin_addr.s_addr), ntohs(source.sin_port)};
    if (from == 0 || received.from.address == from) return received;
  }
}

}  // namespace skerry::server
