#include "server/net/live/live_inputs.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "server/net/common/asio.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/common/output_socket.hpp"

namespace skerry::server {
class LiveInputs::Impl {
 public:
  Impl(LiveHost& host, const std::vector<LiveSource>& sources) : host_(host), tick_(io_) {
    host.on_order([this] {
      asio::post(io_, [this] {
        for (const auto& port : ports_) send_orders(*port);
      });
    });
    for (std::size_t i = 0; i < sources.size(); ++i) {
      ports_.push_back(std::make_unique<Port>(i, sources[i]));
      try {
        open(*ports_.back());
      } catch (const std::runtime_error& problem) {
        throw std::runtime_error(fmt::format("input {} of radar {} at {}: {}",
                                             sources[i].kind->name, sources[i].radar,
                                             sources[i].interface_address, problem.what()));
      }
    }
  }
  ~Impl() { stop(); }

  void start() {
    for (const auto& port : ports_) {
      for (const EarPtr& ear : port->ears) wait(*port, ear);
    }
    tick();
    thread_ = std::thread([this] {
      pthread_setname_np(pthread_self(), "live");
      try {
        io_.run();
      } catch (const std::exception& error) {
        spdlog::critical("the thread of live radars ends: {}", error.what());
        std::terminate();
      }
    });
  }

  void stop() {
    if (!thread_.joinable()) return;
    asio::post(io_, [this] {
      closed_ = true;
      tick_.cancel();
      error_code ignored;
      for (const auto& port : ports_) {
        for (const auto& ear : port->ears) ear->socket.close(ignored);
      }
    });
    thread_.join();
  }

 private:
  // A socket for one group, or one port of this host.
  struct Ear {
    Ear(const Ipv4Endpoint& address, UdpSocket opened) : at(address), socket(std::move(opened)) {}
    Ipv4Endpoint at;
    UdpSocket socket;
    bool rests = false;  // this window has had its datagrams
    bool waits = false;  // for more
  };
  using EarPtr = std::shared_ptr<Ear>;  // its handlers hold it
  struct Port {
    Port(std::size_t number, const LiveSource& from) : index(number), source(from) {}
    std::size_t index;
    LiveSource source;
    std::vector<EarPtr> ears;
    std::optional<UdpSocket> asking;
    std::size_t left = kMost;
  };

  // Listens to what the host's groups are now, and to nothing else; what is new stands last.
  void open(Port& port) {
    error_code error;
    const auto interface = asio::ip::make_address_v4(port.source.interface_address, error);
    if (error) throw std::runtime_error("interface_address must be an IPv4 address of this host");
    const LiveGroups& groups = host_.groups(port.index);
    std::erase_if(port.ears, [&](const EarPtr& ear) {
      const bool gone = !contains(groups.all(), ear->at);
      error_code ignored;
      if (gone) ear->socket.close(ignored);
      return gone;
    });
    for (const Ipv4Endpoint& at : groups.all()) {
      const bool known = std::any_of(port.ears.begin(), port.ears.end(),
                                     [&](const EarPtr& ear) { return ear->at == at; });
      if (!known) {
        port.ears.push_back(std::make_shared<Ear>(at, open_listening(io_, {at}, interface)));
      }
    }
    if ((!groups.questions().empty() || port.source.commands) && !port.asking) {
      port.asking = open_sending(io_, interface, interface.is_loopback() ? 0 : 1);
    }
  }

  static bool contains(const std::vector<Ipv4Endpoint>& all, const Ipv4Endpoint& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  }

  void wait(Port& port, const EarPtr& ear) {
    ear->waits = true;
    ear->socket.async_wait(UdpSocket::wait_read, [this, &port, ear](error_code error) {
      ear->waits = false;
      if (!error && !closed_ && ear->socket.is_open()) read(port, ear);
    });
  }

  void read(Port& port, const EarPtr& held) {
    Ear& ear = *held;
    // Others on this thread have their turn in between.
    constexpr int kAtOnce = 64;
    bool more = false;
    for (int i = 0; i < kAtOnce; ++i) {
      if (port.left == 0) {
        ear.rests = true;
        break;
      }
      asio::ip::udp::endpoint from;
      error_code error;
      const std::size_t size = ear.socket.receive_from(asio::buffer(buffer_), from, 0, error);
      if (error) break;
      --port.left;
      more |= host_.take(
          port.index, {utc_now(), ipv4_endpoint_of(from), ear.at, std::span(buffer_).first(size)});
    }
    if (more) listen_anew(port);
    if (!ear.rests && ear.socket.is_open() && !ear.waits) wait(port, held);
  }

  void listen_anew(Port& port) {
    try {
      open(port);
    } catch (const std::runtime_error& problem) {
      spdlog::warn("input {} of radar {}: {}", port.source.kind->name, port.source.radar,
                   problem.what());
    }
    for (const EarPtr& ear : port.ears) {
      if (!ear->waits && !ear->rests) wait(port, ear);
    }
  }

  void tick() {
    const auto now = std::chrono::steady_clock::now();
    const bool asks = now - asked_ >= kAskEvery;
    if (asks) asked_ = now;
    for (const auto& port : ports_) {
      port->left = kMost;
      for (const EarPtr& ear : port->ears) {
        if (!ear->rests) continue;
        ear->rests = false;
        drop_waiting(*port, *ear);
        wait(*port, ear);
      }
      if (host_.look(port->index, utc_now())) listen_anew(*port);
      if (asks && port->asking) ask(*port);
      send_orders(*port);
    }
    tick_.expires_after(kWindow);
    tick_.async_wait([this](error_code error) {
      if (!error && !closed_) tick();
    });
  }

  // Old video is worth nothing: what waits is counted and let go, a window's share at most.
  void drop_waiting(Port& port, Ear& ear) {
    std::uint64_t dropped = 0;
    asio::ip::udp::endpoint from;
    for (error_code error; dropped < kMost; ++dropped) {
      ear.socket.receive_from(asio::buffer(buffer_), from, 0, error);
      if (error) break;
    }
    host_.count_dropped(port.index, dropped);
  }

  void ask(Port& port) {
    for (const LiveGroups::Question& question : host_.groups(port.index).questions()) {
      error_code ignored;  // it is asked again
      port.asking->send_to(asio::buffer(question.octets),
                           {asio::ip::address_v4(question.to.address), question.to.port}, 0,
                           ignored);
    }
  }

  void send_orders(Port& port) {
    const LiveHost::Orders orders = host_.take_orders(port.index, utc_now());
    for (const Bytes& command : orders.commands) {
      error_code error;
      port.asking->send_to(asio::buffer(command),
                           {asio::ip::address_v4(orders.to.address), orders.to.port}, 0, error);
      if (error)
        spdlog::warn("radar {}: a command was not sent: {}", port.source.radar, error.message());
    }
  }

  LiveHost& host_;
  asio::io_context io_{1};
  Timer tick_;
  std::vector<std::unique_ptr<Port>> ports_;
  std::array<std::uint8_t, 65536> buffer_{};
  std::chrono::steady_clock::time_point asked_{};
  bool closed_ = false;
  std::thread thread_;
};

LiveInputs::LiveInputs(LiveHost& host, const std::vector<LiveSource>& sources)
    : impl_(std::make_unique<Impl>(host, sources)) {}
LiveInputs::~LiveInputs() = default;
void LiveInputs::start() { impl_->start(); }
void LiveInputs::stop() { impl_->stop(); }

}  // namespace skerry::server
