#include "server/net/http/login_routes.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "protocol/picture/label_text.hpp"
#include "protocol/signalk/documents.hpp"
#include "protocol/signalk/json.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/common/signing_in.hpp"
#include "server/net/http/carried_token.hpp"
#include "server/net/http/login_body.hpp"

namespace skerry::server {
namespace {

using signalk::Json;

constexpr std::string_view kLogin = "/login", kSignalk = "/signalk/",
                           kSignalkLogin = "/signalk/v1/auth/login",
                           kSignalkLogout = "/signalk/v1/auth/logout";

WebAnswer document_of(const Json& json, unsigned status = 200) {
  return {.status = status, .mime = "application/json", .body = signalk::text_of(json)};
}

WebAnswer login_error(bool is_signalk, unsigned status, std::string_view text) {
  if (is_signalk) {
    return document_of(signalk::reply_document(status, text), status);
  }
  return web_error(status, fmt::format("{}: {}", status, text));
}

void describe(Json& json, const Who& who, std::optional<UtcTime> ends) {
  if (who.role) json["role"] = name_of(*who.role);
  if (!who.name.empty()) json["name"] = who.name;
  if (!who.ship.empty()) json["ship"] = who.ship;
  if (ends) json["ends"] = utc_text(*ends);
}

WebAnswer tell(const NetContext& context, const TcpPeer& peer, const LoginRequest& request) {
  const UtcTime now = utc_now();
  Json json{{"users", context.gate.has_users()},
            {"class", context.gate.class_codes().takes_in(now)}};
  const bool is_known = context.knows(peer, request.token);
  if (is_known) {
    describe(json, context.who(peer, request.token),
             context.gate.end_of({.token = request.token, .certificate = peer.certificate}, now));
  }
  WebAnswer answer = document_of(json);
  // A browser that keeps the cookie of a session that has ended is nobody again.
  if (!is_known && request.by_cookie && !request.token.empty()) {
    answer.set_cookie = cookie_without_token();
  }
  return answer;
}

WebAnswer sign_out(NetContext& context, const TcpPeer& peer, const LoginRequest& request,
                   bool is_signalk) {
  const std::string who = text_of(context.who(peer, request.token));
  if (!context.gate.sign_out(request.token)) {
    // A token of the file does not end so; Signal K's clients are content with that.
    if (is_signalk) return login_error(true, 200, "OK");
    return login_error(false, 401, "nobody is signed in with this token");
  }
  context.audit({.kind = AuditEntry::Kind::sign_in,
                 .from = "HTTP " + peer.text,
                 .who = who,
                 .what = "sign out"});
  WebAnswer answer = is_signalk ? login_error(true, 200, "OK") : document_of(Json::object());
  if (request.by_cookie) answer.set_cookie = cookie_without_token();
  return answer;
}

WebAnswer welcome_document(const Gate::SignedIn& made, bool is_signalk, bool by_cookie) {
  if (is_signalk) {
    return document_of(
        Json{{"token", made.token}, {"timeToLive", std::chrono::seconds(Gate::kSignedIn).count()}});
  }
  Json json = Json::object();
  if (!by_cookie) json["token"] = made.token;
  describe(json, made.who, made.ends);
  WebAnswer answer = document_of(json);
  if (by_cookie) answer.set_cookie = cookie_with(made.token);
  return answer;
}

unsigned status_of(SignInOutcome::Kind kind) {
  switch (kind) {
    case SignInOutcome::Kind::signed_in:
      return 200;
    case SignInOutcome::Kind::malformed:
      return 400;
    case SignInOutcome::Kind::wrong:
      return 401;
    case SignInOutcome::Kind::too_often:
      return 429;
    case SignInOutcome::Kind::busy:
      return 503;
    case SignInOutcome::Kind::not_here:
      return 404;
  }
  return 500;
}

void sign_in_over_http(NetContext& context, const TcpPeer& peer, LoginBody body, bool is_signalk,
                       std::function<void()> signed_in, std::function<void(WebAnswer)> answer) {
  if (is_signalk && !context.passwords) {
    return answer(login_error(true, 401, "the password is a token of the server; this is none"));
  }
  const bool by_cookie = body.cookie && (peer.is_secure || peer.on_own_host);
  sign_in(context, peer, "HTTP " + peer.text, std::move(body.credentials),
          [is_signalk, by_cookie, signed_in = std::move(signed_in),
           answer = std::move(answer)](const SignInOutcome& outcome) {
            if (!outcome.made) {
              return answer(login_error(is_signalk, status_of(outcome.kind), outcome.text));
            }
            if (signed_in) signed_in();
            answer(welcome_document(*outcome.made, is_signalk, by_cookie));
          });
}

// Signal K's paths may end in a slash.
std::string_view without_slash(std::string_view path) {
  if (path.starts_with(kSignalk) && path.ends_with('/')) path.remove_suffix(1);
  return path;
}

}  // namespace

bool is_login_path(std::string_view given) {
  const std::string_view path = without_slash(given);
  return path == kLogin || path == kSignalkLogin || path == kSignalkLogout;
}

void answer_login(NetContext& context, const TcpPeer& peer, LoginRequest request,
                  std::function<void(WebAnswer)> answer) {
  request.path = std::string(without_slash(request.path));
  const bool is_signalk = request.path != kLogin;
  const std::string right = is_signalk
                                ? "signalk.discover"
                                : (request.method == "HEAD" ? "GET" : request.method) + " /login";
  const Who who = context.who(peer, request.token);
  if (right_of(right) != nullptr) {
    if (const auto refused = why_not(who, right))
      return answer(login_error(is_signalk, 403, *refused));
  }
  if (!is_signalk && (request.method == "GET" || request.method == "HEAD")) {
    return answer(tell(context, peer, request));
  }
  const bool ends = is_signalk ? request.method == "PUT" && request.path == kSignalkLogout
                               : request.method == "DELETE";
  if (ends) return answer(sign_out(context, peer, request, is_signalk));
  if (request.method != "POST" || request.path == kSignalkLogout) {
    WebAnswer refused =
        login_error(is_signalk, 405,
                    request.path == kSignalkLogout ? "only PUT is served here"
                    : is_signalk                   ? "only POST is served here"
                                 : "only GET, HEAD, POST and DELETE are served here");
    refused.allow = request.path == kSignalkLogout ? "PUT"
                    : is_signalk                   ? "POST"
                                                   : "GET, HEAD, POST, DELETE";
    return answer(std::move(refused));
  }
  auto body = read_login_body(request.body, is_signalk);
  if (!body) {
    return answer(login_error(is_signalk, 400,
                              is_signalk ? "expected {\"username\": ..., \"password\": ...}"
                                         : "expected {\"name\": ..., \"password\": ...} or "
                                           "{\"name\": ..., \"code\": ...}"));
  }
  const std::string& password = body->credentials.password;
  if (is_signalk && context.gate.knows(password, utc_now())) {
    return answer(document_of(Json{{"token", password}}));
  }
  sign_in_over_http(context, peer, std::move(*body), is_signalk, std::move(request.signed_in),
                    std::move(answer));
}

}  // namespace skerry::server
