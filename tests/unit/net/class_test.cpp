// A class that signs in by codes, as the instructor and the trainees meet it over sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "server/access/class_codes.hpp"
#include "tests/unit/net/server_with_users.hpp"

namespace skerry::server {
namespace {

using signalk::Json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class ServerWithAClass : public ServerWithUsers {
 protected:
  ServerWithAClass() {
    // The tries of one test are more than one peer has at once.
    config_.limits.sign_ins_burst = 1000;
  }
  void begin() {
    start();
    anna_ = sign_in("Anna", kPassword)["token"];
  }
  TestClient client_of(const std::string& token) {
    TestClient client(server_->tcp_port());
    client.receive_hello();
    if (!token.empty()) native_sign_in(client, token);
    return client;
  }
  struct ClassAnswer {
    wire::Reply reply;
    wire::ClassList list;
  };
  static ClassAnswer order(TestClient& client, const wire::ClassOrder& order) {
    wire::ClientMessage message;
    *message.mutable_class_order() = order;
    ClassAnswer answer;
    client.on_message = [&](const wire::ServerMessage& told) {
      if (told.has_classes()) answer.list = told.classes();
    };
    client.send(message);
    answer.reply = client.receive_reply();
    client.on_message = nullptr;
    return answer;
  }
  static wire::ClassOrder make(const std::string& ship, std::uint32_t minutes = 0) {
    wire::ClassOrder wanted;
    wanted.mutable_make()->set_ship(ship);
    wanted.mutable_make()->set_minutes(minutes);
    return wanted;
  }
  static wire::ClassOrder end(const std::string& ship) {
    wire::ClassOrder wanted;
    wanted.set_end(ship);
    return wanted;
  }
  static std::string by_code(const std::string& name, const std::string& code) {
    return Json{{"name", name}, {"code", code}}.dump();
  }
  // A code of kShip, made by Anna.
  std::string code_of(TestClient& anna) {
    const ClassAnswer made = order(anna, make(kShip));
    EXPECT_EQ(made.reply.code(), wire::Reply::OK) << made.reply.text();
    return made.list.codes(0).code();
  }
  std::string anna_;  // her token
};

TEST_F(ServerWithAClass, ACodeMakesATraineeOfOneShip) {
  begin();
  TestClient anna = client_of(anna_);
  EXPECT_EQ((*signalk::read_json(http("GET", "/login").body))["class"], false);
  const std::string code = code_of(anna);
  EXPECT_EQ((*signalk::read_json(http("GET", "/login").body))["class"], true);
  const Json kim = *signalk::read_json(http("POST", "/login", by_code("Kim", code)).body);
  EXPECT_EQ(kim["role"], "trainee");
  EXPECT_EQ(kim["ship"], kShip);
  EXPECT_EQ(kim["name"], "Kim (class)");
  TestClient trainee = client_of(kim["token"]);
  trainee.send(set_gain_message(7, 0, 40));
  EXPECT_EQ(trainee.receive_reply().code(), wire::Reply::OK);
  trainee.send(set_gain_message(8, 1, 40));
  EXPECT_THAT(trainee.receive_reply().text(), HasSubstr("of the ship " + kShip + " alone"));
  EXPECT_EQ(order(trainee, {}).reply.code(), wire::Reply::REFUSED) << "codes are the instructor's";
  const ClassAnswer now = order(anna, {});
  ASSERT_EQ(now.list.codes_size(), 1);
  EXPECT_EQ(now.list.codes(0).trainees(0), "Kim");
  EXPECT_EQ(now.list.codes(0).wrong(), 0u);
}

TEST_F(ServerWithAClass, ItsEndPutsTheTraineesOutAndTellsThem) {
  begin();
  TestClient anna = client_of(anna_);
  const std::string code = code_of(anna);
  const Json kim = *signalk::read_json(http("POST", "/login", by_code("Kim", code)).body);
  TestClient trainee = client_of(kim["token"]);
  trainee.subscribe(0);
  EXPECT_EQ(order(anna, end(kShip)).reply.code(), wire::Reply::OK);
  EXPECT_THAT(trainee.receive_reply().text(), HasSubstr("sign in"));
  while (trainee.receive()) {
  }
  EXPECT_THAT(http("POST", "/login", by_code("Kim", code)).head, StartsWith("HTTP/1.1 401"));
  EXPECT_EQ(order(anna, end(kShip)).reply.code(), wire::Reply::UNKNOWN) << "it has ended";
}

TEST_F(ServerWithAClass, WrongCodesSpendItAndTheInstructorIsTold) {
  begin();
  TestClient anna = client_of(anna_);
  const std::string code = code_of(anna);
  const std::string wrong = code == "123456" ? "654321" : "123456";
  const Json kim = *signalk::read_json(http("POST", "/login", by_code("Kim", code)).body);
  for (unsigned i = 0; i < ClassCodes::kMostWrong; ++i) {
    EXPECT_THAT(http("POST", "/login", by_code("Eve", wrong)).head, StartsWith("HTTP/1.1 401"));
  }
  EXPECT_THAT(http("POST", "/login", by_code("Late", code)).head, StartsWith("HTTP/1.1 401"));
  const ClassAnswer spent = order(anna, {});
  EXPECT_EQ(spent.list.codes(0).code(), "");
  EXPECT_EQ(spent.list.codes(0).wrong(), ClassCodes::kMostWrong);
  EXPECT_THAT(http("GET", "/status", {}, kim["token"]).head, StartsWith("HTTP/1.1 200"));
  const auto entries = audit_.entries();
  EXPECT_EQ(std::count_if(entries.begin(), entries.end(),
                          [](const AuditEntry& each) {
                            return each.what.find("take nobody in any more") != std::string::npos;
                          }),
            1);
}

TEST_F(ServerWithAClass, OnePeersGuessesAreSlowedDownBesides) {
  config_.limits.sign_ins_per_second = 0.001;
  config_.limits.sign_ins_burst = 3;
  begin();
  TestClient anna = client_of(anna_);
  const std::string code = code_of(anna);
  for (int i = 0; i < 2; ++i) http("POST", "/login", by_code("Eve", "no code"));
  EXPECT_THAT(http("POST", "/login", by_code("Eve", code)).head, StartsWith("HTTP/1.1 429"));
}

TEST_F(ServerWithAClass, TheAuditHasWhoAndNeverACode) {
  begin();
  TestClient anna = client_of(anna_);
  const std::string code = code_of(anna);
  http("POST", "/login", by_code("Kim", code));
  http("POST", "/login", by_code("my own password", "99999999"));
  order(anna, end(kShip));
  std::vector<std::string> told;
  for (const AuditEntry& entry : audit_.entries()) {
    const std::string all = entry.from + entry.who + entry.what + entry.result;
    EXPECT_THAT(all, Not(HasSubstr(code)));
    EXPECT_THAT(all, Not(HasSubstr("99999999")));
    EXPECT_THAT(all, Not(HasSubstr("my own password")));
    told.push_back(entry.who + ": " + entry.what + ", " + entry.result);
  }
  EXPECT_THAT(
      told, testing::IsSupersetOf({"Anna, instructor: a class code for " + kShip + ", ok",
                                   "Kim (class), trainee of " + kShip + ": by class code, ",
                                   "Anna, instructor: end the class code for " + kShip + ", ok"}));
}

TEST_F(ServerWithAClass, WhatIsWrongIsSaid) {
  begin();
  TestClient anna = client_of(anna_);
  const wire::Reply no_ship = order(anna, make("Flying Dutchman")).reply;
  EXPECT_EQ(no_ship.code(), wire::Reply::UNKNOWN);
  EXPECT_THAT(no_ship.text(), HasSubstr("Flying Dutchman"));
  EXPECT_THAT(no_ship.text(), HasSubstr(kOtherShip));
  EXPECT_THAT(order(anna, make(kShip, 1441)).reply.text(), HasSubstr("1 to 1440 minutes"));
  EXPECT_THAT(order(anna, {}).list.codes(), IsEmpty());
  code_of(anna);
  EXPECT_THAT(http("POST", "/login", by_code("", "123456")).head, StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(
      http("POST", "/login", R"({"name":"Kim","code":"123456","password":"correct horse"})").head,
      StartsWith("HTTP/1.1 400"));
  for (const std::string& token :
       {std::string(), sign_in("Tom", "battery staple")["token"].get<std::string>()}) {
    TestClient other = client_of(token);
    EXPECT_EQ(order(other, make(kShip)).reply.code(), wire::Reply::REFUSED);
  }
}

TEST_F(ServerWithAClass, NativeClientsSignInByItToo) {
  begin();
  TestClient anna = client_of(anna_);
  const std::string code = code_of(anna);
  TestClient kim(server_->tcp_port());
  kim.receive_hello();
  wire::ClientMessage message;
  message.mutable_sign_in()->set_name("Kim");
  message.mutable_sign_in()->set_class_code(code);
  kim.send(message);
  EXPECT_EQ(kim.receive_reply().text(), "trainee Kim (class), of the ship " + kShip);
  kim.subscribe(0);
  EXPECT_EQ(order(anna, {}).list.codes(0).trainees_size(), 1);
  kim.socket().close();
  EXPECT_TRUE(wait_until([&] { return order(anna, {}).list.codes(0).trainees_size() == 0; }))
      << "who has left is signed in no more";
}

}  // namespace
}  // namespace skerry::server
