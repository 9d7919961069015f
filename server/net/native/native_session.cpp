#include "server/net/native/native_session.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/net/common/encoders.hpp"

namespace skerry::server {
namespace {

// For a client to read the error reply and end its side, before the server closes all the same.
constexpr std::chrono::milliseconds kFarewellTime{2000};

}  // namespace

std::string native_refusal(const std::string& reason) {
  wire::ServerMessage message;
  message.mutable_reply()->set_code(wire::Reply::REFUSED);
  message.mutable_reply()->set_text(reason);
  Bytes bytes;
  append_frame(bytes, message);
  return {bytes.begin(), bytes.end()};
}

void NativeSession::begin(NetContext& context, std::unique_ptr<ByteTransport> transport,
                          ConnectionSlotPtr slot, std::string token) {
  std::make_shared<NativeSession>(context, std::move(transport), std::move(slot), std::move(token))
      ->start();
}

NativeSession::NativeSession(NetContext& context, std::unique_ptr<ByteTransport> transport,
                             ConnectionSlotPtr slot, std::string token)
    : context_(context),
      transport_(std::move(transport)),
      slot_(std::move(slot)),
      client_(context.clients.add(transport_->name(), slot_->peer().text)),
      deadline_(context.io),
      boards_(context, *this),
      token_(std::move(token)) {}

void NativeSession::start() {
  slot_->owner = weak_from_this();
  began_ = std::chrono::steady_clock::now();
  if (slot_->place() == Place::refused) {
    fail(wire::Reply::REFUSED, "refused", slot_->reason());
  } else {
    wire::ServerMessage message;
    *message.mutable_hello() = context_.hello();
    message.mutable_hello()->set_you(origin());
    send(message);
    if (context_.knows(slot_->peer(), token_)) tell_sign_in();
  }
  pump();
  read();
}

void NativeSession::close() {
  if (closed_) return;
  closed_ = true;
  unsubscribe();
  boards_.leave();
  {
    // Whose token has ended meanwhile is still the one who had the con.
    const Who who = context_.who(slot_->peer(), token_);
    const AuditedRequest audited(context_.config.audit, origin(), who.role ? text_of(who) : who_);
    context_.host.leave(origin());
  }
  if (has_made_token_) context_.gate.sign_out(token_);
  deadline_.cancel();
  transport_->close();
  spdlog::debug("{} {} closed: {} spokes sent, {} lost", client_->transport, client_->peer,
                client_->spokes_sent.load(), client_->spokes_lost.load());
}

void NativeSession::read() {
  if (reading_ || closed_) return;
  reading_ = true;
  transport_->read_some(read_buffer_,
                        [self = shared_from_this()](error_code error, std::size_t size) {
                          self->reading_ = false;
                          self->on_read(error, size);
                        });
}

void NativeSession::on_read(error_code error, std::size_t size) {
  if (closed_) return;
  if (error == boost::system::errc::bad_message && !failed_) {
    fail(wire::Reply::MALFORMED, "malformed request", "a text message; expected binary frames");
  } else if (error) {
    return close();
  } else if (!failed_) {
    reader_.feed(std::span(read_buffer_).first(size));
  }
  process();
}

void NativeSession::process() {
  bool handled_all = false;
  do {
    while (!failed_ && !answer_pending_ && !handled_all && !replies_full()) {
      handled_all = !handle_next();
    }
    pump();  // makes room for more replies, unless a write is in flight
  } while (!failed_ && !answer_pending_ && !handled_all && !replies_full());

  if (answer_pending_) return;  // goes on when it is there
  if (failed_ || handled_all) {
    if (std::exchange(waiting_for_replies_, false) && !failed_) deadline_.cancel();
    read();
  } else if (!std::exchange(waiting_for_replies_, true)) {
    end_after(context_.config.reply_timeout, "replies not read");
  }
}

bool NativeSession::handle_next() {
  const auto frame = reader_.next();
  if (!frame.ok()) {
    fail(wire::Reply::MALFORMED, "malformed request",
         fmt::format("{} at byte {}: {}", name_of(frame.error().kind), frame.error().offset,
                     frame.error().text));
    return false;
  }
  if (frame->has_value()) handle(**frame);
  return frame->has_value();
}

void NativeSession::handle(std::span<const std::uint8_t> body) {
  wire::ClientMessage message;
  if (!message.ParseFromArray(body.data(), static_cast<int>(body.size()))) {
    return fail(wire::Reply::MALFORMED, "malformed request",
                fmt::format("a frame of {} bytes that is no ClientMessage", body.size()));
  }
  has_asked_ = true;
  if (!admits(message)) return;
  if (!may(message)) return;
  switch (message.kind_case()) {
    case wire::ClientMessage::kSignIn:
      return sign_in(message.request(), message.sign_in());
    case wire::ClientMessage::kSubscribe:
      return subscribe(message.request(), message.subscribe());
    case wire::ClientMessage::kSet:
      return set(message.request(), message.set());
    case wire::ClientMessage::kGetStatus: {
      wire::ServerMessage answer;
      *answer.mutable_status() = is_trusted() ? context_.status() : context_.status_for_strangers();
      send(answer);
      return reply(message.request(), wire::Reply::OK, "");
    }
    case wire::ClientMessage::kGetHops:
      return get_hops(message.request());
    case wire::ClientMessage::kBoardAccess:
    case wire::ClientMessage::kBoardStream:
    case wire::ClientMessage::kBoardFifo:
    case wire::ClientMessage::kBoardRing:
      return ask_board(message);
    case wire::ClientMessage::kGetCoastline:
      return get_coastline(message.request(), message.get_coastline());
    case wire::ClientMessage::kGetChartObjects:
      return get_chart_objects(message.request(), message.get_chart_objects());
    case wire::ClientMessage::kTargetOrder:
      return order_targets(message.request(), message.target_order());
    case wire::ClientMessage::kRecord:
      return record(message.request(), message.record());
    case wire::ClientMessage::kPlayback:
      return control_playback(message.request(), message.playback());
    case wire::ClientMessage::kClassOrder:
      return order_class(message.request(), message.class_order());
    case wire::ClientMessage::KIND_NOT_SET:
      break;
  }
  fail(wire::Reply::MALFORMED, "malformed request",
       "a ClientMessage without a kind this server knows; expected sign_in, subscribe, set, "
       "get_status, get_hops, record, playback, get_coastline, get_chart_objects, target_order, "
       "class_order or one of a board's");
}

void NativeSession::unsubscribe() {
  subscribed_.reset();
  if (feed_ == nullptr) return;
  feed_->remove(*this);
  feed_ = nullptr;
  lost_before_ += cursor_.spokes_lost;
  cursor_ = {};
  news_ = {};
  wanted_targets_ = nullptr;
}

void NativeSession::limit_send_buffer() { on_send_buffer(boards_.send_buffer()); }

void NativeSession::on_send_buffer(std::size_t bytes) {
  look_at_rights();
  if (spoke_buffer_ + bytes > 0) transport_->limit_send_buffer(spoke_buffer_ + bytes);
}

void NativeSession::reply(std::uint32_t request, wire::Reply::Code code, std::string text,
                          std::uint32_t view) {
  wire::Reply answer;
  answer.set_code(code);
  answer.set_text(std::move(text));
  answer.set_view(view);
  reply(request, std::move(answer));
}

void NativeSession::reply(std::uint32_t request, wire::Reply answer) {
  audit(answer);
  wire::ServerMessage message;
  *message.mutable_reply() = std::move(answer);
  message.mutable_reply()->set_request(request);
  send(message);
}

void NativeSession::fail(wire::Reply::Code code, std::string_view kind, std::string text) {
  context_.complain(fmt::format("{} {}", client_->transport, kind), client_->peer + ": " + text);
  unsubscribe();
  boards_.leave();
  reply(0, code, std::move(text));
  failed_ = true;
  end_after(kFarewellTime, {});
}

void NativeSession::end_after(std::chrono::milliseconds time, std::string_view kind) {
  deadline_.expires_after(time);
  deadline_.async_wait([self = shared_from_this(), kind = std::string(kind)](error_code error) {
    const bool still_meant = self->failed_ || self->waiting_for_replies_;
    if (error || self->closed_ || !still_meant) return;
    if (!kind.empty()) {
      self->context_.errors.add(fmt::format("{} {}", self->client_->transport, kind),
                                self->client_->peer + ": closed");
    }
    self->close();
  });
}

}  // namespace skerry::server
