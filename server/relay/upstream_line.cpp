#include "server/relay/upstream_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "protocol/thin/thin_decoder.hpp"
#include "protocol/wire/printable_text.hpp"
#include "server/relayed/relayed_host.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kSlowLinkLevel = 3;

}  // namespace

LineEnd UpstreamLine::malformed(const std::string& what) const {
  return {LineEnd::Kind::malformed,
          fmt::format("{} sent what is not the native protocol: {}", name_, printable(what))};
}

std::string UpstreamLine::does_not_read() const {
  return fmt::format("{} does not read what it is asked", name_);
}

std::optional<LineEnd> UpstreamLine::take(std::span<const std::uint8_t> bytes, SteadyTime now) {
  heard_ = now;
  bytes_ += bytes.size();
  frames_.feed(bytes);
  for (;;) {
    const auto body = frames_.next();
    if (!body) {
      return malformed(fmt::format("{} at byte {} ({})", name_of(body.error().kind),
                                   body.error().offset, body.error().text));
    }
    if (!*body) return std::nullopt;
    if (auto end = take_body(**body, now)) return end;
  }
}

std::optional<LineEnd> UpstreamLine::take_body(std::span<const std::uint8_t> body,
                                               SteadyTime /*now*/) {
  if (!message_.ParseFromArray(body.data(), static_cast<int>(body.size()))) {
    return malformed(fmt::format("a frame of {} bytes that is no ServerMessage", body.size()));
  }
  if (state_ == State::greeted_by_none) {
    if (message_.has_hello()) return take_hello();
    if (message_.has_reply()) {
      return LineEnd{LineEnd::Kind::refused, fmt::format("{} refused the connection: {}", name_,
                                                         printable(message_.reply().text()))};
    }
    return malformed("it did not begin with a Hello");
  }
  switch (message_.kind_case()) {
    case wire::ServerMessage::kReply:
      return take_reply();
    case wire::ServerMessage::kSpoke:
      return take_spoke(body);
    case wire::ServerMessage::kThinSpokes:
      return take_thin_spokes();
    case wire::ServerMessage::kSettings:
    case wire::ServerMessage::kOwnShip:
    case wire::ServerMessage::kWorld:
    case wire::ServerMessage::kPlayback:
    case wire::ServerMessage::kExercise:
      if (state_ == State::subscribed) user_.on_news(message_);
      return std::nullopt;
    case wire::ServerMessage::kCoastline:
    case wire::ServerMessage::kChartObjects:
    case wire::ServerMessage::kHops:
      told_ = std::move(message_);
      message_.Clear();
      return std::nullopt;
    default:
      return std::nullopt;  // nothing that was asked for
  }
}

std::optional<LineEnd> UpstreamLine::take_hello() {
  if (message_.hello().protocol_version() != 1) {
    return LineEnd{LineEnd::Kind::refused,
                   fmt::format("{} speaks version {} of the native protocol, expected 1", name_,
                               message_.hello().protocol_version())};
  }
  if (auto unwanted = user_.on_hello(message_.hello(), wish_)) return unwanted;
  if (token_.empty()) {
    subscribe();
    return std::nullopt;
  }
  state_ = State::signing_in;
  wire::ClientMessage message;
  message.mutable_sign_in()->set_token(token_);
  send(message);
  return std::nullopt;
}

wire::ClientMessage UpstreamLine::subscription() const {
  wire::ClientMessage message;
  wire::Subscribe& subscribe = *message.mutable_subscribe();
  subscribe.set_radar(wish_.radar);
  subscribe.set_view(wish_.view);
  subscribe.set_new_view(wish_.new_view);
  // Ten times a second it would be a tenth of what a link has that needs these.
  const bool is_slow = wish_.thin >= kSlowLinkLevel;
  subscribe.set_own_ship_hz(is_slow ? std::min(wish_.own_ship_hz, 2u) : wish_.own_ship_hz);
  subscribe.set_no_spokes(!wish_.spokes);
  subscribe.set_exercise_hz(wish_.exercise_hz);
  subscribe.set_thin(wish_.thin);
  return message;
}

void UpstreamLine::subscribe() {
  state_ = State::subscribing;
  wire::ClientMessage message = subscription();
  send(message);
}

void UpstreamLine::change_thin(std::uint32_t thin, SteadyTime now, std::chrono::seconds patience,
                               AnsweredUp answered) {
  wish_.thin = thin;
  wish_.new_view = false;  // it is there
  ask(subscription(), now, patience,
      [this, answered = std::move(answered)](const wire::Reply& reply, wire::ServerMessage* told) {
        flush();
        losses_ = LossCounter();
        answered(reply, told);
      });
}

