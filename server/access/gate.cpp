#include "server/access/gate.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace skerry::server {
namespace {

Who admin_named(std::string name) { return {access::ADMIN, {}, std::move(name), {}}; }

Who nobody(std::string more) { return {std::nullopt, {}, {}, std::move(more)}; }

// Takes as long for a nearly right token as for a wrong one: what is compared is a digest.
bool is_same(std::string_view a, std::string_view b) { return digest_of(a) == digest_of(b); }

}  // namespace

Gate::Gate(Config config) : config_(std::move(config)) {
  if (!has_tokens()) return;
  stamp_ = stamp_of_file();
  if (!stamp_) {
    throw std::runtime_error(
        fmt::format("there is no file of tokens {0}; `skerry token new NAME --role instructor "
                    "--tokens {0}` makes it",
                    config_.tokens.string()));
  }
  tokens_ = TokenFile::read(config_.tokens);
}

Who Gate::who(bool from_here, std::string_view token, UtcTime now) const {
  const bool is_control_token =
      !config_.control_token.empty() && !token.empty() && is_same(token, config_.control_token);
  if (is_control_token) return admin_named("with the control token");
  if (!has_tokens()) {
    if (from_here) return admin_named("on the server's own host");
    Who looker{access::OBSERVER, {}, "of another host", {}};
    looker.more =
        config_.control_token.empty()
            ? "it is only accepted from the server's own host; to allow it from elsewhere, "
              "start the server with a control token or with tokens"
        : token.empty() ? "from another host it needs the server's control token"
                        : "the token is not the server's control token";
    return looker;
  }
  if (token.empty()) {
    return from_here ? admin_named("on the server's own host")
                     : nobody("from another host it needs a token; `skerry token new` makes one");
  }
  const TokenFile::Found found = tokens_.find(token, now);
  switch (found.state) {
    case TokenState::unknown:
      return nobody("the token is unknown here, or was revoked");
    case TokenState::ended:
      return nobody(fmt::format("the token {} has ended", found.token->name));
    case TokenState::good:
      break;
  }
  return {found.token->role, found.token->ship, found.token->name, {}};
}

bool Gate::knows(std::string_view token, UtcTime now) const {
  if (token.empty() || !knows_tokens()) return false;
  const Who known = who(false, token, now);
  return known.role && known.more.empty();
}

std::optional<Gate::Stamp> Gate::stamp_of_file() const {
  struct stat found {};
  if (::stat(config_.tokens.c_str(), &found) != 0) return std::nullopt;
  std::error_code none;
  return Stamp{std::filesystem::last_write_time(config_.tokens, none),
               static_cast<std::uintmax_t>(found.st_size),
               static_cast<std::uint64_t>(found.st_ino)};
}

std::optional<std::string> Gate::refresh(UtcTime now) {
  if (!has_tokens()) return std::nullopt;
  const UtcTime before = std::exchange(looked_at_, now);
  const auto ended = [&](const KeptToken& token) {
    return token.ends && *token.ends > before && *token.ends <= now;
  };
  if (std::any_of(tokens_.tokens().begin(), tokens_.tokens().end(), ended)) ++generation_;
  const auto stamp = stamp_of_file();
  if (stamp == stamp_) return std::nullopt;
  stamp_ = stamp;
  try {
    tokens_ = TokenFile::read(config_.tokens);
    ++generation_;
    return std::nullopt;
  } catch (const std::exception& error) {
    return fmt::format("{} (the tokens that were read before hold)", error.what());
  }
}

}  // namespace skerry::server
