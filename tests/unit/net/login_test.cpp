// Signing in by name and password, over HTTP and as Signal K's clients do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "protocol/signalk/json.hpp"
#include "server/access/password_desk.hpp"
#include "tests/unit/net/server_with_users.hpp"

namespace skerry::server {
namespace {

using signalk::Json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// Some 150 ms of a core, so that others can be seen to go on meanwhile.
constexpr PasswordCost kDear{.memory_kib = 64 * 1024, .passes = 3};
const std::string kSignalkLogin = "/signalk/v1/auth/login";

TEST_F(ServerWithUsers, APasswordGivesATokenThatEveryProtocolTakes) {
  start();
  EXPECT_THAT(http("GET", "/status").head, StartsWith("HTTP/1.1 401"));
  const Json tom = sign_in("Tom", "battery staple");
  EXPECT_EQ(tom["role"], "trainee");
  EXPECT_EQ(tom["name"], "Tom");
  EXPECT_EQ(tom["ship"], "ship of radar 0");
  const std::string token = tom["token"];
  EXPECT_THAT(token, StartsWith("skerry_"));
  EXPECT_THAT(http("GET", "/status", {}, token).head, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(http("GET", "/signalk/v1/api/vessels/self", {}, token).head,
              StartsWith("HTTP/1.1 200"));
  TestClient client(server_->tcp_port());
  client.receive_hello();
  EXPECT_EQ(native_sign_in(client, token).text(), "trainee Tom, of the ship ship of radar 0");
  client.send(set_gain_message(7, 0, 40));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK);
  client.send(set_gain_message(8, 1, 40));
  EXPECT_THAT(client.receive_reply().text(), HasSubstr("of the ship ship of radar 0 alone"));
}

TEST_F(ServerWithUsers, TellsWhoOneIs) {
  start();
  const Json kNobody{{"users", true}, {"class", false}};
  const auto told = [&](const std::string& token) {
    return *signalk::read_json(http("GET", "/login", {}, token).body);
  };
  EXPECT_EQ(told({}), kNobody);
  const Json anna = sign_in("Anna", kPassword);
  const Json as_anna = told(anna["token"]);
  for (const char* name : {"role", "name", "ends"}) EXPECT_EQ(as_anna[name], anna[name]) << name;
  EXPECT_FALSE(as_anna.contains("token"));
  EXPECT_EQ(told("skerry_guess"), kNobody);
  // Who is nobody in particular is not told as if she had signed in, also on the server's own host.
  EXPECT_EQ(told({}), kNobody);
}

TEST_F(ServerWithUsers, WhatIsWrongIsRefusedAlikeAndToldToTheAuditWithoutThePassword) {
  start();
  const Answer wrong = http("POST", "/login", who("Anna", "incorrect horse"));
  const Answer nobody = http("POST", "/login", who("my own password", "incorrect horse"));
  EXPECT_THAT(wrong.head, StartsWith("HTTP/1.1 401"));
  EXPECT_EQ(wrong.head, nobody.head);
  EXPECT_EQ(wrong.body, nobody.body);
  for (const char* body : {"", "{", "[]", "7", R"({"name":"Anna"})", R"({"name":7,"password":8})",
                           R"({"name":"Anna","password":""})"}) {
    EXPECT_THAT(http("POST", "/login", body).head, StartsWith("HTTP/1.1 400")) << body;
  }
  EXPECT_THAT(http("POST", "/login", who("Anna", std::string(300, 'x'))).head,
              StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(http("POST", "/login", std::string(5'000, '{')).head, StartsWith("HTTP/1.1 413"));
  EXPECT_THAT(http("PUT", "/login").head,
              testing::AllOf(StartsWith("HTTP/1.1 405"), HasSubstr("GET, HEAD, POST, DELETE")));
  sign_in("Anna", kPassword);
  int refusals = 0, sign_ins = 0;
  for (const AuditEntry& entry : audit_.entries()) {
    const std::string all = entry.who + entry.what + entry.result;
    for (const char* secret : {"horse", "my own", "skerry_"})
      EXPECT_THAT(all, Not(HasSubstr(secret)));
    if (entry.kind == AuditEntry::Kind::refusal) ++refusals;
    if (entry.kind != AuditEntry::Kind::sign_in) continue;
    ++sign_ins;
    EXPECT_EQ(entry.who, "Anna, instructor");
  }
  EXPECT_EQ(sign_ins, 1);
  EXPECT_GE(refusals, 3);
}

TEST_F(ServerWithUsers, SigningOutEndsTheTokenAndWhatItHolds) {
  start();
  const std::string token = sign_in("Anna", kPassword)["token"];
  TestClient client(server_->tcp_port());
  client.receive_hello();
  native_sign_in(client, token);
  client.subscribe(0);
  EXPECT_THAT(http("DELETE", "/login").head, StartsWith("HTTP/1.1 401"));
  EXPECT_THAT(http("DELETE", "/login", {}, token).head, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(http("GET", "/status", {}, token).head, StartsWith("HTTP/1.1 401"));
  while (client.receive()) {
  }
}

TEST_F(ServerWithUsers, ARemovedUserIsOutWithinASecondAndARoleIsTheFilesAtOnce) {
  start();
  const std::string anna = sign_in("Anna", kPassword)["token"];
  const std::string tom = sign_in("Tom", "battery staple")["token"];
  change_users(file_, [](UserFile& file) {
    EXPECT_TRUE(file.remove("Anna"));
    KeptUser changed = *file.find("Tom");
    file.remove("Tom");
    changed.role = access::OBSERVER;
    file.add(changed);
  });
  EXPECT_TRUE(wait_until(
      [&] { return http("GET", "/status", {}, anna).head.starts_with("HTTP/1.1 401"); }));
  EXPECT_EQ((*signalk::read_json(http("GET", "/login", {}, tom).body))["role"], "observer");
}

TEST_F(ServerWithUsers, OthersGoOnWhileAPasswordIsTried) {
  add("Slow", access::OBSERVER, kPassword, {}, kDear);
  start();
  TestSocket slow(server_->http_port());
  slow.send(request("POST", "/login", who("Slow", kPassword), {}));
  const auto signed_in = [&] {
    const auto entries = audit_.entries();
    return std::any_of(entries.begin(), entries.end(), [](const AuditEntry& entry) {
      return entry.kind == AuditEntry::Kind::sign_in;
    });
  };
  int meanwhile = 0;
  do {
    EXPECT_THAT(http("GET", "/controls.json").head, StartsWith("HTTP/1.1 200"));
    if (!signed_in()) ++meanwhile;
  } while (!signed_in());
  EXPECT_GE(meanwhile, 1) << "pages while one password is tried";
  EXPECT_THAT(slow.receive_all(), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithUsers, TheServerEndsWhilePasswordsAreTried) {
  add("Slow", access::OBSERVER, kPassword, {}, kDear);
  start();
  std::vector<std::unique_ptr<TestSocket>> sockets;
  for (int i = 0; i < 4; ++i) {
    sockets.push_back(std::make_unique<TestSocket>(server_->http_port()));
    sockets.back()->send(request("POST", "/login", who("Slow", kPassword), {}));
  }
  http("GET", "/controls.json");
  server_->stop();
  server_.reset();
}

TEST_F(ServerWithUsers, GuessesAreSlowedDown) {
  config_.limits.sign_ins_per_second = 0.001;
  config_.limits.sign_ins_burst = 3;
  start();
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(http("POST", "/login", who("Anna", "guess after guess")).head,
                StartsWith("HTTP/1.1 401"));
  }
  const Answer limited = http("POST", "/login", who("Anna", kPassword));
  EXPECT_THAT(limited.head, StartsWith("HTTP/1.1 429"));
  EXPECT_THAT(limited.body, HasSubstr("too many sign-ins from 127.0.0.1"));
}

TEST_F(ServerWithUsers, SignalKsClientsSignInAndOut) {
  start();
  const auto login = [&](const std::string& name, const std::string& password) {
    return http("POST", kSignalkLogin, Json{{"username", name}, {"password", password}}.dump());
  };
  const Json made = *signalk::read_json(login("Anna", kPassword).body);
  EXPECT_EQ(made["timeToLive"], 12 * 3600);
  const std::string token = made["token"];
  EXPECT_THAT(http("GET", "/status", {}, token).head, StartsWith("HTTP/1.1 200"));
  const Answer wrong = login("Anna", "a guess, a guess");
  EXPECT_THAT(wrong.head, StartsWith("HTTP/1.1 401"));
  EXPECT_TRUE(signalk::read_json(wrong.body)) << "Signal K's errors are documents";
  EXPECT_EQ((*signalk::read_json(login("whoever", token).body))["token"], token)
      << "a token for a password, for clients that know no other way";
  EXPECT_THAT(http("GET", kSignalkLogin).head, StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(http("POST", kSignalkLogin + "/", "{}").head, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(http("PUT", "/signalk/v1/auth/logout", {}, token).head, StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(http("GET", "/status", {}, token).head, StartsWith("HTTP/1.1 401"));
}

TEST_F(ServerWithUsers, StrangersWhoHoldAllPlacesKeepNobodyFromSigningIn) {
  config_.max_connections = 24;  // 22 of strangers, 6 of them of one address
  config_.foreign_addresses = {"127.0.0.1", "127.0.0.2", "127.0.0.3",
                               "127.0.0.4", "127.0.0.5", "127.0.0.6"};
  config_.limits.silent_time = std::chrono::minutes(5);
  start();
  std::vector<std::unique_ptr<TestSocket>> held;
  for (int i = 0; i < 22; ++i) {
    const std::string from = "127.0.0." + std::to_string(2 + i / 6);
    held.push_back(std::make_unique<TestSocket>(server_->http_port(), 0, from.c_str()));
  }
  const auto ask = [&](const std::string& method, const std::string& path, const std::string& body,
                       const std::string& token) {
    return http_exchange(server_->http_port(), request(method, path, body, token), "127.0.0.6");
  };
  ASSERT_TRUE(
      wait_until([&] { return ask("GET", "/controls.json", {}, {}).starts_with("HTTP/1.1 503"); }));
  EXPECT_THAT(ask("POST", "/login", who("Anna", "a guess, a guess"), {}),
              StartsWith("HTTP/1.1 401"));
  const std::string answer = ask("POST", "/login", who("Anna", kPassword), {});
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200"));
  const Json told = *signalk::read_json(answer.substr(answer.find("\r\n\r\n") + 4));
  EXPECT_THAT(ask("GET", "/status", {}, told["token"]), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithUsers, PagesOfOtherSitesMayNotTry) {
  start();
  const std::string body = who("Anna", kPassword);
  EXPECT_THAT(
      http_exchange(server_->http_port(),
                    "POST /login HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.test\r\n"
                    "Connection: close\r\nContent-Length: " +
                        std::to_string(body.size()) + "\r\n\r\n" + body),
      StartsWith("HTTP/1.1 403"));
}

TEST_F(ServerWithUsers, WithoutUsersThereIsNoSigningIn) {
  config_.users.clear();
  start();
  EXPECT_EQ((*signalk::read_json(http("GET", "/login").body))["users"], false);
  const Answer none = http("POST", "/login", who("Anna", kPassword));
  EXPECT_THAT(none.head, StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(none.body, HasSubstr("--users"));
}

}  // namespace
}  // namespace skerry::server
