#include "server/net/signalk/signalk_spoke_session.hpp"

#include <utility>

#include "server/net/common/tcp_peer.hpp"
#include "server/net/signalk/signalk_encoder.hpp"

namespace skerry::server {

void SignalkSpokeSession::begin(NetContext& context, SignalkSite& site, std::uint32_t radar,
                                std::unique_ptr<WsStream> stream, ConnectionSlotPtr slot,
                                const StreamRight& right) {
  const auto session = std::make_shared<SignalkSpokeSession>(context, radar, std::move(stream),
                                                             std::move(slot), right);
  session->start();
  site.enter(session);
}

SignalkSpokeSession::SignalkSpokeSession(NetContext& context, std::uint32_t radar,
                                         std::unique_ptr<WsStream> stream, ConnectionSlotPtr slot,
                                         const StreamRight& right)
    : context_(context),
      stream_(std::move(stream)),
      slot_(std::move(slot)),
      client_(context.clients.add("signalk", slot_->peer().text)),
      radar_(radar),
      right_(right) {}

void SignalkSpokeSession::start() {
  slot_->owner = weak_from_this();
  PeerStream& tcp = beast::get_lowest_layer(*stream_);
  set_stream_options(tcp.socket());
  set_send_buffer(tcp.socket(), context_.send_buffer_for(radar_));
  tcp.expires_never();
  stream_->binary(true);
  stream_->auto_fragment(false);
  stream_->read_message_max(0);  // read piecewise and thrown away
  client_->radar.store(radar_, std::memory_order_relaxed);
  feed_ = context_.find_feed(radar_, 0, kSignalkFormat);
  cursor_ = feed_->add(*this);
  read();
}

void SignalkSpokeSession::close() {
  if (feed_ == nullptr) return;
  feed_->remove(*this);
  feed_ = nullptr;
  beast::get_lowest_layer(*stream_).close();
}

void SignalkSpokeSession::check(std::chrono::steady_clock::time_point now) {
  if (!writing_ || slot_->is_trusted()) return;
  if (now - write_began_ <= context_.config.limits.unread_time) return;
  if (feed_ != nullptr) context_.complain("signalk does not read", client_->peer + ": closed");
  close();
}

void SignalkSpokeSession::on_tick(std::chrono::steady_clock::time_point) {
  if (!right_.has_ended()) return pump(true);
  context_.errors.add("no longer allowed", client_->peer);
  close();
}

void SignalkSpokeSession::read() {
  stream_->async_read_some(asio::buffer(unread_),
                           [self = shared_from_this()](error_code error, std::size_t) {
                             if (error) return self->close();
                             if (self->feed_ != nullptr) self->read();
                           });
}

void SignalkSpokeSession::pump(bool all) {
  if (writing_ || feed_ == nullptr) return;
  while (held_spokes_ < kMostSpokes) {
    EncodedSectorPtr sector = feed_->ring().take(cursor_);
    if (sector == nullptr) break;
    held_spokes_ += sector->spoke_count();
    if (!sector->bytes.empty()) held_.push_back(std::move(sector));
  }
  client_->spokes_lost.store(cursor_.spokes_lost, std::memory_order_relaxed);
  if (held_spokes_ == 0 || (held_spokes_ < kMessageSpokes && !all)) return;
  buffers_.clear();
  for (const EncodedSectorPtr& sector : held_) {
    buffers_.emplace_back(sector->bytes.data(), sector->bytes.size());
  }
  writing_ = true;
  write_began_ = std::chrono::steady_clock::now();
  stream_->async_write(buffers_, [self = shared_from_this()](error_code error, std::size_t size) {
    self->on_written(error, size);
  });
}

void SignalkSpokeSession::on_written(error_code error, std::size_t size) {
  writing_ = false;
  client_->bytes_sent.fetch_add(size, std::memory_order_relaxed);
  if (!error) client_->spokes_sent.fetch_add(held_spokes_, std::memory_order_relaxed);
  held_.clear();
  held_spokes_ = 0;
  if (error) return close();
  pump(false);
}

}  // namespace skerry::server
