#include "tests/bench/soak/intruders.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <string_view>

namespace skerry::bench {
namespace {

struct Kind {
  const char* name;
  bool on_http;
  int crowd;
  std::string_view words;  // kRandom: octets at random
};
constexpr std::string_view kRandom = "?";
constexpr std::array kKinds = {
    Kind{"garbage on the native port", false, 5, kRandom},
    Kind{"garbage on the HTTP port", true, 5, kRandom},
    Kind{"silent connections", false, 60, ""},
    Kind{"half a request", true, 60, "GET /status HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Half: "},
    Kind{"an endless frame", false, 5, "\xff\xff\xff\x7f"},
    Kind{"a page, and away", true, 30, "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"},
    Kind{
        "half a WebSocket", true, 20,
        "GET /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n\x82\xfe"},
    Kind{"an enormous body", true, 5,
         "POST /login HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 99999999999\r\n\r\nx"},
};

}  // namespace

struct Intruders::Intruder {
  int socket = -1;
  Clock::time_point goes;
  ~Intruder() { ::close(socket); }
};

Intruders::Intruders(std::uint16_t tcp_port, std::uint16_t http_port, std::uint64_t seed)
    : tcp_port_(tcp_port), http_port_(http_port), random_(seed) {}
Intruders::~Intruders() = default;

const char* Intruders::come(Clock::time_point now) {
  const Kind& kind = kKinds[next_kind_++ % kKinds.size()];
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(kind.on_http ? http_port_ : tcp_port_);
  for (int i = 0; i < kind.crowd; ++i) {
    auto intruder = std::make_unique<Intruder>();
    intruder->socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    intruder->goes = now + kPatience;
    ++came_;
    if (::connect(intruder->socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) !=
        0) {
      ++refused_;
      continue;
    }
    std::string words(kind.words);
    if (kind.words == kRandom) {
      words.assign(1 + random_() % 4096, ' ');
      for (char& octet : words) octet = static_cast<char>(random_());
    }
    ::send(intruder->socket, words.data(), words.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    inside_.push_back(std::move(intruder));
  }
  return kind.name;
}

void Intruders::look(Clock::time_point now) {
  std::array<char, 65536> heard;
  std::erase_if(inside_, [&](const std::unique_ptr<Intruder>& intruder) {
    ssize_t size = 0;
    do {
      size = ::recv(intruder->socket, heard.data(), heard.size(), MSG_DONTWAIT);
    } while (size > 0);
    const bool is_closed = size == 0 || (errno != EAGAIN && errno != EINTR);
    closed_ += is_closed ? 1 : 0;
    return is_closed || now > intruder->goes;
  });
}

}  // namespace skerry::bench
