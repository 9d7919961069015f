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

// By PasswordCost{}.
constexpr const char* kNobodysHash =
    "$argon2id$v=19$m=19456,t=2,p=1$AAAAAAAAAAAAAAAAAAAAAA$"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";

}  // namespace

template <typename Contents>
bool Gate::Watched<Contents>::read_if_new() {
  if (path.empty()) return false;
  const auto now = stamp_of(path);
  if (now == stamp) return false;
  stamp = now;
  contents = Contents::read(path);
  return true;
}

Gate::Gate(Config config)
    : control_token_(std::move(config.control_token)),
      tokens_{std::move(config.tokens), {}, {}},
      users_{std::move(config.users), {}, {}} {
  if (!tokens_.path.empty() && !stamp_of(tokens_.path)) {
    throw std::runtime_error(
        fmt::format("there is no file of tokens {0}; `skerry token new NAME --role instructor "
                    "--tokens {0}` makes it",
                    tokens_.path.string()));
  }
  if (has_users() && !stamp_of(users_.path)) {
    throw std::runtime_error(
        fmt::format("there is no file of users {0}; `skerry user add NAME --role instructor "
                    "--users {0}` makes it",
                    users_.path.string()));
  }
  tokens_.read_if_new();
  users_.read_if_new();
}

Who Gate::who(const Shown& shown, UtcTime now) const {
  const std::string_view token = shown.token;
  const bool is_control_token =
      !control_token_.empty() && !token.empty() && is_same(token, control_token_);
  if (is_control_token) return admin_named("with the control token");
  if (auto signed_in = who_signed_in(token, now)) return *std::move(signed_in);
  if (!is_closed()) {
    if (shown.from_here) return admin_named("on the server's own host");
    Who looker{access::OBSERVER, {}, "of another host", {}};
    looker.more = control_token_.empty()
                      ? "it is only accepted from the server's own host; to allow it from "
                        "elsewhere, start the server with a control token, tokens or users"
                  : token.empty() ? "from another host it needs the server's control token"
                                  : "the token is not the server's control token";
    return looker;
  }
  if (token.empty()) return who_shows_no_token(shown, now);
  const TokenFile::Found found = tokens_.contents.find(token, now);
  switch (found.state) {
    case TokenState::unknown:
      return nobody(has_users() ? "the token is unknown here, has ended or was revoked; sign in "
                                  "again, or give another"
                                : "the token is unknown here, or was revoked");
    case TokenState::ended:
      return nobody(fmt::format("the token {} has ended", found.token->name));
    case TokenState::good:
      break;
  }
  return {found.token->role, found.token->ship, found.token->name, {}};
}

Who Gate::who_shows_no_token(const Shown& shown, UtcTime now) const {
  const TokenFile::Found found = tokens_.contents.find_certificate(shown.certificate, now);
  if (found.state == TokenState::good) {
    return {found.token->role, found.token->ship, found.token->name, {}, true};
  }
  if (found.state == TokenState::ended) {
    return nobody(fmt::format("the entry of the certificate {} has ended", found.token->name));
  }
  if (shown.from_here) return admin_named("on the server's own host");
  if (!shown.certificate.empty()) {
    return nobody(
        "the certificate has no entry among the server's tokens, or it was revoked; `skerry token "
        "new NAME --certificate FILE` makes one");
  }
  return nobody(has_users() ? "from another host one has to sign in, or to give a token"
                            : "from another host it needs a token; `skerry token new` makes one");
}

std::optional<Who> Gate::who_signed_in(std::string_view token, UtcTime now) const {
  if (token.empty()) return std::nullopt;
  const std::string digest = digest_of(token);
  if (const auto* trainee = classes_.find(digest, now)) return trainee->who();
  const auto session = sessions_.find(digest);
  if (session == sessions_.end()) return std::nullopt;
  const KeptUser* user = user_of(session->second, now);
  if (user == nullptr) return nobody("one has to sign in again, or to give a token");
  return Who{user->role, user->ship, user->name, {}};
}

bool Gate::knows(const Shown& shown, UtcTime now) const {
  if (shown.token.empty() && shown.certificate.empty()) return false;
  const Who known = who({.token = shown.token, .certificate = shown.certificate}, now);
  return known.role && known.more.empty();
}

