#include "server/net/common/tls_opening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <utility>

#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

constexpr unsigned char kHandshakeRecord = 22;

class TlsOpening final : public Connection, public std::enable_shared_from_this<TlsOpening> {
 public:
  TlsOpening(NetContext& context, TcpSocket socket, ConnectionSlotPtr slot, OpeningTo to)
      : context_(context), to_(std::move(to)), stream_(std::move(socket)), slot_(std::move(slot)) {}

  void start() {
    slot_->owner = weak_from_this();
    set_stream_options(stream_.socket());
    error_code ignored;
    stream_.socket().non_blocking(true, ignored);
    allow(slot_->place() == Place::on_trial
              ? std::min(to_.patience, context_.config.limits.trial_time)
              : to_.patience);
    stream_.socket().async_wait(
        asio::socket_base::wait_read,
        [self = shared_from_this()](error_code error) { self->look(error); });
  }

  void close() override { stream_.close(); }
  void check(std::chrono::steady_clock::time_point now) override {
    if (now < until_ || is_late_) return;
    is_late_ = true;
    stream_.cancel();
  }

 private:
  void allow(std::chrono::milliseconds time) { until_ = std::chrono::steady_clock::now() + time; }

  void look(error_code error) {
    if (is_late_ && error == asio::error::operation_aborted) {
      if (to_.silent) hand_on(to_.silent);
      return;
    }
    std::array<unsigned char, 1> first{};
    if (!error) {
      stream_.socket().receive(asio::buffer(first), asio::socket_base::message_peek, error);
    }
    if (error) return;  // it has gone
    if (first[0] != kHandshakeRecord) return hand_on(to_.plain);
    if (!context_.handshakes.take(slot_->peer(), std::chrono::steady_clock::now())) {
      return context_.complain(
          to_.protocol + " too many TLS handshakes",
          fmt::format("{}: {}", slot_->peer().text, context_.handshakes.refusal(slot_->peer())));
    }
    allow(context_.config.limits.opening_time);
    keys_ = context_.tls->context();
    stream_.begin_tls(*keys_);
    stream_.async_handshake([self = shared_from_this()](error_code failed) {
      if (failed) return self->tell(failed);
      self->slot_->secure(certificate_shown(self->stream_.tls()),
                          certificate_end(self->stream_.tls()));
      if (self->context_.knows(self->slot_->peer())) self->slot_->trust();
      self->hand_on(self->to_.secure);
    });
  }

  void tell(error_code failed) {
    const std::string& peer = slot_->peer().text;
    if (const auto fault = certificate_fault(stream_.tls())) {
      const std::string what = "the client's certificate is not taken: " + *fault;
      context_.complain(to_.protocol + " TLS client certificate", peer + ": " + what);
      return context_.audit(
          {.kind = AuditEntry::Kind::refusal, .from = to_.protocol + " " + peer, .what = what});
    }
    context_.errors.add(to_.protocol + " TLS handshake",
                        peer + ": " + (is_late_ ? "not done in time" : failed.message()));
  }

  void hand_on(const OpeningTo::Take& take) { take(std::move(stream_), std::move(slot_)); }

  NetContext& context_;
  const OpeningTo to_;
  PeerStream stream_;
  ConnectionSlotPtr slot_;
  TlsContextPtr keys_;  // as long as it may be needed
  std::chrono::steady_clock::time_point until_{};
  bool is_late_ = false;
};

}  // namespace

void open_connection(NetContext& context, TcpSocket socket, ConnectionSlotPtr slot, OpeningTo to) {
  std::make_shared<TlsOpening>(context, std::move(socket), std::move(slot), std::move(to))->start();
}

}  // namespace skerry::server
