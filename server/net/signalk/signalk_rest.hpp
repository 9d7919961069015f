// Requests of Signal K clients: what path is what, and what it answers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/access/gate.hpp"
#include "server/net/http/web_answer.hpp"
#include "server/net/signalk/signalk_site.hpp"

namespace skerry::server {

struct SignalkRequest {
  std::string_view method;  // "GET"
  std::string path;         // clean, without query
  std::string_view body = {};
  signalk::HttpPlace place;  // of this server, as the client has it
  std::string address = {};  // of the server's end of the connection
  std::string origin = {};   // who asks, for the log
  // Why what is asked for is refused, if it is (signalk_right()).
  std::optional<std::string> refusal = {};
  bool has_token = false;  // one was given, and it is good
  bool is_known = true;    // the server knows who asks: a refusal is of the right, not of the token
};

// The right that a request needs: "signalk.discover", "signalk.read" or "signalk.change".
std::string_view signalk_right(std::string_view method, std::string_view path);

// Whether the path is one of Signal K's, whatever becomes of it.
bool is_signalk_path(std::string_view path);

// Every answer is JSON; those to changes have the members state, statusCode and message.
// A log-in's password is a token that `gate` knows.
WebAnswer signalk_answer(SignalkSite& site, const SignalkConfig& config, const Gate& gate,
                         const SignalkRequest& request);

// The kind of WebSocket at a path: spokes of a radar, the delta stream, or not Signal K's.
struct SignalkStream {
  SignalkSite::Mounted* spokes = nullptr;  // nullptr: deltas
};
std::optional<SignalkStream> signalk_stream(SignalkSite& site, std::string_view path);

// The token of an Authorization header, "Bearer TOKEN" or "JWT TOKEN"; empty if there is none.
std::string_view token_of(std::string_view authorization);

}  // namespace skerry::server
