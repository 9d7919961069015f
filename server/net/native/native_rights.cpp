// Who a client of the native protocol is, and what it may ask for and still have.
#include <fmt/format.h>

#include <utility>

#include "server/net/common/net_clock.hpp"
#include "server/net/native/native_session.hpp"

namespace skerry::server {

bool NativeSession::may(const wire::ClientMessage& message) {
  if (asked_.token.empty()) asked_.token = token_;
  auto refused = why_not_allowed(asked_);
  if (!refused) return true;
  context_.errors.add("refused", client_->peer + ": " + *refused);
  reply(message.request(), wire::Reply::REFUSED, *std::move(refused));
  return false;
}

std::optional<std::string> NativeSession::why_not_allowed(const Asked& asked) const {
  const Who who = context_.gate.who(slot_->peer().on_own_host, asked.token, utc_now());
  for (const std::string& right : asked.rights) {
    if (auto refused = why_not(who, right, context_.ship_of(asked.radar))) return refused;
  }
  return std::nullopt;
}

void NativeSession::sign_in(std::uint32_t request, const wire::SignIn& wanted) {
  const Who who = context_.gate.who(slot_->peer().on_own_host, wanted.token(), utc_now());
  if (!who.role || (!wanted.token().empty() && !who.more.empty())) {
    context_.errors.add("refused", client_->peer + ": sign in: " + who.more);
    return reply(request, wire::Reply::REFUSED, "sign in: " + who.more);
  }
  token_ = wanted.token();
  const std::string ship = who.ship.empty() ? "" : ", of the ship " + who.ship;
  reply(request, wire::Reply::OK, fmt::format("{} {}{}", name_of(*who.role), who.name, ship));
}

void NativeSession::look_at_rights() {
  if (std::exchange(looked_at_, context_.gate.generation()) == context_.gate.generation()) return;
  auto refused = subscribed_ ? why_not_allowed(*subscribed_) : std::nullopt;
  if (!refused && streamed_) refused = why_not_allowed(*streamed_);
  if (!refused) return;
  // Not at once: the feed goes through its readers now, and this session leaves them.
  asio::post(context_.io, [weak = weak_from_this(), text = *std::move(refused)] {
    const auto self = weak.lock();
    if (self == nullptr || self->failed_ || self->closed_) return;
    self->fail(wire::Reply::REFUSED, "no longer allowed", text);
    self->pump();
  });
}

}  // namespace skerry::server
