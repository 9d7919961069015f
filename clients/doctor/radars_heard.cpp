#include "clients/doctor/radars_heard.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <span>
#include <utility>

#include "protocol/navico/locator.hpp"
#include "protocol/raymarine/quantum_locator.hpp"

namespace skerry::client::doctor {
namespace {

using Clock = std::chrono::steady_clock;

sockaddr_in address_of(const Ipv4Endpoint& at) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(at.port);
  out.sin_addr.s_addr = htonl(at.address);
  return out;
}

class Socket {
 public:
  Socket() : number_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {}
  ~Socket() {
    if (number_ >= 0) ::close(number_);
  }
  Socket(Socket&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Socket& operator=(Socket&&) = delete;

  int number() const { return number_; }
  bool bind(const Ipv4Endpoint& at) {
    const sockaddr_in address = address_of(at);
    return ::bind(number_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  template <typename Value>
  bool set(int level, int option, const Value& value) {
    return ::setsockopt(number_, level, option, &value, sizeof value) == 0;
  }
  bool join(const Ear& ear) {
    const ip_mreq request{{htonl(ear.group.address)}, {htonl(ear.interface_address)}};
    return set(IPPROTO_IP, IP_MULTICAST_ALL, 0) && set(IPPROTO_IP, IP_ADD_MEMBERSHIP, request);
  }

 private:
  int number_;
};

void ask(const Ear& ear) {
  Socket socket;
  const in_addr from{htonl(ear.interface_address)};
  const sockaddr_in to = address_of(ear.group);
  const Bytes question = navico::encode_locator_question();
  if (socket.bind({ear.interface_address, 0}) && socket.set(IPPROTO_IP, IP_MULTICAST_IF, from)) {
    [[maybe_unused]] const auto sent =
        ::sendto(socket.number(), question.data(), question.size(), 0,
                 reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
}

void note_locator(Heard& heard, std::span<const std::uint8_t> datagram) {
  if (heard.ear.group == navico::kLocatorGroup) {
    const auto locator = navico::decode_locator(datagram);
    if (!locator) return;
    heard.serial = locator->serial;
    if (const auto picture = locator->find_picture(1)) heard.data = picture->data;
  } else if (heard.ear.group == raymarine::kLocatorAddress) {
    const auto addresses = raymarine::decode_locator_addresses(datagram);
    if (!addresses) return;
    heard.serial = std::to_string(addresses->id.link_id);
    heard.data = addresses->data;
  }
}

// Displays ask there too: they are no radars.
bool is_question(const Ear& ear, std::span<const std::uint8_t> datagram) {
  return ear.group == navico::kLocatorGroup && !navico::decode_locator(datagram);
}

void read(int socket, const Ear& ear, std::vector<Heard>& out) {
  std::array<std::uint8_t, 65536> room;
  for (int i = 0; i < 64; ++i) {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const ssize_t length =
        ::recvfrom(socket, room.data(), room.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (length < 0) return;
    const auto datagram = std::span(room).first(static_cast<std::size_t>(length));
    if (is_question(ear, datagram)) continue;
    const Ipv4Endpoint sender{ntohl(from.sin_addr.s_addr), ntohs(from.sin_port)};
    auto known = std::find_if(out.begin(), out.end(), [&](const Heard& heard) {
      return heard.ear == ear && heard.sender == sender;
    });
    if (known == out.end()) {
      if (out.size() >= kMostHeard) continue;
      known = out.insert(out.end(), Heard{ear, sender, 0, {}, {}});
    }
    ++known->datagrams;
    note_locator(*known, datagram);
  }
}

}  // namespace

HeardRadars listen_for_radars(const std::vector<Ear>& ears, Duration length,
                              const std::function<bool()>& go_on) {
  HeardRadars out;
  std::vector<Socket> sockets;
  std::vector<Ear> open;
  for (const Ear& ear : ears) {
    Socket socket;
    if (socket.number() >= 0 && socket.set(SOL_SOCKET, SO_REUSEADDR, 1) && socket.bind(ear.group) &&
        socket.join(ear)) {
      sockets.push_back(std::move(socket));
      open.push_back(ear);
    } else {
      out.deaf.push_back({ear, errno});
    }
  }
  std::vector<pollfd> polled;
  for (const Socket& socket : sockets) polled.push_back({socket.number(), POLLIN, 0});
  for (const Ear& ear : open) {
    if (ear.group == navico::kLocatorGroup) ask(ear);
  }
  const auto end = Clock::now() + length;
  while (!polled.empty() && Clock::now() < end && go_on()) {
    if (::poll(polled.data(), polled.size(), 100) <= 0) continue;
    for (std::size_t i = 0; i < polled.size(); ++i) {
      if ((polled[i].revents & POLLIN) != 0) read(polled[i].fd, open[i], out.heard);
    }
  }
  return out;
}

}  // namespace skerry::client::doctor
