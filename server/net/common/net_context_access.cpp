// Who is let in: files of tokens, users and the certificate; ships by name; what was refused.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "server/net/common/net_clock.hpp"
#include "server/net/common/net_context.hpp"

namespace skerry::server {

Who NetContext::who(const TcpPeer& peer, std::string_view token) const {
  return gate.who({.from_here = peer.on_own_host, .token = token, .certificate = peer.certificate},
                  utc_now());
}

bool NetContext::knows(const TcpPeer& peer, std::string_view token) const {
  return gate.knows({.token = token, .certificate = peer.certificate}, utc_now());
}

const std::string& NetContext::ship_of(std::uint32_t radar) const {
  static const std::string none;
  return radar < ships_.size() ? ships_[radar] : none;
}

bool NetContext::has_ship(std::string_view name) const {
  return !name.empty() && std::find(ships_.begin(), ships_.end(), name) != ships_.end();
}

std::string NetContext::ships_in_words() const {
  const std::set<std::string> names(ships_.begin(), ships_.end());
  return fmt::format("there {}",
                     names.empty() ? "is none" : fmt::format("are {}", fmt::join(names, ", ")));
}

void NetContext::look_at_tokens() {
  const std::uint64_t before = gate.generation();
  if (const auto wrong = gate.refresh(utc_now())) {
    spdlog::warn("tokens and users: {}", *wrong);
    audit({.what = "tokens and users: " + *wrong});
  }
  if (gate.generation() != before)
    audit({.what = "tokens and users: a file was read anew, or a token ended"});
}

void NetContext::look_at_tls(TlsKeys::When when) {
  if (!tls) return;
  const TlsContextPtr before = tls->context();
  std::string what;
  if (const auto wrong = tls->refresh(when)) {
    what = *wrong + "; the certificate from before holds";
    spdlog::warn("TLS: {}", what);
  } else if (tls->context() != before) {
    what = "the certificate was read anew";
    spdlog::info("TLS: {}", what);
  }
  if (!what.empty()) audit({.what = "TLS: " + what});
}

void NetContext::end_certificates() {
  for (const std::string& peer : connections.close_ended(utc_now())) {
    const std::string what = "the client's certificate has ended; the connection is closed";
    complain("client certificate ended", peer + ": " + what);
    audit({.kind = AuditEntry::Kind::refusal, .from = peer, .what = what});
  }
}

void NetContext::complain(std::string_view kind, std::string_view text) {
  const LogPace::Tell tell = log_pace_.tell(kind, std::chrono::steady_clock::now());
  errors.add(kind, text);  // which logs the first
  if (tell.now && !tell.is_first) {
    spdlog::warn("{}: {} ({} more since the last such line)", kind, text, tell.untold);
  }
}

void NetContext::refuse(const std::string& from, const std::string& who, const std::string& text) {
  errors.add("refused", from + ": " + text);
  audit({.kind = AuditEntry::Kind::refusal, .from = from, .who = who, .what = text});
}

}  // namespace skerry::server
