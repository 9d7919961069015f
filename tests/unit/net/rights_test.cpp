// What each role may do over each protocol, as a server with tokens answers.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/access/asked.hpp"
#include "server/access/token_file.hpp"
#include "server/net/common/encoders.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/signalk/signalk_rest.hpp"
#include "tests/unit/net/fake_host.hpp"
#include "tests/unit/net/kept_audit.hpp"
#include "tests/unit/net/test_client.hpp"
#include "tests/unit/net/test_web_socket.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::vector<Role> kEveryRole = {access::OBSERVER, access::TRAINEE, access::ASSESSOR,
                                      access::INSTRUCTOR, access::ADMIN};
const std::string kGain = "/signalk/v2/api/vessels/self/radars/skerry0/controls/gain";

class ServerWithTokens : public testing::Test {
 protected:
  ServerWithTokens() : host_(2) {
    for (const Role role : kEveryRole) tokens_[role] = add(name_of(role), role);
    host_.board = std::make_shared<FakeBoard>();
    NetConfig config = test_config();
    config.tokens = file_.string();
    config.setups = (folder_ / "setups").string();
    config.audit = &audit_;
    server_.emplace(host_, config, std::span<const WebFile>{});
    server_->start();
  }
  ~ServerWithTokens() override {
    server_->stop();
    std::filesystem::remove_all(folder_);
  }

  std::string add(const std::string& name, Role role, const std::string& ship = {}) {
    const std::string token = make_token();
    change_tokens(file_, [&](TokenFile& file) {
      file.add({name, role, ship, digest_of(token), std::nullopt});
    });
    return token;
  }
  void revoke(Role role) {
    change_tokens(file_, [&](TokenFile& file) { EXPECT_TRUE(file.remove(name_of(role))); });
  }

  static wire::Reply ask(TestClient& client, const wire::ClientMessage& message) {
    client.send(message);
    return client.receive_reply();
  }
  static wire::ClientMessage signing_in(const std::string& token) {
    wire::ClientMessage message;
    message.mutable_sign_in()->set_token(token);
    return message;
  }
  TestClient client_of(const std::string& token) {
    TestClient client(server_->tcp_port());
    client.receive_hello();
    const wire::Reply reply = ask(client, signing_in(token));
    EXPECT_EQ(reply.code(), wire::Reply::OK) << reply.text();
    return client;
  }
  std::string http(const std::string& method, const std::string& path, const std::string& token,
                   const std::string& body = {}) {
    return http_exchange(
        server_->http_port(),
        method + " " + path + " HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer " + token +
            "\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
            body);
  }
  static std::string bearer(const std::string& token) {
    return "Authorization: Bearer " + token + "\r\n";
  }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-rights-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "tokens.yaml";
  std::map<Role, std::string> tokens_;
  KeptAudit audit_;
  FakeHost host_;
  std::optional<NetServer> server_;
};

// Every kind of message, by every role: refused in the table's words, or let through.
TEST_F(ServerWithTokens, EveryKindOfMessageIsForTheRolesOfTheTable) {
  const auto* kinds = wire::ClientMessage::descriptor()->FindOneofByName("kind");
  int asked = 0;
  for (const Role role : kEveryRole) {
    for (int i = 0; i < kinds->field_count(); ++i) {
      wire::ClientMessage message;
      message.GetReflection()->MutableMessage(&message, kinds->field(i));
      if (message.has_sign_in()) continue;
      if (message.has_set()) message.mutable_set()->set_gain(40);
      TestClient client = client_of(tokens_[role]);
      const Who who{role, {}, name_of(role), {}};
      std::optional<std::string> expected;
      for (const std::string& right : asked_by(message).rights) {
        if (!expected) expected = why_not(who, right);
      }
      const wire::Reply reply = ask(client, message);
      ++asked;
      if (expected) {
        EXPECT_EQ(reply.code(), wire::Reply::REFUSED) << kinds->field(i)->name();
        EXPECT_EQ(reply.text(), *expected);
      } else {
        EXPECT_THAT(reply.text(), testing::Not(HasSubstr(" is for ")));
      }
    }
  }
  std::printf("%d messages by 5 roles\n", asked);
}

