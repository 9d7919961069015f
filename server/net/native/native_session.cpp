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
                          ConnectionSlotPtr slot) {
  std::make_shared<NativeSession>(context, std::move(transport), std::move(slot))->start();
}

NativeSession::NativeSession(NetContext& context, std::unique_ptr<ByteTransport> transport,
                             ConnectionSlotPtr slot)
    : context_(context),
      transport_(std::move(transport)),
      slot_(std::move(slot)),
      client_(context.clients.add(transport_->name(), slot_->peer().text)),
      deadline_(context.io),
      boards_(context, *this) {}

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
    const AuditedRequest audited(context_.config.audit, origin(), who_);
    context_.host.leave(origin());
  }
  deadline_.cancel();
  transport_->close();
  spdlog::debug("{} {} closed: {} spokes sent, {} lost", client_->transport, client_->peer,
                client_->spokes_sent.load(), client_->spokes_lost.load());
}

// --- reading
// ---------------------------------------------------------------------------------------

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
    while (!failed_ && !handled_all && !replies_full()) handled_all = !handle_next();
    pump();  // makes room for more replies, unless a write is in flight
  } while (!failed_ && !handled_all && !replies_full());

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
    case wire::ClientMessage::KIND_NOT_SET:
      break;
  }
  fail(wire::Reply::MALFORMED, "malformed request",
       "a ClientMessage without a kind this server knows; expected sign_in, subscribe, set, "
       "get_status, record, playback, get_coastline, get_chart_objects, target_order or one of a "
       "board's");
}

std::optional<std::uint32_t> NativeSession::view_for(std::uint32_t request,
                                                     const wire::Subscribe& subscribe) {
  if (context_.find_feed(subscribe.radar(), subscribe.view(), kNativeFormat) == nullptr) {
    reply(request, wire::Reply::UNKNOWN,
          fmt::format("no radar {} with view {}; Hello lists the radars, view 0 is always there",
                      subscribe.radar(), subscribe.view()));
    return std::nullopt;
  }
  if (!subscribe.new_view()) return subscribe.view();
  auto opened = context_.open_view(subscribe.radar(), subscribe.view(), slot_->peer());
  if (opened) return *opened;
  context_.complain("view refused", client_->peer + ": " + opened.error());
  reply(request, wire::Reply::REFUSED, opened.error());
  return std::nullopt;
}

void NativeSession::subscribe(std::uint32_t request, const wire::Subscribe& subscribe) {
  if (subscribe.own_ship_hz() > kOwnShipMostHz) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 fmt::format("own_ship_hz: {} is out of range; allowed: {} to {}",
                             subscribe.own_ship_hz(), kOwnShipLeastHz, kOwnShipMostHz));
  }
  if (subscribe.exercise_hz() > kExerciseMostHz) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 fmt::format("exercise_hz: {} is out of range; allowed: 0 to {}",
                             subscribe.exercise_hz(), kExerciseMostHz));
  }
  if (subscribe.targets_hz() > kTargetsMostHz) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 fmt::format("targets_hz: {} is out of range; allowed: 0 to {}",
                             subscribe.targets_hz(), kTargetsMostHz));
  }
  const auto view = view_for(request, subscribe);
  if (!view) return;
  unsubscribe();
  subscribed_ = asked_;
  feed_ = context_.find_feed(subscribe.radar(), *view, kNativeFormat);
  takes_spokes_ = !subscribe.no_spokes();
  if (takes_spokes_) {
    cursor_ = feed_->add(*this);
  } else {
    feed_->add_listener(*this);
  }
  own_ship_hz_ = std::max(subscribe.own_ship_hz(), kOwnShipLeastHz);
  exercise_hz_ = subscribe.exercise_hz();
  targets_hz_ = subscribe.targets_hz();
  if (TargetPort* port = context_.host.targets(); port != nullptr && targets_hz_ > 0) {
    wanted_targets_ = port->want(subscribe.radar(), *view);
  }
  client_->radar.store(subscribe.radar(), std::memory_order_relaxed);
  client_->view.store(*view, std::memory_order_relaxed);
  spoke_buffer_ = takes_spokes_ ? context_.send_buffer_for(subscribe.radar()) : 0;
  limit_send_buffer();
  reply(request, wire::Reply::OK, "", *view);
  RecordingNews::Frames recordings = context_.recording_frames();
  RecordingNews::Pair& recording = is_trusted() ? recordings.whole : recordings.for_strangers;
  news_ = {context_.settings_frame(subscribe.radar(), *view),
           context_.own_ship_frame(subscribe.radar()),
           context_.world_frame(),
           std::move(recording.recorder),
           std::move(recording.playback),
           exercise_hz_ > 0 ? context_.exercise_frame() : nullptr,
           targets_hz_ > 0 ? context_.targets_frame(subscribe.radar(), *view) : nullptr};
  spdlog::debug("{} {} subscribed to radar {} view {}", client_->transport, client_->peer,
                subscribe.radar(), *view);
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

