#include "server/net/http/signalk_route.hpp"

#include <chrono>
#include <utility>

#include "server/net/signalk/signalk_rest.hpp"

namespace skerry::server {

WebAnswer answer_signalk(NetContext& context, SignalkSite& site, const HttpRequest& request,
                         std::string path, const SignalkAsked& by) {
  const NetConfig& config = context.config;
  const TcpPeer& peer = by.peer;
  const Who who = context.who(peer, by.token);
  const auto method = request.method_string();
  const auto right = signalk_right({method.data(), method.size()}, path);
  SignalkRequest asked{
      .method = {method.data(), method.size()},
      .path = std::move(path),
      .body = request.body(),
      .place = {std::string(*header_of(request, http::field::host)), peer.is_secure},
      .address = by.address.empty() ? config.bind : by.address,
      .origin = "Signal K display " + peer.text,
      .refusal = why_not(who, right, context.ship_of(site.radars().front().number)),
      .has_token = context.knows(peer, by.token),
      .is_known = who.role.has_value()};
  const bool reads = only_reads(request);
  if (!reads && !context.changes.take(peer, std::chrono::steady_clock::now())) {
    const std::string refusal = context.changes.refusal(peer);
    context.complain("too many changes", peer.text + ": " + refusal);
    return web_error(429, "429: " + refusal);
  }
  if (asked.refusal && !reads) context.refuse(asked.origin, text_of(who), *asked.refusal);
  const AuditedRequest audited(config.audit, asked.origin, text_of(who));
  WebAnswer answer = signalk_answer(site, config.signalk, context.gate, asked);
  if (answer.status >= 400 && !reads) {
    context.errors.add("signalk change refused", peer.text + ": " + answer.body);
  }
  return answer;
}

}  // namespace skerry::server
