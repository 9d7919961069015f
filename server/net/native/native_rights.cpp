// Who a client of the native protocol is, and what it may ask for and still have.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/digest/digest.hpp"
#include "server/net/common/net_clock.hpp"
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

}  // namespace

bool NativeSession::may(const wire::ClientMessage& message) {
  if (asked_.token.empty()) asked_.token = token_;
  const Who who = context_.gate.who(slot_->peer().on_own_host, asked_.token, utc_now());
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
  const Who who = context_.gate.who(slot_->peer().on_own_host, wanted.token(), utc_now());
  if (!who.role || (!wanted.token().empty() && !who.more.empty())) {
    context_.refuse(origin(), {}, "sign in: " + who.more);
    return reply(request, wire::Reply::REFUSED, "sign in: " + who.more);
  }
  token_ = wanted.token();
  context_.audit({.kind = AuditEntry::Kind::sign_in, .from = origin(), .who = text_of(who)});
  const std::string ship = who.ship.empty() ? "" : ", of the ship " + who.ship;
  reply(request, wire::Reply::OK, fmt::format("{} {}{}", name_of(*who.role), who.name, ship));
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
    refused = why_not_allowed(context_.gate.who(slot_->peer().on_own_host, asked.token, utc_now()),
                              asked);
  }
  if (!refused) return;
  // Posted: the feed may be going through its readers, of which this session is one no more then.
  asio::post(context_.io, [weak = weak_from_this(), text = *std::move(refused)] {
    const auto self = weak.lock();
    if (self == nullptr || self->failed_ || self->closed_) return;
    self->fail(wire::Reply::REFUSED, "no longer allowed", text);
    self->pump();
  });
}

}  // namespace skerry::server