std::optional<Gate::Stamp> Gate::stamp_of(const std::filesystem::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return std::nullopt;
  std::error_code none;
  return Stamp{std::filesystem::last_write_time(file, none),
               static_cast<std::uintmax_t>(found.st_size),
               static_cast<std::uint64_t>(found.st_ino)};
}

std::optional<std::string> Gate::refresh(UtcTime now) {
  const UtcTime before = std::exchange(looked_at_, now);
  const auto ended = [&](const KeptToken& token) {
    return token.ends && *token.ends > before && *token.ends <= now;
  };
  const auto& tokens = tokens_.contents.tokens();
  if (std::any_of(tokens.begin(), tokens.end(), ended)) ++generation_;
  std::string wrong;
  const auto heed = [&](auto& file, const char* what) {
    try {
      if (file.read_if_new()) ++generation_;
    } catch (const std::exception& error) {
      wrong += fmt::format("{}{} (the {} that were read before hold)", wrong.empty() ? "" : "; ",
                           error.what(), what);
    }
  };
  heed(tokens_, "tokens");
  heed(users_, "users");
  const auto is_over = [&](const auto& each) { return user_of(each.second, now) == nullptr; };
  if (std::erase_if(sessions_, is_over) > 0) ++generation_;
  if (classes_.refresh(now)) ++generation_;
  if (wrong.empty()) return std::nullopt;
  return wrong;
}

const KeptUser* Gate::user_of(const Session& session, UtcTime now) const {
  if (now >= session.ends) return nullptr;
  const KeptUser* user = users_.contents.find(session.user);
  return user != nullptr && user->password == session.hash ? user : nullptr;
}

std::string Gate::hash_of(std::string_view name) const {
  const KeptUser* user = users_.contents.find(name);
  return user != nullptr ? user->password : kNobodysHash;
}

std::optional<Gate::SignedIn> Gate::sign_in(std::string_view name, std::string_view hash,
                                            UtcTime now) {
  const KeptUser* user = users_.contents.find(name);
  if (user == nullptr || user->password != hash) return std::nullopt;
  auto oldest = sessions_.end();
  std::size_t hers = 0;
  for (auto each = sessions_.begin(); each != sessions_.end(); ++each) {
    if (each->second.user != name) continue;
    ++hers;
    if (oldest == sessions_.end() || each->second.began < oldest->second.began) oldest = each;
  }
  if (hers >= kMostOfUser) {
    sessions_.erase(oldest);
    ++generation_;
  }
  SignedIn made{make_token(), {user->role, user->ship, user->name, {}}, now + kSignedIn};
  sessions_[digest_of(made.token)] = {user->name, user->password, now, made.ends};
  return made;
}

std::optional<Gate::SignedIn> Gate::sign_in_class(std::string_view code, const std::string& name,
                                                  UtcTime now) {
  auto made = classes_.sign_in(code, name, now);
  if (!made) return std::nullopt;
  ++generation_;  // somebody may have been the one too many
  return SignedIn{std::move(made->token), made->trainee.who(), made->trainee.ends};
}

void Gate::make_class_code(const std::string& ship, std::chrono::minutes time, unsigned digits,
                           UtcTime now) {
  classes_.make(ship, time, digits, now);
  ++generation_;
}

bool Gate::end_class_code(std::string_view ship) {
  ++generation_;
  return classes_.end(ship);
}

bool Gate::sign_out(std::string_view token) {
  if (token.empty()) return false;
  const std::string digest = digest_of(token);
  if (sessions_.erase(digest) == 0 && !classes_.sign_out(digest)) return false;
  ++generation_;
  return true;
}

std::optional<UtcTime> Gate::end_of(const Shown& shown, UtcTime now) const {
  const std::string_view token = shown.token;
  if (token.empty()) {
    const TokenFile::Found found = tokens_.contents.find_certificate(shown.certificate, now);
    return found.token != nullptr ? found.token->ends : std::nullopt;
  }
  const auto session = sessions_.find(digest_of(token));
  if (session != sessions_.end()) return session->second.ends;
  if (const auto* trainee = classes_.find(digest_of(token), now)) return trainee->ends;
  const TokenFile::Found found = tokens_.contents.find(token, now);
  return found.token != nullptr ? found.token->ends : std::nullopt;
}

}  // namespace skerry::server
