// Attacks on a server with users, each with its outcome and how often it was tried.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/access/token_file.hpp"
#include "server/net/common/net_clock.hpp"
#include "tests/unit/net/server_with_users.hpp"

namespace skerry::server {
namespace {

using signalk::Json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::string kRadar1 = "/signalk/v2/api/vessels/self/radars/skerry1/controls/gain";

std::size_t open_files() {
  const auto all = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

class Attacks : public ServerWithUsers {
 protected:
  Attacks() {
    config_.tokens = (folder_ / "tokens.yaml").string();
    config_.setups = (folder_ / "setups").string();
    add_token("valid", {});
  }
  std::string add_token(const std::string& name, std::optional<UtcTime> ends,
                        const std::string& ship = {}) {
    const std::string token = make_token();
    change_tokens(config_.tokens, [&](TokenFile& file) {
      file.add({name, access::TRAINEE, ship, digest_of(token), ends});
    });
    return token;
  }
  bool is_known(const std::string& token) {
    return http("GET", "/status", {}, token).head.starts_with("HTTP/1.1 200");
  }
  void expect_server_goes_on() {
    EXPECT_THAT(http("GET", "/status", {}, {}, {}, "127.0.0.9").head, StartsWith("HTTP/1.1 200"));
  }
};

TEST_F(Attacks, ATokenThatIsNotGoodOpensNothing) {
  start();
  const std::string revoked = add_token("revoked", {});
  ASSERT_TRUE(wait_until([&] { return is_known(revoked); }));
  change_tokens(config_.tokens, [](TokenFile& file) { file.remove("revoked"); });
  const std::string expired = add_token("expired", utc_now() - std::chrono::seconds(1));
  ASSERT_TRUE(wait_until([&] { return !is_known(revoked); }));
  const std::string replayed = sign_in("Anna", kPassword)["token"];
  http("DELETE", "/login", {}, replayed);
  std::string nearly = sign_in("Anna", kPassword)["token"];
  nearly.back() = nearly.back() == 'A' ? 'B' : 'A';
  const std::vector<std::pair<std::string, std::string>> tokens = {
      {"none", ""},
      {"guessed", "skerry_guess"},
      {"nearly right", nearly},
      {"expired", expired},
      {"revoked", revoked},
      {"replayed after signing out", replayed},
      {"a digest of the file", digest_of(expired)},
      {"very long", std::string(4000, 'x')}};
  int refused = 0;
  const std::string body = R"({"value":20})";
  for (const auto& [what, token] : tokens) {
    for (const auto& [method, path] :
         {std::pair("GET", "/status"), std::pair("GET", "/metrics"), std::pair("GET", "/setups"),
          std::pair("PUT", "/setups/a"), std::pair("DELETE", "/setups/a"),
          std::pair("GET", "/signalk/v1/api/vessels/self"), std::pair("GET", kRadar1.c_str()),
          std::pair("PUT", kRadar1.c_str())}) {
      EXPECT_THAT(http(method, path, body, token).head,
                  testing::AnyOf(StartsWith("HTTP/1.1 401"), StartsWith("HTTP/1.1 403")))
          << what << ": " << method << " " << path;
      ++refused;
    }
    TestClient client(server_->tcp_port());
    client.receive_hello();
    if (!token.empty()) {
      EXPECT_EQ(native_sign_in(client, token).code(), wire::Reply::REFUSED) << what;
    }
    wire::ClientMessage look = subscribe_message(1, 0), set = set_gain_message(2, 0, 20);
    look.mutable_subscribe()->set_token(token);
    set.mutable_set()->set_token(token);
    for (const auto& message : {look, set, get_status_message(3)}) {
      client.send(message);
      EXPECT_EQ(client.receive_reply().code(), wire::Reply::REFUSED) << what;
      ++refused;
    }
  }
  std::printf("%d requests with %zu kinds of bad tokens refused\n", refused, tokens.size());
}

TEST_F(Attacks, ATokenInAnAddressIsNotTaken) {
  start();
  const std::string token = sign_in("Anna", kPassword)["token"];
  int refused = 0;
  for (const char* name : {"token", "access_token", "Authorization", "__Host-skerry"}) {
    const std::string query = std::string("?") + name + "=" + token;
    EXPECT_THAT(http("GET", "/status" + query).head, StartsWith("HTTP/1.1 401")) << query;
    EXPECT_THAT(http("GET", "/signalk/v1/api/vessels/self" + query).head,
                StartsWith("HTTP/1.1 401"));
    refused += 2;
  }
  std::printf("%d requests with a good token in their address refused\n", refused);
}

TEST_F(Attacks, AnotherShipsTokenOpensNothingOfThisShip) {
  start();
  const std::string other = add_token("other", {}, kOtherShip);
  ASSERT_TRUE(wait_until([&] { return is_known(other); }));
  TestClient client(server_->tcp_port());
  client.receive_hello();
  EXPECT_EQ(native_sign_in(client, other).code(), wire::Reply::OK);
  wire::ClientMessage con, target, view = subscribe_message(1, 0);
  con.mutable_set()->mutable_con()->set_rudder_deg(5);
  target.mutable_target_order()->set_radar(0);
  view.mutable_subscribe()->set_new_view(true);
  int refused = 0;
  for (const auto& message :
       {subscribe_message(1, 0), view, set_gain_message(1, 0, 20), con, target}) {
    client.send(message);
    EXPECT_THAT(client.receive_reply().text(), HasSubstr("of the ship " + kOtherShip + " alone"));
    ++refused;
  }
  client.send(set_gain_message(1, 1, 20));
  EXPECT_EQ(client.receive_reply().code(), wire::Reply::OK) << "her own";
  std::printf("%d requests for another ship refused\n", refused);
}

TEST_F(Attacks, PathsLeadNowhereElse) {
  start();
  const std::vector<std::string> paths = {"/../../etc/passwd",
                                          "/..%2f..%2fetc/passwd",
                                          "/%2e%2e/%2e%2e/etc/passwd",
                                          "//etc/passwd",
                                          "/.",
                                          "/..",
                                          "/./status",
                                          "/a/../status",
                                          "/%00",
                                          "/status%00",
                                          "/status%0d%0aX: y",
                                          "/\\..\\x",
                                          "/%5c..%5cx",
                                          "/setups/..%2f..%2fusers.yaml",
                                          "/setups/%2e%2e/users.yaml",
                                          "/setups/../users.yaml",
                                          "/setups/a%2f..%2fb",
                                          "/%",
                                          "/%2",
                                          "/%zz",
                                          "status",
                                          "http://evil.example/status",
                                          "*",
                                          "/login/../status",
                                          "/%252e%252e/users.yaml",
                                          "/\xff\xfe"};
  int refused = 0;
  for (const std::string& path : paths) {
    const Answer answer = http("GET", path);
    EXPECT_THAT(answer.head, StartsWith("HTTP/1.1 4")) << path;
    EXPECT_THAT(answer.body, Not(HasSubstr("root:"))) << path;
    EXPECT_THAT(answer.body, Not(HasSubstr("argon2"))) << path;
    EXPECT_EQ(answer.head.find("\r\nX: y"), std::string::npos) << path;
    ++refused;
  }
  std::printf("%d paths refused\n", refused);
}

// Each request is followed by one that must not be read as a second one: at most one answer, and
// the connection ends.
TEST_F(Attacks, NoRequestHidesBehindAnother) {
  start();
  const std::string hidden = "GET /controls.json HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string chunk = "0\r\n\r\n";
  const auto post = [&](const std::string& headers, const std::string& body) {
    return "POST /login HTTP/1.1\r\nHost: localhost\r\n" + headers + "\r\n" + body;
  };
  const std::vector<std::pair<std::string, std::string>> requests = {
      {"CL and TE", post("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n", chunk)},
      {"TE and CL", post("Transfer-Encoding: chunked\r\nContent-Length: 5\r\n", chunk)},
      {"two CL", post("Content-Length: 0\r\nContent-Length: 5\r\n", "")},
      {"a list of CL", post("Content-Length: 0, 5\r\n", "")},
      {"negative CL", post("Content-Length: -1\r\n", "")},
      {"CL with a sign", post("Content-Length: +0\r\n", "")},
      {"CL in hex", post("Content-Length: 0x0\r\n", "")},
      {"CL beyond 64 bits", post("Content-Length: 18446744073709551616\r\n", "")},
      {"TE without chunked", post("Transfer-Encoding: gzip\r\n", "")},
      {"TE identity", post("Transfer-Encoding: identity\r\n", "")},
      {"two TE", post("Transfer-Encoding: chunked\r\nTransfer-Encoding: identity\r\n", chunk)},
      {"TE that is nearly chunked", post("Transfer-Encoding: xchunked\r\n", chunk)},
      {"chunked twice", post("Transfer-Encoding: chunked, chunked\r\n", chunk)},
      {"space before the colon", post("Content-Length : 0\r\n", "")},
      {"space before TE's colon", post("Transfer-Encoding : chunked\r\n", chunk)},
      {"bare LF", "POST /login HTTP/1.1\nHost: localhost\nContent-Length: 0\n\n"},
      {"bare CR", "POST /login HTTP/1.1\r\nHost: localhost\rContent-Length: 0\r\n\r\n"},
      {"no name", post(": 0\r\n", "")},
      {"NUL in a header", post(std::string("X: a\0b\r\n", 8), "")},
      {"header folded before any", "POST /login HTTP/1.1\r\n Host: localhost\r\n\r\n"},
      {"chunk size beyond 64 bits",
       post("Transfer-Encoding: chunked\r\n", "10000000000000000\r\n\r\n")},
      {"chunk size that is none", post("Transfer-Encoding: chunked\r\n", "zz\r\n\r\n")},
      {"chunk without its end", post("Transfer-Encoding: chunked\r\n", "1\r\nab0\r\n\r\n")},
      {"two Host", "GET /status HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n"},
      {"no Host", "GET /status HTTP/1.1\r\n\r\n"},
      {"Host with a user", "GET /status HTTP/1.1\r\nHost: localhost@evil.example\r\n\r\n"},
      {"a rebound name", "GET /status HTTP/1.1\r\nHost: evil.example\r\n\r\n"},
      {"no version", "GET /status\r\nHost: localhost\r\n\r\n"},
      {"HTTP/2's preface", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"},
      {"TLS on a plain port", std::string("\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 11)}};
  int refused = 0;
  for (const auto& [what, request] : requests) {
    const std::string all = http_exchange(server_->http_port(), request + hidden + hidden);
    std::size_t answers = 0;
    for (auto at = all.find("HTTP/1.1 "); at != std::string::npos;
         at = all.find("HTTP/1.1 ", at + 1)) {
      ++answers;
    }
    EXPECT_LE(answers, 1u) << what << ": " << all;
    EXPECT_THAT(all, testing::AnyOf(StartsWith("HTTP/1.1 4"), StartsWith("HTTP/1.1 5"), ""))
        << what;
    EXPECT_THAT(all, Not(HasSubstr("\"controls\""))) << what;
    ++refused;
  }
  std::printf("%d ambiguous requests refused, none behind them read\n", refused);
  expect_server_goes_on();
}

TEST_F(Attacks, WhatDoesNotEndIsCutOff) {
  start();
  const std::string start = "POST /login HTTP/1.1\r\nHost: localhost\r\n";
  // Sends until the server has closed; at most `most` bytes.
  const auto pour = [&](const std::string& begin, const std::string& piece, std::size_t most) {
    TestSocket socket(server_->http_port());
    socket.send(begin);
    std::size_t sent = 0;
    while (sent < most && socket.send(piece)) sent += piece.size();
    EXPECT_LT(sent, most) << "the server takes it for ever: " << begin;
    return sent;
  };
  constexpr std::size_t kMost = 64 << 20;
  const std::string filler(1 << 16, 'x');
  pour("GET /", filler, kMost);
  pour(start + "X: ", filler, kMost);
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "A: b\r\n";
  pour(start, many, kMost);
  pour(start + "Content-Length: 18446744073709551615\r\n\r\n", filler, kMost);
  pour(start + "Transfer-Encoding: chunked\r\n\r\n", "10000\r\n" + filler + "\r\n", kMost);
  std::string small;
  for (int i = 0; i < 1000; ++i) small += "1\r\nx\r\n";
  pour(start + "Transfer-Encoding: chunked\r\n\r\n", small, kMost);
  std::printf("6 endless requests cut off\n");
  expect_server_goes_on();
}

TEST_F(Attacks, TenThousandSilentConnectionsTakeABoundedPartOfTheServer) {
  // Each of 100 addresses opens 100 and says nothing.  (Connections whose handshake is not done are
  // the system's: net.ipv4.tcp_syncookies.)
  rlimit files{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &files), 0);
  const rlim_t before = files.rlim_cur;
  files.rlim_cur = files.rlim_max;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &files), 0);
  const std::size_t most = std::min<std::size_t>(10'000, files.rlim_cur - 2'000);
  config_.foreign_addresses.clear();
  for (int i = 0; i < 100; ++i)
    config_.foreign_addresses.push_back("127.1.0." + std::to_string(i + 1));
  start();
  const std::size_t own = open_files();
  std::vector<std::unique_ptr<TestSocket>> held;
  for (std::size_t i = 0; i < most; ++i) {
    const std::uint16_t port = i % 2 == 0 ? server_->http_port() : server_->tcp_port();
    held.push_back(
        std::make_unique<TestSocket>(port, 0, config_.foreign_addresses[i % 100].c_str()));
    if (i % 1'000 == 0) expect_server_goes_on();
  }
  const std::size_t bound = config_.max_connections + config_.limits.refusals + 200;
  EXPECT_TRUE(wait_until([&] { return open_files() - own - held.size() < bound; }))
      << open_files() - own - held.size() << " files of the server";
  expect_server_goes_on();
  TestClient operator_console(server_->tcp_port(), TestClient::kDefaultBuffer, "127.0.0.9");
  operator_console.receive_hello();
  operator_console.subscribe(0);
  const std::uint64_t first = host_.published();
  host_.publish();
  EXPECT_EQ(operator_console.receive_spokes_until(first + FakeHost::kSectorSpokes - 1).missing, 0u);
  std::printf("%zu silent connections from 100 addresses: the server holds %zu\n", held.size(),
              open_files() - own - held.size());
  held.clear();
  files.rlim_cur = before;
  ::setrlimit(RLIMIT_NOFILE, &files);
}

TEST_F(Attacks, AStormOfResetsLeavesNothingBehind) {
  start();
  const std::size_t own = open_files();
  const std::vector<std::string> begun = {
      "", "G", "GET /status HTTP/1.1\r\nHost: localhost\r\n\r\n",
      request("POST", "/login", who("Anna", "a guess, a guess"), {}),
      "GET /ws HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"};
  constexpr int kResets = 5'000;
  for (int i = 0; i < kResets; ++i) {
    TestSocket socket(i % 6 == 5 ? server_->tcp_port() : server_->http_port());
    if (i % 6 != 5) socket.send(begun[static_cast<std::size_t>(i % 6)]);
    socket.reset();
  }
  EXPECT_TRUE(wait_until([&] { return open_files() <= own; }));
  EXPECT_EQ(server_->status().clients_size(), 0);
  std::printf("%d connections reset\n", kResets);
  expect_server_goes_on();
}

}  // namespace
}  // namespace skerry::server
