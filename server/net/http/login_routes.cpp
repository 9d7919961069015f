#include "server/net/http/login_routes.hpp"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "protocol/picture/label_text.hpp"
#include "protocol/signalk/documents.hpp"
#include "protocol/signalk/json.hpp"

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

WebAnswer tell(const NetContext& context, const TcpPeer& peer, const std::string& token) {
  const UtcTime now = utc_now();
  Json json{{"users", context.gate.has_users()}};
  if (context.gate.knows(token, now)) {
    describe(json, context.gate.who(peer.on_own_host, token, now), context.gate.end_of(token, now));
  }
  return document_of(json);
}

WebAnswer sign_out(NetContext& context, const TcpPeer& peer, const std::string& token,
                   bool is_signalk) {
  const std::string who = text_of(context.gate.who(peer.on_own_host, token, utc_now()));
  if (!context.gate.sign_out(token)) {
    // A token of the file does not end so; Signal K's clients are content with that.
    if (is_signalk) return login_error(true, 200, "OK");
    return login_error(false, 401, "nobody is signed in with this token");
  }
  context.audit({.kind = AuditEntry::Kind::sign_in,
                 .from = "HTTP " + peer.text,
                 .who = who,
                 .what = "sign out"});
  return is_signalk ? login_error(true, 200, "OK") : document_of(Json::object());
}

// What is asked for when a password comes.
struct Wanted {
  std::string name = {}, password = {};
  bool is_signalk = false;
};

std::optional<Wanted> wanted_by(const LoginRequest& request) {
  const auto body = signalk::read_json(request.body);
  if (!body) return std::nullopt;
  Wanted wanted{.is_signalk = request.path == kSignalkLogin};
  wanted.name = signalk::text_member(*body, wanted.is_signalk ? "username" : "name");
  wanted.password = signalk::text_member(*body, "password");
  if (wanted.password.empty()) return std::nullopt;
  return wanted;
}

WebAnswer welcome(const Gate::SignedIn& made, bool is_signalk) {
  Json json{{"token", made.token}};
  if (is_signalk) {
    json["timeToLive"] = std::chrono::seconds(Gate::kSignedIn).count();
  } else {
    describe(json, made.who, made.ends);
  }
  return document_of(json);
}

void sign_in(NetContext& context, const TcpPeer& peer, Wanted wanted,
             std::function<void()> signed_in, std::function<void(WebAnswer)> answer) {
  const std::string from = "HTTP " + peer.text;
  const bool is_signalk = wanted.is_signalk;
  if (!context.passwords) {
    return answer(
        is_signalk
            ? login_error(true, 401, "the password is a token of the server; this is none")
            : login_error(false, 404, "this server has no users; with --users FILE it does"));
  }
  const auto too_many = [&](unsigned status, const std::string& why) {
    context.complain("too many sign-ins", peer.text + ": " + why);
    answer(login_error(is_signalk, status, why));
  };
  // Who finds no place has not tried, and may as often as before.
  if (!context.passwords->has_place()) {
    return too_many(503, "too many sign in just now; try again in a second");
  }
  if (!context.sign_ins.take(peer, std::chrono::steady_clock::now())) {
    return too_many(429, context.sign_ins.refusal(peer));
  }
  const std::string hash = context.gate.hash_of(wanted.name);
  context.passwords->try_password(
      hash, std::move(wanted.password),
      [&context, from, hash, is_signalk, name = std::move(wanted.name),
       signed_in = std::move(signed_in), answer = std::move(answer)](bool is_right) {
        const auto made = is_right ? context.gate.sign_in(name, hash, utc_now()) : std::nullopt;
        if (!made) {
          constexpr const char* kWrong = "no user has this name and password";
          // A name that nobody has may be a password, typed into the wrong field.
          const std::string as = context.gate.has_user(name) ? " as " + name : "";
          context.refuse(from, {}, fmt::format("sign in{}: {}", as, kWrong));
          return answer(login_error(is_signalk, 401, kWrong));
        }
        context.audit({.kind = AuditEntry::Kind::sign_in,
                       .from = from,
                       .who = text_of(made->who),
                       .what = "by password"});
        if (signed_in) signed_in();
        answer(welcome(*made, is_signalk));
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
  const Who who = context.gate.who(peer.on_own_host, request.token, utc_now());
  if (right_of(right) != nullptr) {
    if (const auto refused = why_not(who, right))
      return answer(login_error(is_signalk, 403, *refused));
  }
  if (!is_signalk && (request.method == "GET" || request.method == "HEAD")) {
    return answer(tell(context, peer, request.token));
  }
  const bool ends = is_signalk ? request.method == "PUT" && request.path == kSignalkLogout
                               : request.method == "DELETE";
  if (ends) return answer(sign_out(context, peer, request.token, is_signalk));
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
  auto wanted = wanted_by(request);
  if (!wanted) {
    return answer(login_error(is_signalk, 400,
                              is_signalk ? "expected {\"username\": ..., \"password\": ...}"
                                         : "expected {\"name\": ..., \"password\": ...}"));
  }
  if (is_signalk && context.gate.knows(wanted->password, utc_now())) {
    return answer(document_of(Json{{"token", wanted->password}}));
  }
  sign_in(context, peer, std::move(*wanted), std::move(request.signed_in), std::move(answer));
}

}  // namespace skerry::server
