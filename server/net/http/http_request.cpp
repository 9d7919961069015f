#include "server/net/http/http_request.hpp"

#include <algorithm>

#include "server/net/common/access_policy.hpp"
#include "server/net/http/carried_token.hpp"
#include "server/net/signalk/signalk_rest.hpp"

namespace skerry::server {
namespace {

// What a browser says of the page that asks: "same-origin", "same-site", "cross-site", or "none" of
// what a person has typed.  Nothing: no browser, or an old one.  Source: Fetch Metadata (W3C).
std::optional<std::string_view> fetch_site_of(const HttpRequest& request) {
  const auto found = request.find("Sec-Fetch-Site");
  if (found == request.end()) return std::nullopt;
  return std::string_view(found->value().data(), found->value().size());
}

bool is_of_another_site(const HttpRequest& request) {
  const auto site = fetch_site_of(request);
  return site && *site != "same-origin" && *site != "none";
}

// Why a request that would change something, or opens a WebSocket, is not of a page of this server.
std::optional<WebAnswer> cross_site_refusal(const HttpRequest& request, std::string_view host) {
  if (request.count(http::field::origin) > 1) return web_error(400, "400: more than one Origin");
  const auto origin = header_of(request, http::field::origin);
  if (auto text = origin_refusal(origin, host)) return web_error(403, "403: " + *text);
  if (is_of_another_site(request)) {
    return web_error(403, "403: a page of another site may not ask for this");
  }
  const bool has_cookie =
      request.count(http::field::authorization) == 0 && !token_of(request).empty();
  if (has_cookie && !origin && fetch_site_of(request) != "same-origin") {
    return web_error(403,
                     "403: a request with the cookie must say of which page it is (Origin); a "
                     "program sends Authorization: Bearer");
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string_view> header_of(const HttpRequest& request, http::field field) {
  const auto found = request.find(field);
  if (found == request.end()) return std::nullopt;
  return std::string_view(found->value().data(), found->value().size());
}

std::string headers_of(const HttpRequest& request, http::field field) {
  std::string joined;
  const auto [begin, end] = request.equal_range(field);
  for (auto header = begin; header != end; ++header) {
    if (!joined.empty()) joined += ", ";
    joined.append(header->value().data(), header->value().size());
  }
  return joined;
}

std::string_view token_of(const HttpRequest& request) {
  const auto authorization = header_of(request, http::field::authorization);
  if (authorization) return token_of(*authorization);
  // A browser sends one Cookie header.  Its own page's requests are of this origin; others' have
  // nothing to ask for in this user's name.
  const auto cookie = header_of(request, http::field::cookie);
  if (!cookie || request.count(http::field::cookie) != 1 || is_of_another_site(request)) return {};
  return cookie_token(*cookie);
}

bool only_reads(const HttpRequest& request) {
  return request.method() == http::verb::get || request.method() == http::verb::head;
}

std::optional<WebAnswer> refusal_of(const HttpRequest& request, const NetConfig& config,
                                    const std::vector<std::string>& sisters) {
  const auto host = header_of(request, http::field::host);
  if (!host || request.count(http::field::host) != 1) {
    return web_error(400, "400: a request needs one Host header");
  }
  // Where two readers could differ about where a request ends, what follows could be read as
  // another one (request smuggling).  Source: RFC 9112, 6.1.
  if (request.count(http::field::transfer_encoding) > 0 &&
      !beast::iequals(headers_of(request, http::field::transfer_encoding), "chunked")) {
    return web_error(400, "400: the only Transfer-Encoding that is read is chunked");
  }
  error_code error;
  const auto bound = asio::ip::make_address(config.bind, error);
  const HostPolicy policy{.allowed_hosts = config.allowed_hosts,
                          .any_ip_literal = !error && !is_loopback(bound)};
  if (auto text = host_refusal(*host, policy)) return web_error(403, "403: " + *text);
  // Any page may send a request that only reads; the browser does not show it the answer.
  if (only_reads(request) && !websocket::is_upgrade(request)) return std::nullopt;
  if (websocket::is_upgrade(request) && request.count(http::field::origin) == 1) {
    const auto origin = header_of(request, http::field::origin);
    // Browsers write names in lower case.
    const bool is_sister = std::any_of(sisters.begin(), sisters.end(), [&](const auto& sister) {
      return beast::iequals(sister, beast::string_view(origin->data(), origin->size()));
    });
    if (is_sister) return std::nullopt;
  }
  return cross_site_refusal(request, *host);
}

WebAnswer to_secure(const HttpRequest& request) {
  const std::string host(*header_of(request, http::field::host));
  if (!only_reads(request) || websocket::is_upgrade(request)) {
    return web_error(403, "403: this server heeds other hosts by TLS alone: https://" + host);
  }
  WebAnswer answer = web_error(308, "308: by TLS alone: https://" + host);
  answer.location = "https://" + host + std::string(request.target());
  return answer;
}

}  // namespace skerry::server
