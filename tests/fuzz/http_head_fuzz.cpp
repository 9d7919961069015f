// Requests to the HTTP port, as far as they are looked at before anything is done: header and path,
// cookie and subprotocols.
#include <string>
#include <string_view>
#include <vector>

#include "server/net/http/carried_token.hpp"
#include "server/net/http/http_request.hpp"
#include "server/net/http/login_routes.hpp"
#include "server/net/http/setup_routes.hpp"
#include "server/net/signalk/signalk_rest.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

bool contains(std::string_view all, std::string_view part) {
  return all.find(part) != std::string_view::npos;
}

void check_path(std::string_view target) {
  const std::string path = clean_path(target);
  if (path.empty()) return;
  fuzz::require(path.front() == '/', "a path is absolute");
  fuzz::require(!contains(path, "//") && !contains(path, "/../") && !contains(path, "/./"),
                "and leads nowhere else");
  fuzz::require(!path.ends_with("/.."), "also at its end");
  fuzz::require(path.find('\0') == std::string::npos, "and has no NUL");
  (void)is_login_path(path);
  (void)is_setup_path(path);
  (void)is_signalk_path(path);
}

void check_carriers(std::string_view text) {
  const std::string_view cookie = cookie_token(text);
  fuzz::require(contains(text, cookie), "the token of a cookie stands there");
  fuzz::require(cookie.find(';') == std::string_view::npos, "and ends with it");
  const OfferedSubprotocols offered = offered_subprotocols(text);
  fuzz::require(offered.token.empty() || contains(text, "skerry.token." + offered.token),
                "so does that of a subprotocol");
  fuzz::require(!offered.skerry || contains(text, kSubprotocol), "and ours");
}

void check_request(const HttpRequest& request) {
  static const NetConfig config;  // on loopback
  check_path({request.target().data(), request.target().size()});
  static const std::vector<std::string> sisters{"http://bridge-2:8080"};
  const auto refused = refusal_of(request, config, {});
  if (refused) {
    fuzz::require(refusal_of(request, config, sisters) || websocket::is_upgrade(request),
                  "what a sister's page may do besides is to open a WebSocket");
    fuzz::require(refused->status == 400 || refused->status == 403, "a refusal is one");
    fuzz::require(refused->body.size() < 1000, "and of bounded length");
    return;
  }
  fuzz::require(request.count(http::field::host) == 1, "who is served names one host");
  if (only_reads(request) && !websocket::is_upgrade(request)) return;
  const std::string host(*header_of(request, http::field::host));
  const auto origin = header_of(request, http::field::origin);
  fuzz::require(!origin || origin->size() > host.size(), "a page that changes something is ours");
  const auto site = request.find("Sec-Fetch-Site");
  const bool says_ours = origin || (site != request.end() && site->value() == "same-origin");
  const bool by_cookie = request.count(http::field::authorization) == 0;
  fuzz::require(!by_cookie || token_of(request).empty() || says_ours,
                "a cookie changes nothing without a word of whose page it is");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_path(text);
  check_carriers(text);
  http::request_parser<http::string_body> parser;
  parser.header_limit(8 * 1024);
  parser.body_limit(std::uint64_t{64} * 1024);
  error_code error;
  parser.eager(true);
  parser.put(asio::const_buffer(data, size), error);
  if (!error && parser.is_done()) check_request(parser.get());
  return 0;
}
