#include "server/relay/upstream_links.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <map>
#include <thread>
#include <utility>
#include <vector>

#include "clients/common/client_socket.hpp"
#include "protocol/wire/printable_text.hpp"
#include "server/relay/upstream_talk.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::milliseconds kTick{100};
constexpr std::chrono::seconds kConnectPatience{5};
constexpr std::size_t kReadBytes = 256 * 1024;

SteadyTime steady_now() { return std::chrono::steady_clock::now(); }

}  // namespace

class UpstreamLinks::Impl {
 public:
  Impl(UpstreamHost& host, UpstreamPlace place, std::string token,
       std::optional<std::uint32_t> thin, HostLookup::Resolve resolve)
      : place_(std::move(place)),
        name_(place_.host),
        lookup_(io_, name_.name, place_.port, std::move(resolve)),
        talk_(host, std::move(token), steady_now(), thin),
        tick_(io_) {
    host.orders().on_order([this] {
      if (woken_.exchange(true)) return;
      boost::asio::post(io_, [this] {
        woken_.store(false);
        step();
      });
    });
  }
  ~Impl() { stop(); }

  void start() {
    tick();
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "upstream");
      try {
        io_.run();
      } catch (const std::exception& error) {
        spdlog::critical("the thread of the upstream ends: {}", error.what());
        std::terminate();
      }
    });
  }

  void stop() {
    if (std::exchange(stopped_, true)) return;
    if (thread_.joinable()) {
      boost::asio::post(io_, [this] {
        closed_ = true;
        tick_.cancel();
        for (auto& [id, connection] : connections_) connection->close();
        connections_.clear();
      });
      thread_.join();
    }
    talk_.stop();
  }

 private:
  using error_code = boost::system::error_code;
  using tcp = boost::asio::ip::tcp;
  using LineId = UpstreamTalk::LineId;

  struct Connection {
    explicit Connection(boost::asio::io_context& io) : socket(io), into(kReadBytes) {}
    void close() {
      is_closed = true;
      socket.close();
    }
    client::ClientSocket socket;
    std::vector<std::uint8_t> into;
    Bytes out;
    SteadyTime until{};  // for it to be there
    bool is_there = false, is_writing = false, is_closed = false, flush_posted = false;
  };
  using ConnectionPtr = std::shared_ptr<Connection>;  // its handlers hold it

  void tick() {
    talk_.tick(steady_now());
    const auto all = connections_;
    for (const auto& [id, connection] : all) {
      if (connection->is_there || connection->is_closed || steady_now() <= connection->until) {
        continue;
      }
      fail(id, connection, fmt::format("connecting to {} took too long", place_.name()));
    }
    step();
    tick_.expires_after(kTick);
    tick_.async_wait([this](const error_code& error) {
      if (!error && !closed_) tick();
    });
  }

  // What is due now, after anything has happened.
  void step() {
    if (closed_) return;
    talk_.take_orders(steady_now());
    for (const LineId id : talk_.to_end()) {
      const auto found = connections_.find(id);
      if (found == connections_.end()) continue;
      found->second->close();
      connections_.erase(found);
    }
    for (const LineId id : talk_.to_begin(steady_now())) begin(id);
    for (const auto& [id, connection] : connections_) {
      if (connection->is_there) write(id, connection);
    }
  }

  void begin(LineId id) {
    auto connection = std::make_shared<Connection>(io_);
    connections_[id] = connection;
    connection->until = steady_now() + kConnectPatience;
    lookup_.find([this, id, connection](const HostAddresses& found) {
      if (connection->is_closed) return;
      if (found.error) return fail(id, connection, cannot_connect(found.error));
      boost::asio::async_connect(
          connection->socket.tcp_socket(), found.places,
          [this, id, connection](const error_code& refused, const tcp::endpoint&) {
            if (connection->is_closed) return;
            if (refused) return fail(id, connection, cannot_connect(refused));
            secure(id, connection);
          });
    });
  }

  void secure(LineId id, const ConnectionPtr& connection) {
    error_code ignored;
    connection->socket.tcp_socket().set_option(tcp::no_delay(true), ignored);
    if (!name_.secure) return begin_talk(id, connection);
    if (const std::string fault = connection->socket.begin_tls(name_); !fault.empty()) {
      return fail(id, connection, fault);
    }
    connection->socket.async_handshake([this, id, connection](const error_code& error) {
      if (connection->is_closed) return;
      if (!error) return begin_talk(id, connection);
      fail(id, connection,
           fmt::format("no TLS with {}: {}", place_.name(),
                       printable(connection->socket.handshake_fault(error))));
    });
  }

  void begin_talk(LineId id, const ConnectionPtr& connection) {
    connection->is_there = true;
    talk_.connected(id, steady_now());
    read(id, connection);
  }

  void read(LineId id, const ConnectionPtr& connection) {
    connection->socket.async_read_some(
        boost::asio::buffer(connection->into),
        [this, id, connection](const error_code& error, std::size_t size) {
          if (connection->is_closed) return;
          if (error) {
            return fail(id, connection,
                        error == boost::asio::error::eof
                            ? fmt::format("{} closed the connection", place_.name())
                            : fmt::format("the connection to {} ended: {}", place_.name(),
                                          printable(error.message())));
          }
          talk_.take(id, std::span(connection->into).first(size), steady_now());
          step();
          if (connection->is_closed) return;
          read(id, connection);
          flush_later(id, connection);
        });
  }

  // Behind what can be read at once: a sector that came in two pieces leaves in one.
  void flush_later(LineId id, const ConnectionPtr& connection) {
    if (std::exchange(connection->flush_posted, true)) return;
    boost::asio::post(io_, [this, id, connection] {
      connection->flush_posted = false;
      if (!connection->is_closed) talk_.flush(id, steady_now());
    });
  }

  void write(LineId id, const ConnectionPtr& connection) {
    if (connection->is_writing) return;
    connection->out = talk_.take_output(id);
    if (connection->out.empty()) return;
    connection->is_writing = true;
    connection->socket.async_write(boost::asio::buffer(connection->out),
                                   [this, id, connection](const error_code& error, std::size_t) {
                                     connection->is_writing = false;
                                     // What is wrong with it the reading tells.
                                     if (!error && !connection->is_closed) write(id, connection);
                                   });
  }

  std::string cannot_connect(const error_code& error) const {
    return error == boost::asio::error::connection_refused
               ? fmt::format("{} refused the connection", place_.name())
               : fmt::format("cannot connect to {}: {}", place_.name(), printable(error.message()));
  }

  void fail(LineId id, const ConnectionPtr& connection, const std::string& why) {
    connection->close();
    connections_.erase(id);
    talk_.ended(id, why, steady_now());
    step();
  }

  const UpstreamPlace place_;
  const client::HostName name_;
  boost::asio::io_context io_{1};
  HostLookup lookup_;
  UpstreamTalk talk_;
  boost::asio::steady_timer tick_;
  std::map<LineId, ConnectionPtr> connections_;
  std::atomic<bool> woken_{false};
  bool closed_ = false;   // of the thread
  bool stopped_ = false;  // of the owner
  std::thread thread_;
};

UpstreamLinks::UpstreamLinks(UpstreamHost& host, UpstreamPlace place, std::string token,
                             std::optional<std::uint32_t> thin, HostLookup::Resolve resolve)
    : impl_(std::make_unique<Impl>(host, std::move(place), std::move(token), thin,
                                   std::move(resolve))) {}
UpstreamLinks::~UpstreamLinks() = default;
void UpstreamLinks::start() { impl_->start(); }
void UpstreamLinks::stop() { impl_->stop(); }

}  // namespace skerry::server