std::optional<LineEnd> UpstreamLine::take_reply() {
  const wire::Reply& reply = message_.reply();
  const bool is_ok = reply.code() == wire::Reply::OK;
  if (reply.request() == 0) {
    return LineEnd{LineEnd::Kind::refused,
                   fmt::format("{} ended the connection: {}", name_, printable(reply.text()))};
  }
  if (state_ != State::subscribed) {
    if (reply.request() != request_) return std::nullopt;
    if (!is_ok) {
      const bool gone = state_ == State::subscribing && reply.code() == wire::Reply::UNKNOWN;
      return LineEnd{gone ? LineEnd::Kind::no_view : LineEnd::Kind::refused,
                     fmt::format("{} refused: {}", name_, printable(reply.text()))};
    }
    if (state_ == State::signing_in) {
      subscribe();
      return std::nullopt;
    }
    // A server without views skips new_view and has the shared one.
    wish_.view = wish_.new_view ? reply.view() : wish_.view;
    state_ = State::subscribed;
    const std::uint32_t here = user_.on_subscribed(wish_.view);
    batch_.emplace(wish_.radar, wish_.view, here);
    return std::nullopt;
  }
  const auto asked = asked_.find(reply.request());
  auto told = std::exchange(told_, std::nullopt);
  if (asked == asked_.end()) {
    if (const auto late = late_.extract(reply.request())) late.mapped()(reply, nullptr);
    return std::nullopt;
  }
  const AnsweredUp answered = std::move(asked->second.answered);
  asked_.erase(asked);
  answered(reply, told ? &*told : nullptr);
  return std::nullopt;
}

std::optional<LineEnd> UpstreamLine::take_spoke(std::span<const std::uint8_t> body) {
  if (!batch_ || !wish_.spokes) return malformed("a spoke that nobody has subscribed to");
  const wire::Spoke& spoke = message_.spoke();
  if (!batch_->follows(spoke.sequence(), spoke.scan()) || batch_->is_full()) flush();
  if (const auto wrong = batch_->add(spoke, body)) return malformed(*wrong);
  losses_.take(spoke.sequence());
  return std::nullopt;
}

std::optional<LineEnd> UpstreamLine::take_thin_spokes() {
  if (!batch_ || !wish_.spokes) return malformed("thin spokes that nobody has subscribed to");
  auto spokes = from_message(message_.thin_spokes());
  if (!spokes) return malformed(spokes.error().text);
  for (Spoke& spoke : spokes.value()) {
    const std::uint64_t sequence = spoke.header.sequence;
    if (!batch_->follows(sequence, spoke.header.scan) || batch_->is_full()) flush();
    if (const auto wrong = batch_->add(std::move(spoke))) return malformed(*wrong);
    losses_.take(sequence);
  }
  return std::nullopt;
}

void UpstreamLine::flush() {
  if (batch_ && !batch_->is_empty()) user_.on_spokes(batch_->take());
}

void UpstreamLine::send(wire::ClientMessage& message) {
  message.set_request(++request_);
  append_frame(output_, message);
}

void UpstreamLine::ask(wire::ClientMessage message, SteadyTime now, std::chrono::seconds patience,
                       AnsweredUp answered, AnsweredUp late) {
  if (message.ByteSizeLong() + 8 > kMaxClientFrame) {
    answered(reply_of(wire::Reply::REFUSED, fmt::format("too long to be passed on to {}", name_)),
             nullptr);
    return;
  }
  // What is there already waits until the server reads or the line ends.
  is_full_ = is_full_ || output_.size() + message.ByteSizeLong() > kMostOutput;
  if (is_full_) {
    return answered(reply_of(wire::Reply::REFUSED, does_not_read() + "; try again in a moment"),
                    nullptr);
  }
  send(message);
  asked_[request_] = {std::move(answered), now + patience, std::move(late)};
}

std::optional<LineEnd> UpstreamLine::tick(SteadyTime now) {
  std::vector<AnsweredUp> late;
  for (auto asked = asked_.begin(); asked != asked_.end();) {
    if (now < asked->second.until) {
      ++asked;
      continue;
    }
    late.push_back(std::move(asked->second.answered));
    if (asked->second.late) late_.emplace(asked->first, std::move(asked->second.late));
    if (late_.size() > kMostLate) late_.erase(late_.begin());
    asked = asked_.erase(asked);
  }
  for (const AnsweredUp& answered : late) {
    answered(reply_of(wire::Reply::REFUSED,
                      fmt::format("{} has not answered in time; whether it was done is not known",
                                  name_)),
             nullptr);
  }
  if (is_full_) return LineEnd{LineEnd::Kind::lost, does_not_read()};
  if (!heard_) heard_ = now;
  if (now - *heard_ <= kSilence) return std::nullopt;
  return LineEnd{LineEnd::Kind::lost,
                 fmt::format("nothing has come from {} for {} s", name_, kSilence.count())};
}

void UpstreamLine::end(const std::string& why) {
  const auto asked = std::exchange(asked_, {});
  for (const auto& [request, each] : asked) {
    each.answered(reply_of(wire::Reply::REFUSED, why + "; whether it was done is not known"),
                  nullptr);
  }
}

}  // namespace skerry::server