TEST_F(ServerWithTokens, SigningInSaysWhoOneIs) {
  TestClient client(server_->tcp_port());
  client.receive_hello();
  const std::string mate = add("mate", access::TRAINEE, "ship of radar 0");
  ASSERT_TRUE(wait_until([&] {
    return ask(client, signing_in(mate)).text() == "trainee mate, of the ship ship of radar 0";
  }));
  const wire::Reply wrong = ask(client, signing_in("skerry_guess"));
  EXPECT_EQ(wrong.code(), wire::Reply::REFUSED);
  EXPECT_THAT(wrong.text(), HasSubstr("unknown here, or was revoked"));
  EXPECT_EQ(ask(client, set_gain_message(1, 0, 33)).code(), wire::Reply::OK) << "as before";
  EXPECT_THAT(ask(client, set_gain_message(1, 1, 33)).text(), HasSubstr("alone"));
  EXPECT_EQ(ask(client, signing_in("")).code(), wire::Reply::OK) << "this is the own host";
  EXPECT_EQ(ask(client, set_gain_message(1, 1, 33)).code(), wire::Reply::OK);
}

TEST_F(ServerWithTokens, WhoDidWhatIsKeptWithoutAnyToken) {
  using Kind = AuditEntry::Kind;
  const auto told = [&] {
    std::vector<std::string> lines;
    for (const AuditEntry& e : audit_.entries()) {
      EXPECT_THAT(e.what + e.who + e.result, testing::Not(HasSubstr("skerry_")));
      lines.push_back(std::to_string(static_cast<int>(e.kind)) + "|" + e.who + "|" + e.what + "|" +
                      e.result);
    }
    return lines;
  };
  {
    TestClient looker = client_of(tokens_[access::OBSERVER]);
    ask(looker, set_gain_message(1, 0, 41));
    ask(looker, signing_in("skerry_guess"));
    TestClient leads = client_of(tokens_[access::INSTRUCTOR]);
    ask(leads, set_gain_message(1, 0, 42));
    wire::ClientMessage record;
    record.mutable_record()->set_name("a");
    record.mutable_record()->set_token(tokens_[access::ADMIN]);
    ask(leads, record);
  }
  http("GET", "/status", "skerry_guess");
  const std::string body = R"({"kind": "skerry set-up", "version": 1, "name": "a", "parts": {}})";
  http("PUT", "/setups/a", tokens_[access::TRAINEE], body);
  http("PUT", "/setups/b", tokens_[access::OBSERVER], body);
  http("PUT", kGain, tokens_[access::TRAINEE], R"({"value": 30})");
  const auto kind = [](Kind k) { return std::to_string(static_cast<int>(k)); };
  EXPECT_THAT(
      told(),
      testing::ElementsAre(
          kind(Kind::sign_in) + "|observer, observer||",
          testing::StartsWith(kind(Kind::refusal) + "|observer, observer|to set the controls"),
          testing::StartsWith(kind(Kind::refusal) + "||sign in: the token is unknown here"),
          kind(Kind::sign_in) + "|instructor, instructor||",
          kind(Kind::request) + "|admin, admin|record { name: \"a\" }|this server does not record",
          testing::StartsWith(kind(Kind::refusal) + "||"),
          kind(Kind::request) + "|trainee, trainee|PUT /setups/a|ok",
          testing::StartsWith(kind(Kind::refusal) + "|observer, observer|")));
  EXPECT_TRUE(wait_until([&] { return audit_.all_known().size() == 4; }));
  EXPECT_THAT(audit_.all_known(),
              testing::UnorderedElementsAre("instructor, instructor", "trainee, trainee",
                                            "instructor, instructor", "observer, observer"))
      << "while her change was carried out (the first two), and while her console left";
  EXPECT_EQ(audit_.known_now(), 0u);
  revoke(access::OBSERVER);
  EXPECT_TRUE(wait_until([&] {
    return audit_.entries().back().what ==
           "tokens and users: a file was read anew, or a token ended";
  }));
}

