// Signing in by password or class code: /login, and Signal K's /signalk/v1/auth/login.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "server/net/common/net_context.hpp"
#include "server/net/http/web_answer.hpp"

namespace skerry::server {

struct LoginRequest {
  std::string method;
  std::string path;
  std::string body;
  std::string token;                     // that it carries (http_request.hpp); empty: none
  bool by_cookie = false;                // in the cookie
  std::function<void()> signed_in = {};  // called before the answer, if so
};

bool is_login_path(std::string_view path);

// GET tells who bears the token, or came with the certificate: {"users", "class", "role", "name",
// "ship", "ends"}; without a good one {"users", "class"} alone: whether there are users, and a
// class code that takes somebody in. POST of {"name", "password"} or {"name", "code"} signs in:
// {"token", "role", "name", "ship", "ends"}; with "cookie": true over an encrypted connection, or
// on the server's own host, the token is in a cookie instead (carried_token.hpp).  DELETE ends the
// token that it bears.  Signal K: POST of {"username", "password"} gives {"token", "timeToLive"} in
// seconds; a password that is itself a token is given back, for clients that know no other way to
// have one.
//
// `answer` is called once, at once or when the password was tried: 400 no such document, 401 no
// such user or password, code or token, 404 no users here, 405, 429 too many sign-ins of this
// peer, 503 too many wait.  An answer to a wrong name takes as long as one to a wrong password.
// Thread: net-0.
void answer_login(NetContext& context, const TcpPeer& peer, LoginRequest request,
                  std::function<void(WebAnswer)> answer);

}  // namespace skerry::server
