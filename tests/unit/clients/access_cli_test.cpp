// How `skerry` signs in, and orders class codes, against fake servers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/unit/clients/fake_server.hpp"
#include "tests/unit/clients/program.hpp"

namespace skerry::client {
namespace {

using testing::HasSubstr;
using testing::Not;

struct AccessOutcome {
  int code;
  std::string out, err;
};

AccessOutcome run_with(const FakeServer& server, std::vector<std::string> arguments,
                       const std::string& input = {}) {
  arguments.insert(arguments.end(), {"--port", std::to_string(server.port())});
  Program program(std::move(arguments), input);
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

// A server that knows class codes and passwords.
void greet(FakePeer& peer) {
  wire::ServerMessage message;
  message.mutable_hello()->set_protocol_version(1);
  message.mutable_hello()->set_has_classes(true);
  peer.send(message);
}

TEST(CliSignIn, ByNameAndAPasswordOfAPipe) {
  FakeServer server([](FakePeer& peer) {
    greet(peer);
    const auto who = peer.receive();
    ASSERT_TRUE(who && who->has_sign_in());
    EXPECT_EQ(who->sign_in().name(), "Anna");
    EXPECT_EQ(who->sign_in().password(), "correct horse");
    peer.answer(who->request());
    const auto set = peer.receive();
    ASSERT_TRUE(set && set->has_set());
    peer.answer(set->request(), wire::Reply::OK, "done");
    peer.wait_until_client_leaves();
  });
  const AccessOutcome outcome =
      run_with(server, {"set", "--gain", "5", "--user", "Anna"}, "correct horse\nmore\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "OK: done\n");
}

TEST(CliSignIn, ARefusalSaysWhyAndWhatToDo) {
  FakeServer server([](FakePeer& peer) {
    greet(peer);
    if (const auto who = peer.receive()) {
      peer.answer(who->request(), wire::Reply::REFUSED,
                  "sign in: no user has this name and password");
    }
    peer.wait_until_client_leaves();
  });
  const AccessOutcome outcome = run_with(server, {"status", "--user", "Eve"}, "a guess\n");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no user has this name"));
  EXPECT_THAT(outcome.err, HasSubstr("skerry user list"));
}

TEST(CliSignIn, WhoMayNotIsToldHowToSayWhoSheIs) {
  const auto refuses = [](const char* why) {
    return [why](FakePeer& peer) {
      greet(peer);
      if (const auto asked = peer.receive()) {
        peer.answer(asked->request(), wire::Reply::REFUSED, why);
      }
      peer.wait_until_client_leaves();
    };
  };
  FakeServer closed(refuses("from another host one has to sign in, or to give a token"));
  EXPECT_THAT(run_with(closed, {"status"}).err, HasSubstr("--user NAME asks for a password"));
  FakeServer busy(refuses("sign in: too many sign in just now; try again in a second"));
  EXPECT_THAT(run_with(busy, {"status"}).err, Not(HasSubstr("--user")));
  FakeServer doctored(refuses("from another host one has to sign in, or to give a token"));
  const AccessOutcome doctor = run_with(doctored, {"doctor"});
  EXPECT_THAT(doctor.out, HasSubstr("say who you are"));
  EXPECT_THAT(doctor.out, Not(HasSubstr("no skerryd that answers")));
}

TEST(CliSignIn, AnOlderServerIsNotAskedAndNoPasswordIsNone) {
  FakeServer server([](FakePeer& peer) {
    peer.say_hello();
    EXPECT_FALSE(peer.receive()) << "it would end the connection";
  });
  const AccessOutcome old = run_with(server, {"status", "--user", "Anna"}, "correct horse\n");
  EXPECT_EQ(old.code, 1);
  EXPECT_THAT(old.err, HasSubstr("older server"));
  Program program({"status", "--user", "Anna"}, "");
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("no password was given"));
}

// One order; the answer is the list.
void answer_class(FakePeer& peer, const wire::ClassList& list,
                  const std::function<void(const wire::ClassOrder&)>& check) {
  greet(peer);
  const auto asked = peer.receive();
  ASSERT_TRUE(asked && asked->has_class_order());
  check(asked->class_order());
  wire::ServerMessage message;
  *message.mutable_classes() = list;
  peer.send(message);
  peer.answer(asked->request());
  peer.wait_until_client_leaves();
}

wire::ClassList one_code() {
  wire::ClassList list;
  wire::ClassCode& code = *list.add_codes();
  code.set_ship("Frida");
  code.set_code("012345");
  code.set_wrong(3);
  code.set_wrong_most(20);
  code.add_trainees("Kim");
  code.add_trainees("Lea\x1b[2J");
  const auto ends = std::chrono::system_clock::now() + std::chrono::hours(3);
  code.set_ends_utc_ns(static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(ends.time_since_epoch()).count()));
  return list;
}

TEST(CliClass, MakesACodeAndPrintsIt) {
  FakeServer server([](FakePeer& peer) {
    answer_class(peer, one_code(), [](const wire::ClassOrder& order) {
      EXPECT_EQ(order.make().ship(), "Frida");
      EXPECT_EQ(order.make().minutes(), 90u);
      EXPECT_EQ(order.make().digits(), 7u);
      EXPECT_EQ(order.token(), "secret");
    });
  });
  const AccessOutcome outcome = run_with(
      server, {"class", "new", "Frida", "--for", "1.5h", "--digits", "7", "--token", "secret"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "012 345\n");
  EXPECT_THAT(outcome.err, HasSubstr("a trainee of Frida for 3:00"));
}

TEST(CliClass, ListsCodesAndWhoSignedIn) {
  FakeServer server([](FakePeer& peer) {
    answer_class(peer, one_code(), [](const wire::ClassOrder& order) {
      EXPECT_EQ(order.order_case(), wire::ClassOrder::ORDER_NOT_SET);
    });
  });
  const AccessOutcome outcome = run_with(server, {"class", "list"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* part : {"Frida", "012 345", "3:00", "3/20", "Kim, Lea?[2J"}) {
    EXPECT_THAT(outcome.out, HasSubstr(part));
  }
  FakeServer none([](FakePeer& peer) { answer_class(peer, {}, [](const auto&) {}); });
  EXPECT_EQ(run_with(none, {"class", "list"}).out, "no class codes\n");
}

TEST(CliClass, EndsACodeAndPassesTheServersRefusalOn) {
  FakeServer server([](FakePeer& peer) {
    greet(peer);
    const auto asked = peer.receive();
    ASSERT_TRUE(asked && asked->has_class_order());
    EXPECT_EQ(asked->class_order().end(), "Frida");
    peer.answer(asked->request(), wire::Reply::UNKNOWN, "the ship 'Frida' has no class code");
    peer.wait_until_client_leaves();
  });
  const AccessOutcome outcome = run_with(server, {"class", "end", "Frida"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("has no class code"));
  EXPECT_THAT(outcome.err, HasSubstr("skerry class list"));
}

TEST(CliClass, WhatIsNoOrderIsTwo) {
  const std::vector<std::vector<std::string>> wrong = {{"class"},
                                                       {"class", "new"},
                                                       {"class", "new", "Frida", "--for", "3"},
                                                       {"class", "new", "Frida", "--for", "25h"},
                                                       {"class", "new", "Frida", "--digits", "5"},
                                                       {"class", "end"}};
  for (const auto& arguments : wrong) {
    Program program(arguments);
    EXPECT_EQ(program.wait(), 2) << testing::PrintToString(arguments);
    EXPECT_THAT(program.err(), Not(testing::IsEmpty()));
  }
}

}  // namespace
}  // namespace skerry::client