// --- writing
// ---------------------------------------------------------------------------------------

void NativeSession::send(const wire::ServerMessage& message) {
  replies_.push_back(make_frame(message));
  reply_bytes_ += replies_.back()->size();
}

void NativeSession::tell(News kind, const SharedBytes& frame) {
  news_[kind] = frame;
  pump();
}

void NativeSession::on_settings(const SharedBytes& frame) { tell(kSettings, frame); }
void NativeSession::on_own_ship(const SharedBytes& frame) {
  look_at_rights();
  tell(kOwnShip, frame);
}
void NativeSession::on_world(const SharedBytes& frame) { tell(kWorld, frame); }
void NativeSession::on_exercise(const SharedBytes& frame) { tell(kExercise, frame); }
void NativeSession::on_targets(const SharedBytes& frame) { tell(kTargets, frame); }
void NativeSession::on_recorder(const SharedBytes& frame) { tell(kRecorder, frame); }
void NativeSession::on_playback(const SharedBytes& frame) { tell(kPlayback, frame); }

void NativeSession::pump() {
  if (writing_ || closed_) return;
  while (!replies_.empty()) {
    add_to_batch(std::move(replies_.front()));
    replies_.pop_front();
  }
  reply_bytes_ = 0;
  for (SharedBytes& frame : news_) {
    if (frame != nullptr) add_to_batch(std::exchange(frame, nullptr));
  }
  add_sectors_to_batch();
  if (batch_.empty()) {
    if (failed_ && !finished_) {
      finished_ = true;
      transport_->finish();
    }
    return;
  }
  writing_ = true;
  write_began_ = std::chrono::steady_clock::now();
  transport_->write(batch_, [self = shared_from_this()](error_code error, std::size_t size) {
    self->writing_ = false;
    self->on_written(error, size);
  });
}

void NativeSession::add_to_batch(SharedBytes frame) {
  batch_.emplace_back(frame->data(), frame->size());
  batch_bytes_ += frame->size();
  batch_owners_.push_back(std::move(frame));
}

void NativeSession::add_sectors_to_batch() {
  while (feed_ != nullptr && takes_spokes_ && batch_bytes_ < kBatchBytes) {
    EncodedSectorPtr sector = feed_->ring().take(cursor_);
    if (sector == nullptr) break;
    add_to_batch(std::move(sector));
  }
  while (batch_bytes_ < kBatchBytes) {
    EncodedSectorPtr block = boards_.take();
    if (block == nullptr) break;
    add_to_batch(std::move(block));
  }
  client_->spokes_lost.store(lost_before_ + cursor_.spokes_lost + boards_.lost(),
                             std::memory_order_relaxed);
}

void NativeSession::add_to_batch(EncodedSectorPtr sector) {
  batch_.emplace_back(sector->bytes.data(), sector->bytes.size());
  batch_bytes_ += sector->bytes.size();
  batch_spokes_ += sector->spoke_count();
  batch_owners_.push_back(std::move(sector));
}

void NativeSession::on_written(error_code error, std::size_t size) {
  client_->bytes_sent.fetch_add(size, std::memory_order_relaxed);
  if (!error) client_->spokes_sent.fetch_add(batch_spokes_, std::memory_order_relaxed);
  batch_.clear();
  batch_owners_.clear();
  batch_bytes_ = 0;
  batch_spokes_ = 0;
  if (closed_) return;
  if (error) return close();
  if (waiting_for_replies_) return process();
  pump();
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