TEST_F(ServerWithTokens, ATokenInAMessageHoldsForItAlone) {
  TestClient client = client_of(tokens_[access::OBSERVER]);
  wire::ClientMessage set = set_gain_message(1, 0, 41);
  EXPECT_EQ(ask(client, set).code(), wire::Reply::REFUSED);
  set.mutable_set()->set_token(tokens_[access::TRAINEE]);
  EXPECT_EQ(ask(client, set).code(), wire::Reply::OK);
  EXPECT_EQ(host_.last_set().token(), "");
  set.mutable_set()->clear_token();
  EXPECT_EQ(ask(client, set).code(), wire::Reply::REFUSED);
}

TEST_F(ServerWithTokens, WhoseTokenIsRevokedIsToldAndClosed) {
  TestClient looker = client_of(tokens_[access::OBSERVER]);
  TestClient stays = client_of(tokens_[access::TRAINEE]);
  looker.subscribe();
  stays.subscribe();
  TestClient streams = client_of(tokens_[access::ASSESSOR]);
  wire::ClientMessage stream;
  stream.mutable_board_stream()->set_kind(wire::BoardStream::RECORDS);
  EXPECT_EQ(ask(streams, stream).code(), wire::Reply::OK);
  revoke(access::OBSERVER);
  EXPECT_THAT(looker.receive_reply().text(), HasSubstr("unknown here, or was revoked"));
  while (looker.receive()) {
  }
  revoke(access::ASSESSOR);
  EXPECT_THAT(streams.receive_reply().text(), HasSubstr("revoked"));
  while (streams.receive()) {
  }
  EXPECT_EQ(ask(stays, set_gain_message(1, 0, 42)).code(), wire::Reply::OK);
}

