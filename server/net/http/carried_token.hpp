// How browsers carry a token: in a cookie, or as a subprotocol of a WebSocket.  Never in an
// address, which is kept in histories and logs.
#pragma once

#include <string>
#include <string_view>

namespace skerry::server {

// Its prefix makes browsers take it from encrypted connections, or their own host, alone, for the
// whole of this host and no other.  Source: RFC 6265bis, 4.1.3.2.
inline constexpr std::string_view kTokenCookie = "__Host-skerry";

// The token in a Cookie header; empty: none, or several cookies of that name, of which one may be
// somebody else's.  A view of `header`.
std::string_view cookie_token(std::string_view header);

// Values of Set-Cookie: scripts cannot read it, pages of other sites do not send it, and it ends
// with the browser.  Requires a token as make_token() makes them.
std::string cookie_with(std::string_view token);
std::string cookie_without_token();

// What a client offers in Sec-WebSocket-Protocol: "skerry", which the server answers, and beside it
// "skerry.token.TOKEN", which it does not.
struct OfferedSubprotocols {
  bool skerry = false;
  std::string token = {};  // empty: none
};
inline constexpr std::string_view kSubprotocol = "skerry";
// Of several tokens the first.
OfferedSubprotocols offered_subprotocols(std::string_view header);

}  // namespace skerry::server
