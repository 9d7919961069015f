#include "server/net/common/signing_in.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include "server/net/common/net_clock.hpp"

namespace skerry::server {
namespace {

using Kind = SignInOutcome::Kind;

SignInOutcome welcome(NetContext& context, const std::string& from, Gate::SignedIn made,
                      const char* how) {
  context.audit(
      {.kind = AuditEntry::Kind::sign_in, .from = from, .who = text_of(made.who), .what = how});
  return {.kind = Kind::signed_in, .made = std::move(made)};
}

std::size_t codes_that_take_in(const NetContext& context) {
  const auto& codes = context.gate.class_codes().codes();
  return static_cast<std::size_t>(std::count_if(
      codes.begin(), codes.end(), [](const auto& each) { return each.second.takes_in(); }));
}

// Codes that the last wrong try has spent: the instructor has to know.
void tell_spent_codes(NetContext& context, std::size_t took_in, const std::string& from) {
  if (codes_that_take_in(context) == took_in) return;
  const std::string text = fmt::format(
      "class codes: {} wrong ones were tried, the last from {}; they take nobody in any more, and "
      "new ones can be made",
      ClassCodes::kMostWrong, from);
  spdlog::warn("{}", text);
  context.audit({.what = text});
}

SignInOutcome sign_in_class(NetContext& context, const std::string& from,
                            const Credentials& credentials) {
  constexpr const char* kWrong = "no class has this code now; ask the instructor for it";
  const std::size_t took_in = codes_that_take_in(context);
  try {
    auto made = context.gate.sign_in_class(credentials.class_code, credentials.name, utc_now());
    if (made) return welcome(context, from, *std::move(made), "by class code");
  } catch (const std::invalid_argument& error) {
    return {.kind = Kind::malformed, .text = error.what()};
  }
  context.refuse(from, {}, fmt::format("sign in by class code: {}", kWrong));
  tell_spent_codes(context, took_in, from);
  return {.kind = Kind::wrong, .text = kWrong};
}

}  // namespace

void sign_in(NetContext& context, const TcpPeer& peer, const std::string& from,
             Credentials credentials, std::function<void(SignInOutcome)> done) {
  const bool is_class = !credentials.class_code.empty();
  const auto refuse = [&](Kind kind, std::string why) {
    context.complain("too many sign-ins", peer.text + ": " + why);
    done({.kind = kind, .text = std::move(why)});
  };
  if (!is_class && !context.passwords) {
    return done(
        {.kind = Kind::not_here, .text = "this server has no users; with --users FILE it does"});
  }
  // Who finds no place has not tried, and may as often as before.
  if (!is_class && !context.passwords->has_place()) {
    return refuse(Kind::busy, "too many sign in just now; try again in a second");
  }
  if (!context.sign_ins.take(peer, std::chrono::steady_clock::now())) {
    return refuse(Kind::too_often, context.sign_ins.refusal(peer));
  }
  if (is_class) return done(sign_in_class(context, from, credentials));
  const std::string hash = context.gate.hash_of(credentials.name);
  context.passwords->try_password(
      hash, std::move(credentials.password),
      [&context, from, hash, name = std::move(credentials.name),
       done = std::move(done)](bool is_right) {
        auto made = is_right ? context.gate.sign_in(name, hash, utc_now()) : std::nullopt;
        if (made) return done(welcome(context, from, *std::move(made), "by password"));
        constexpr const char* kWrong = "no user has this name and password";
        const std::string as = context.gate.has_user(name) ? " as " + name : "";
        context.refuse(from, {}, fmt::format("sign in{}: {}", as, kWrong));
        done({.kind = Kind::wrong, .text = kWrong});
      });
}

}  // namespace skerry::server
