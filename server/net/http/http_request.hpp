// What a request's header says, before it is known what is asked for.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/net/common/asio.hpp"
#include "server/net/common/net_config.hpp"
#include "server/net/http/web_answer.hpp"

namespace skerry::server {

using HttpRequest = http::request<http::string_body>;

std::optional<std::string_view> header_of(const HttpRequest& request, http::field field);

// All of them as one, as they may be read.  Source: RFC 9110, 5.3.
std::string headers_of(const HttpRequest& request, http::field field);

// The token that the request carries: as bearer, or where it has no Authorization header, in the
// cookie of a page of this server (carried_token.hpp).  A view of the request; empty: none.
std::string_view token_of(const HttpRequest& request);

// GET and HEAD change nothing.
bool only_reads(const HttpRequest& request);

// Why a browser's request is not served, if so: a Host that is not this server's (DNS rebinding),
// or a page of another origin that would change something (cross-site request).  Who has the cookie
// must show that the page is this server's, by Origin or Sec-Fetch-Site.  A page of a sister,
// another host of the fleet, may open a WebSocket, without a cookie: who it is it says there.
std::optional<WebAnswer> refusal_of(const HttpRequest& request, const NetConfig& config,
                                    const std::vector<std::string>& sisters);

// What is said in the clear to a request that is to come by TLS: go on to https, or, if it was more
// than to look, that it was not heeded.  Requires one that refusal_of() lets pass.
WebAnswer to_secure(const HttpRequest& request);

}  // namespace skerry::server
