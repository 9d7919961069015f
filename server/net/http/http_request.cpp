#include "server/net/http/http_request.hpp"

#include "server/net/common/access_policy.hpp"
#include "server/net/signalk/signalk_rest.hpp"

namespace skerry::server {

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

std::string_view bearer_of(const HttpRequest& request) {
  return token_of(header_of(request, http::field::authorization).value_or(""));
}

bool only_reads(const HttpRequest& request) {
  return request.method() == http::verb::get || request.method() == http::verb::head;
}

std::optional<WebAnswer> refusal_of(const HttpRequest& request, const NetConfig& config) {
  const auto host = header_of(request, http::field::host);
  if (!host || request.count(http::field::host) != 1) {
    return web_error(400, "400: a request needs one Host header");
  }
  error_code error;
  const auto bound = asio::ip::make_address(config.bind, error);
  const HostPolicy policy{.allowed_hosts = config.allowed_hosts,
                          .any_ip_literal = !error && !is_loopback(bound)};
  if (auto text = host_refusal(*host, policy)) return web_error(403, "403: " + *text);
  // Any page may send a request that only reads; the browser does not show it the answer.
  if (only_reads(request) && !websocket::is_upgrade(request)) return std::nullopt;
  if (request.count(http::field::origin) > 1) return web_error(400, "400: more than one Origin");
  if (auto text = origin_refusal(header_of(request, http::field::origin), *host)) {
    return web_error(403, "403: " + *text);
  }
  return std::nullopt;
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
