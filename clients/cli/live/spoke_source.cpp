#include "clients/cli/live/spoke_source.hpp"

#include <fmt/format.h>

#include <chrono>
#include <deque>
#include <utility>
#include <variant>

#include "clients/common/udp_spoke_receiver.hpp"
#include "protocol/asterix/cat240.hpp"

namespace skerry::client {
namespace {

using Next = ClientResult<std::optional<SourcedLine>>;

SourcedLine sourced(Spoke spoke) {
  const std::uint32_t scan = spoke.header.scan, index = spoke.header.index;
  return {.line = line_of(std::move(spoke)), .turn = scan, .begins_turn = index == 0};
}

class TcpSource : public SpokeSource {
 public:
  explicit TcpSource(SpokeClient client) : client_(std::move(client)) {}

  Next next(Duration timeout) override {
    const auto deadline = Clock::now() + timeout;
    do {
      auto event = client_.receive(deadline - Clock::now());
      if (!event) return Failure{event.error()};
      if (!*event) break;
      if (auto* spoke = std::get_if<Spoke>(&**event))
        return std::optional(sourced(std::move(*spoke)));
    } while (Clock::now() < deadline);
    return std::optional<SourcedLine>{};
  }
  std::string name() const override { return client_.name(); }
  std::string advice() const override {
    return "skerry status shows whether the radar is turning or in standby; skerryd is started "
           "with "
           "server/run.";
  }
  std::uint64_t received() const override { return client_.losses().received(); }
  std::uint64_t lost() const override { return client_.losses().lost(); }
  std::uint64_t refused() const override { return 0; }

 private:
  SpokeClient client_;
};

class UdpSource : public SpokeSource {
 public:
  UdpSource(UdpSpokeReceiver receiver, std::optional<std::uint32_t> radar)
      : receiver_(std::move(receiver)), radar_(radar) {}

  Next next(Duration timeout) override {
    const auto deadline = Clock::now() + timeout;
    do {
      auto spoke = receiver_.receive(deadline - Clock::now());
      if (!spoke) return Failure{spoke.error()};
      if (!*spoke) break;
      if (wants((*spoke)->header.radar)) return std::optional(sourced(std::move(**spoke)));
    } while (Clock::now() < deadline);
    return std::optional<SourcedLine>{};
  }
  std::string name() const override { return "UDP " + receiver_.name(); }
  std::string advice() const override {
    return "Is skerryd running (server/run), and does its configuration send native datagrams "
           "there?  127.0.0.1 hears only this host: for others give 0.0.0.0:port or the group.";
  }
  std::uint64_t received() const override { return sum(&LossCounter::received); }
  std::uint64_t lost() const override { return sum(&LossCounter::lost); }
  std::uint64_t refused() const override { return receiver_.refused(); }

 private:
  bool wants(std::uint32_t radar) const { return !radar_ || *radar_ == radar; }
  std::uint64_t sum(std::uint64_t (LossCounter::*count)() const) const {
    std::uint64_t total = 0;
    for (const auto& [view, losses] : receiver_.losses()) {
      if (wants(view.first)) total += (losses.*count)();
    }
    return total;
  }

  UdpSpokeReceiver receiver_;
  std::optional<std::uint32_t> radar_;
};

class Cat240UdpSource : public SpokeSource {
 public:
  explicit Cat240UdpSource(DatagramSocket socket) : socket_(std::move(socket)) {}

  Next next(Duration timeout) override {
    const auto deadline = Clock::now() + timeout;
    do {
      if (auto line = waiting_line()) return line;
      auto datagram = socket_.receive(deadline - Clock::now());
      if (!datagram) return Failure{datagram.error()};
      if (!*datagram) break;
      auto records = decode_cat240(**datagram);
      if (!records) {
        ++refused_;
        continue;
      }
      for (Cat240Record& record : *records) {
        if (record.kind == Cat240Kind::video) waiting_.push_back(std::move(record));
      }
    } while (Clock::now() < deadline);
    return waiting_line();
  }
  std::string name() const override { return "UDP " + socket_.name(); }
  std::string advice() const override {
    return "Is skerryd running (server/run), and does its configuration send CAT240 there?  "
           "127.0.0.1 hears only this host: for others give 0.0.0.0:port or the group.";
  }
  std::uint64_t received() const override { return losses_.received(); }
  std::uint64_t lost() const override { return losses_.lost(); }
  std::uint64_t refused() const override { return refused_; }

 private:
  std::optional<SourcedLine> waiting_line() {
    if (waiting_.empty()) return std::nullopt;
    Cat240Record record = std::move(waiting_.front());
    waiting_.pop_front();
    losses_.take(record.video->message_index);
    const bool past_north = last_azimuth_ && record.video->start_azimuth < *last_azimuth_;
    last_azimuth_ = record.video->start_azimuth;
    if (past_north) ++turn_;
    return SourcedLine{.line = line_of(std::move(*record.video), record.time_of_day),
                       .turn = turn_,
                       .begins_turn = past_north};
  }

  DatagramSocket socket_;
  std::deque<Cat240Record> waiting_;  // of one datagram
  LossCounter losses_;
  std::optional<std::uint16_t> last_azimuth_;
  std::uint32_t turn_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace

ClientResult<SpokeSourcePtr> open_tcp_source(const ServerPlace& place, ViewChoice choice) {
  auto client = place.connect();
  if (!client) return Failure{client.error()};
  const auto subscribed = client->subscribe(choice.radar, choice.view, place.timeout());
  if (!subscribed) return Failure{subscribed.error()};
  return SpokeSourcePtr(std::make_unique<TcpSource>(std::move(client).value()));
}

ClientResult<SpokeSourcePtr> open_udp_source(const UdpAddress& where,
                                             std::optional<std::uint32_t> radar) {
  auto receiver = UdpSpokeReceiver::open(where);
  if (!receiver) return Failure{receiver.error()};
  return SpokeSourcePtr(std::make_unique<UdpSource>(std::move(receiver).value(), radar));
}

ClientResult<SpokeSourcePtr> open_cat240_source(const UdpAddress& where) {
  auto socket = DatagramSocket::open(where);
  if (!socket) return Failure{socket.error()};
  return SpokeSourcePtr(std::make_unique<Cat240UdpSource>(std::move(socket).value()));
}

}  // namespace skerry::client
