#include "tests/fuzz/tls_connection.hpp"

#include <openssl/rand.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <utility>

#include "server/net/common/tls_opening.hpp"
#include "tests/fuzz/fuzz_require.hpp"
#include "tests/unit/net/fake_host.hpp"

namespace skerry::fuzz {
namespace {

using namespace skerry::server;
using Kind = TlsOutcome::Kind;

constexpr std::uint64_t kServersSeed = 1;

FixedRandom* random_now = nullptr;

int give_random(unsigned char* bytes, int count) {
  for (int i = 0; i < count; ++i) {
    std::uint64_t z = random_now->state += 0x9E3779B97F4A7C15;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9;
    z = (z ^ z >> 27) * 0x94D049BB133111EB;
    bytes[i] = static_cast<unsigned char>(z ^ z >> 31);
  }
  return 1;
}
int is_ready() { return 1; }

NetConfig config_of_server() {
  NetConfig config;
  config.tls = SKERRY_TLS_KEYS;
  config.limits.handshakes_burst = 1e15;
  return config;
}

// What all connections share, as in a server.
struct Server {
  Server() { spdlog::set_level(spdlog::level::off); }
  FakeHost host;
  NetContext context{host, config_of_server()};
};

NetContext& the_context() {
  static FixedRandom keys_of_tickets{kServersSeed};
  keys_of_tickets.use();
  static Server server;
  return server.context;
}

}  // namespace

// Its like in providers needs more than one function of this file.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
void FixedRandom::use() {
  static const RAND_METHOD method{nullptr, give_random, nullptr, nullptr, give_random, is_ready};
  random_now = this;
  ::RAND_set_rand_method(&method);
}
#pragma GCC diagnostic pop

struct TlsConnection::Parts {
  Parts() {
    std::array<int, 2> pair{};
    require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, pair.data()) == 0,
            "there are sockets");
    client = pair[0];
    const auto take = [this](Kind kind) {
      return [this, kind](PeerStream stream, const ConnectionSlotPtr& slot) {
        ++outcome.times;
        outcome.kind = kind;
        outcome.certificate = slot->peer().certificate;
        outcome.is_secure = slot->peer().is_secure;
        held = slot;
        heard.emplace(std::move(stream));
        hear();
      };
    };
    ConnectionSlotPtr slot = context.connections.try_enter({});
    require(slot != nullptr, "there is a place");
    place = slot;
    open_connection(context, TcpSocket(context.io, asio::ip::tcp::v4(), pair[1]), std::move(slot),
                    {.protocol = "fuzz",
                     .secure = take(Kind::secure),
                     .plain = take(Kind::plain),
                     .patience = std::chrono::hours(1)});
    turn();
  }
  ~Parts() {
    if (client >= 0) ::close(client);
    turn();
    heard.reset();
    held.reset();
    turn();
    require(place.expired(), "no place is kept");
  }

  void turn() {
    random.use();
    context.io.restart();
    context.io.poll();
  }
  void hear() {
    heard->async_read_some(asio::buffer(piece), [this](error_code error, std::size_t size) {
      outcome.heard.insert(outcome.heard.end(), piece.begin(),
                           piece.begin() + static_cast<std::ptrdiff_t>(size));
      if (!error) hear();
    });
  }

  NetContext& context = the_context();
  FixedRandom random{kServersSeed};
  int client = -1;
  TlsOutcome outcome;
  std::weak_ptr<ConnectionSlot> place;
  ConnectionSlotPtr held;
  std::optional<PeerStream> heard;
  std::array<std::uint8_t, 4096> piece{};
};

TlsConnection::TlsConnection() : parts_(std::make_unique<Parts>()) {}
TlsConnection::~TlsConnection() = default;

void TlsConnection::send(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(parts_->client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN) return;  // the server has ended it
    if (sent > 0) bytes = bytes.subspan(static_cast<std::size_t>(sent));
    parts_->turn();
    require(sent > 0, "the server takes what it is sent");
  }
}

void TlsConnection::finish() {
  ::shutdown(parts_->client, SHUT_WR);
  parts_->turn();
}

Bytes TlsConnection::take_answer() {
  Bytes all;
  std::array<std::uint8_t, 16384> piece{};
  for (;;) {
    const ssize_t got = ::recv(parts_->client, piece.data(), piece.size(), 0);
    if (got <= 0) return all;
    all.insert(all.end(), piece.begin(), piece.begin() + got);
  }
}

const TlsOutcome& TlsConnection::outcome() const { return parts_->outcome; }

std::string TlsConnection::key_file(const std::string& name) {
  return std::string(SKERRY_TLS_KEYS) + "/" + name;
}

}  // namespace skerry::fuzz