TEST_F(ServerWithTokens, HttpTakesItAsBearer) {
  EXPECT_THAT(http("GET", "/status", tokens_[access::OBSERVER]), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(http("GET", "/metrics", tokens_[access::OBSERVER]), StartsWith("HTTP/1.1 200"));
  for (const char* path : {"/status", "/metrics"}) {
    const std::string answer = http("GET", path, "skerry_guess");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 401"));
    EXPECT_THAT(answer, HasSubstr("WWW-Authenticate: Bearer\r\n"));
    EXPECT_THAT(answer, HasSubstr("revoked"));
    EXPECT_THAT(http("HEAD", path, "skerry_guess"), StartsWith("HTTP/1.1 401"));
  }
  EXPECT_THAT(http("GET", "/controls.json", "skerry_guess"), StartsWith("HTTP/1.1 200"));
}

TEST_F(ServerWithTokens, SetUpsAreSeenByAllAndKeptByWhoHasAConsole) {
  const std::string path = "/setups/night%20%C3%A4";
  const std::string document =
      R"({"kind": "skerry set-up", "version": 1, "name": "night \u00e4", "parts": {}})";
  EXPECT_THAT(http("GET", "/setups", "skerry_guess"), StartsWith("HTTP/1.1 401"));
  for (const Role role : kEveryRole) {
    const bool keeps = role != access::OBSERVER && role != access::ASSESSOR;
    const std::string& token = tokens_[role];
    EXPECT_THAT(http("GET", "/setups", token), StartsWith("HTTP/1.1 200")) << name_of(role);
    EXPECT_THAT(http("PUT", path, token, document),
                StartsWith(keeps ? "HTTP/1.1 200" : "HTTP/1.1 403"))
        << name_of(role);
    EXPECT_THAT(http("DELETE", path, token), StartsWith(keeps ? "HTTP/1.1 200" : "HTTP/1.1 403"))
        << name_of(role);
  }
}

TEST_F(ServerWithTokens, WhoDidWhatIsSeenByWhoLeadsTheExerciseOfAllShips) {
  EXPECT_THAT(http("GET", "/audit", "skerry_guess"), StartsWith("HTTP/1.1 401"));
  for (const Role role : kEveryRole) {
    const bool leads = role == access::INSTRUCTOR || role == access::ADMIN;
    for (const char* path : {"/audit", "/audit?last=1&who=a"}) {
      EXPECT_THAT(http("GET", path, tokens_[role]),
                  StartsWith(leads ? "HTTP/1.1 200" : "HTTP/1.1 403"))
          << name_of(role);
    }
  }
  const std::string aboard = add("mate", access::INSTRUCTOR, "ship of radar 0");
  ASSERT_TRUE(
      wait_until([&] { return http("GET", "/status", aboard).starts_with("HTTP/1.1 200"); }));
  EXPECT_THAT(http("GET", "/audit", aboard), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(http("PUT", "/audit", tokens_[access::ADMIN]), StartsWith("HTTP/1.1 405"));
}

TEST_F(ServerWithTokens, SignalKReadsAndChangesByRole) {
  const std::string body = R"({"value":20})";
  EXPECT_THAT(http("GET", kGain, tokens_[access::OBSERVER]), StartsWith("HTTP/1.1 200"));
  EXPECT_THAT(http("PUT", kGain, tokens_[access::OBSERVER], body), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(http("PUT", kGain, tokens_[access::TRAINEE], body), StartsWith("HTTP/1.1 200"));
  for (const char* path : {"/signalk/v1/api/vessels/self", "/v1/api/radars", kGain.c_str()}) {
    EXPECT_THAT(http("GET", path, "skerry_guess"), StartsWith("HTTP/1.1 401")) << path;
  }
  EXPECT_THAT(http("GET", "/signalk", "skerry_guess"), StartsWith("HTTP/1.1 200"));
  const std::string login =
      http("POST", "/signalk/v1/auth/login", "",
           R"({"username":"x","password":")" + tokens_[access::TRAINEE] + "\"}");
  EXPECT_THAT(login, HasSubstr(tokens_[access::TRAINEE]));
  EXPECT_THAT(http("POST", "/signalk/v1/auth/login", "", R"({"username":"x","password":"y"})"),
              StartsWith("HTTP/1.1 401"));
}

TEST_F(ServerWithTokens, SignalKStreamsEndWithTheirToken) {
  const std::string stream = "/signalk/v1/stream?subscribe=none";
  EXPECT_THROW(TestWebSocket(server_->http_port(), stream, bearer("skerry_guess")),
               std::runtime_error);
  TestWebSocket deltas(server_->http_port(), stream, bearer(tokens_[access::OBSERVER]));
  TestWebSocket spokes(server_->http_port(), "/signalk/v2/api/vessels/self/radars/skerry0/spokes",
                       bearer(tokens_[access::OBSERVER]));
  ASSERT_TRUE(deltas.receive()) << "hello";
  revoke(access::OBSERVER);
  while (deltas.receive()) {
  }
  while (spokes.receive()) {
  }
}

TEST(SignalkRights, EveryPathHasOne) {
  const std::map<std::string, std::string> expected = {
      {"GET /signalk", "signalk.discover"},
      {"GET /signalk/", "signalk.discover"},
      {"GET /signalk/v2/features", "signalk.discover"},
      {"POST /signalk/v1/auth/login", "signalk.discover"},
      {"PUT /signalk/v1/auth/logout", "signalk.discover"},
      {"GET /skServer/loginStatus", "signalk.discover"},
      {"GET /loginstatus", "signalk.discover"},
      {"GET /signalk/v1/auth/login/x", "signalk.read"},
      {"GET /signalk/v1/api/vessels/self", "signalk.read"},
      {"HEAD /v1/api/radars", "signalk.read"},
      {"PUT " + kGain, "signalk.change"},
      {"POST " + kGain, "signalk.change"},
      {"DELETE /signalk", "signalk.discover"},
      {"PATCH /v1/api/radars", "signalk.change"}};
  for (const auto& [request, right] : expected) {
    const auto space = request.find(' ');
    EXPECT_EQ(signalk_right(request.substr(0, space), request.substr(space + 1)), right) << request;
    EXPECT_NE(right_of(right), nullptr);
  }
}

}  // namespace
}  // namespace skerry::server
