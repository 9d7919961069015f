#include "server/app/options/exposure.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

bool is_open_to_others(const NetConfig& net) {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(net.bind, error);
  return !error && !is_loopback(address);  // what is no address is told when it is listened on
}

bool has_users(const NetConfig& net) { return !net.users.empty() || !net.tokens.empty(); }

// Whoever guesses it is an admin, and may try as often as she likes.
constexpr std::size_t kLeastTokenLength = 16;
bool has_weak_token(const NetConfig& net) {
  return !net.control_token.empty() && net.control_token.size() < kLeastTokenLength;
}
bool is_guarded(const NetConfig& net) { return has_users(net) && !net.tls.empty(); }

// Requires that something is.
const char* missing(const NetConfig& net) {
  if (has_users(net)) return "encryption";
  return net.tls.empty() ? "users and without encryption" : "users";
}

}  // namespace

std::string exposure_of(const NetConfig& net) {
  if (!is_open_to_others(net)) return {};
  if (is_guarded(net)) {
    return has_weak_token(net) ? "Not secure: the control token of this server can be guessed."
                               : "";
  }
  return fmt::format("Not secure: this server is open to other hosts without {}.", missing(net));
}

void require_guarded(const NetConfig& net, bool insecure) {
  if (insecure || exposure_of(net).empty()) return;
  if (is_guarded(net)) {
    throw std::runtime_error(fmt::format(
        "control_token: other hosts could guess it, for it has {} characters; expected: at least "
        "{}, at random, or none (`skerry token new` makes tokens)",
        net.control_token.size(), kLeastTokenLength));
  }
  std::string lines;
  if (net.tls.empty()) lines += "\n  skerry tls init tls                       then --tls tls";
  if (!has_users(net)) {
    lines += "\n  skerry user add NAME --role instructor    then --users users.yaml";
  }
  throw std::runtime_error(
      fmt::format("bind {}: other hosts would reach this server without {}. Make{}\nor say "
                  "--insecure, on a network where everybody may see, and read along",
                  net.bind, missing(net), lines));
}

}  // namespace skerry::server
