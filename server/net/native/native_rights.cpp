// Who a client of the native protocol is, and what it may ask for and still have.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/digest/digest.hpp"
#include "server/net/native/native_session.hpp"

namespace skerry::server {

namespace {

// What a message asks for, without its token.  A long one is cut, with the digest of the whole.
std::string told(const wire::ClientMessage& message) {
  constexpr std::size_t kLongest = 300;
  wire::ClientMessage shown = message;
  shown.clear_request();
  shown.DiscardUnknownFields();
  const auto* kind = wire::ClientMessage::descriptor()->FindFieldByNumber(message.kind_case());
  auto* asked = shown.GetReflection()->MutableMessage(&shown, kind);
  if (const auto* token = kind->message_type()->FindFieldByName("token")) {
    asked->GetReflection()->ClearField(asked, token);
  }
  std::string text = shown.ShortDebugString();
  if (text.size() <= kLongest) return text;
  Sha256 digest;
  digest.add(text);
  return fmt::format("{}... ({} characters, SHA-256 {})", text.substr(0, kLongest), text.size(),
                     hexadecimal(digest.take()));
}

// What a Set changes and what becomes of an order to a plotter are told elsewhere (ControlDesk,
// NetContext).
bool is_audited(const wire::ClientMessage& message, const Asked& asked) {
  return message.has_record() || message.has_playback() ||
         std::find(asked.rights.begin(), asked.rights.end(), "board_access.write") !=
             asked.rights.end();
}

// "trainee bridge-1, of the ship Frida"
std::string text_for_client(const Who& who) {
  const std::string ship = who.ship.empty() ? "" : ", of the ship " + who.ship;
  return fmt::format("{} {}{}{}", name_of(*who.role), who.name,
                     who.by_certificate ? ", by its certificate" : "", ship);
}

}  // namespace

bool NativeSession::may(const wire::ClientMessage& message) {
  if (asked_.token.empty() && !message.has_sign_in()) asked_.token = token_;
  const Who who = context_.who(slot_->peer(), asked_.token);
  auto refused = why_not_allowed(who, asked_);
  if (!refused) {
    who_ = text_of(who);
    audited_ = is_audited(message, asked_) ? told(message) : std::string();
    return true;
  }
  context_.refuse(origin(), text_of(who), *refused);
  reply(message.request(), wire::Reply::REFUSED, *std::move(refused));
  return false;
}

std::optional<std::string> NativeSession::why_not_allowed(const Who& who,
                                                          const Asked& asked) const {
  for (const std::string& right : asked.rights) {
    if (auto refused = why_not(who, right, context_.ship_of(asked.radar))) return refused;
  }
  return std::nullopt;
}

void NativeSession::sign_in(std::uint32_t request, const wire::SignIn& wanted) {
  if (!wanted.class_code().empty() || !wanted.password().empty()) {
    return sign_in_by(
        request,
        {.name = wanted.name(), .password = wanted.password(), .class_code = wanted.class_code()});
  }
  const Who who = context_.who(slot_->peer(), wanted.token());
  if (!wanted.token().empty() && (!who.role || !who.more.empty())) {
    context_.refuse(origin(), {}, "sign in: " + who.more);
    return reply(request, wire::Reply::REFUSED, "sign in: " + who.more);
  }
  if (!wanted.name().empty() && wanted.token().empty()) {
    return reply(request, wire::Reply::OUT_OF_RANGE,
                 "sign in: a name alone; expected a token, or a password or class code with it");
  }
  if (wanted.token().empty() && !token_.empty()) {
    const Who before = context_.who(slot_->peer(), token_);
    context_.audit({.kind = AuditEntry::Kind::sign_in,
                    .from = origin(),
                    .who = text_of(before),
                    .what = "sign out"});
  }
  become(wanted.token());
  if (!token_.empty()) tell_sign_in();
  reply(request, wire::Reply::OK,
        who.role ? text_for_client(who) : "nobody in particular; " + who.more);
}

void NativeSession::sign_in_by(std::uint32_t request, Credentials credentials) {
  answer_pending_ = true;
  server::sign_in(context_, slot_->peer(), origin(), std::move(credentials),
                  [self = shared_from_this(), request](SignInOutcome outcome) {
                    self->signed_in(request, std::move(outcome));
                  });
}

void NativeSession::signed_in(std::uint32_t request, SignInOutcome outcome) {
  answer_pending_ = false;
  if (closed_) {
    if (outcome.made) context_.gate.sign_out(outcome.made->token);
    return;
  }
  if (outcome.made) {
    slot_->trust();
    become(outcome.made->token);
    has_made_token_ = true;
    reply(request, wire::Reply::OK, text_for_client(outcome.made->who));
  } else if (slot_->place() == Place::on_trial) {
    fail(wire::Reply::REFUSED, "refused", "sign in: " + outcome.text);
  } else {
    reply(request, wire::Reply::REFUSED, "sign in: " + outcome.text);
  }
  // Posted: the outcome may have come at once, while requests are being handled.
  asio::post(context_.io, [self = shared_from_this()] {
    if (!self->closed_) self->process();
  });
}

void NativeSession::become(std::string token) {
  // What was asked for by the one before holds only as far as the new one may have it, too.
  for (auto* holds : {&subscribed_, &streamed_}) {
    if (*holds && (*holds)->token == token_) (*holds)->token = token;
  }
  if (std::exchange(has_made_token_, false)) context_.gate.sign_out(token_);
  token_ = std::move(token);
  looked_at_ = 0;
}

void NativeSession::tell_sign_in() const {
  const Who who = context_.who(slot_->peer(), token_);
  context_.audit({.kind = AuditEntry::Kind::sign_in, .from = origin(), .who = text_of(who)});
}

void NativeSession::audit(const wire::Reply& answer) {
  if (audited_.empty()) return;
  context_.audit({.kind = AuditEntry::Kind::request,
                  .from = origin(),
                  .who = who_,
                  .what = std::exchange(audited_, {}),
                  .result = answer.code() == wire::Reply::OK ? "ok" : answer.text()});
}

void NativeSession::look_at_rights() {
  if (std::exchange(looked_at_, context_.gate.generation()) == context_.gate.generation()) return;
  std::optional<std::string> refused;
  for (const auto* holds : {&subscribed_, &streamed_}) {
    if (refused || !*holds) continue;
    const Asked& asked = **holds;
    refused = why_not_allowed(context_.who(slot_->peer(), asked.token), asked);
  }
  if (!refused) return;
  // Posted, because the feed may be going through its readers, and fail() takes this one off them.
  asio::post(context_.io, [weak = weak_from_this(), text = *std::move(refused)] {
    const auto self = weak.lock();
    if (self == nullptr || self->failed_ || self->closed_) return;
    self->fail(wire::Reply::REFUSED, "no longer allowed", text);
    self->pump();
  });
}

}  // namespace skerry::server
