#include "server/access/class_codes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <stdexcept>
#include <string>

#include "server/access/gate.hpp"
#include "server/access/token_file.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::MatchesRegex;

const UtcTime kLessonTime{std::chrono::seconds(1'800'000'000)};

// A code that none of them is.
std::string wrong_code(const ClassCodes& codes) {
  std::set<std::string> taken;
  for (const auto& [ship, code] : codes.codes()) taken.insert(code.digits);
  for (int i = 100'000;; ++i) {
    if (taken.count(std::to_string(i)) == 0) return std::to_string(i);
  }
}

TEST(ClassCodes, AreDigitsAndOneForAShip) {
  ClassCodes codes;
  std::set<std::string> seen;
  for (unsigned digits = 6; digits <= 8; ++digits) {
    const std::string code = codes.make("Frida", 1h, digits, kLessonTime).digits;
    EXPECT_THAT(code, MatchesRegex("[0-9]+"));
    EXPECT_EQ(code.size(), digits);
    seen.insert(code);
  }
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_EQ(codes.codes().size(), 1u);
  EXPECT_TRUE(codes.end("Frida"));
  EXPECT_FALSE(codes.end("Frida"));
}

TEST(ClassCodes, AllTenDigitsComeAtEachPlace) {
  ClassCodes codes;
  std::set<std::pair<int, char>> seen;
  for (int i = 0; i < 400; ++i) {
    const std::string code = codes.make("Frida", 1h, 6, kLessonTime).digits;
    for (int place = 0; place < 6; ++place) seen.insert({place, code[place]});
  }
  // Each of the 60 is missing with a probability of 0.9^400 = 5e-19.
  EXPECT_EQ(seen.size(), 60u);
}

TEST(ClassCodes, WhatIsNotAllowedIsRefused) {
  ClassCodes codes;
  EXPECT_THROW(codes.make("", 1h, 6, kLessonTime), std::invalid_argument);
  EXPECT_THROW(codes.make("Frida", 0min, 6, kLessonTime), std::invalid_argument);
  EXPECT_THROW(codes.make("Frida", 1441min, 6, kLessonTime), std::invalid_argument);
  EXPECT_THROW(codes.make("Frida", 1h, 5, kLessonTime), std::invalid_argument);
  EXPECT_THROW(codes.make("Frida", 1h, 9, kLessonTime), std::invalid_argument);
  for (std::size_t i = 0; i < ClassCodes::kMostCodes; ++i) {
    codes.make("ship " + std::to_string(i), 1h, 6, kLessonTime);
  }
  EXPECT_THROW(codes.make("one more", 1h, 6, kLessonTime), std::invalid_argument);
  codes.make("ship 1", 1h, 6, kLessonTime);
  for (const std::string& name : {std::string(), std::string(65, 'x'), std::string("a\nb")}) {
    EXPECT_THROW(codes.sign_in("123456", name, kLessonTime), std::invalid_argument) << name;
  }
  EXPECT_EQ(codes.codes().at("ship 1").wrong, 0u) << "nothing was tried";
}

TEST(ClassCodes, MakeATraineeOfTheShipUntilTheyEnd) {
  ClassCodes codes;
  std::string code = codes.make("Frida", 1h, 6, kLessonTime).digits;
  codes.make("Ymer", 2h, 6, kLessonTime);
  code.insert(3, " - ");
  const auto kim = codes.sign_in(code, "Kim", kLessonTime);
  ASSERT_TRUE(kim);
  const std::string digest = digest_of(kim->token);
  ASSERT_NE(codes.find(digest, kLessonTime), nullptr);
  const Who who = codes.find(digest, kLessonTime)->who();
  EXPECT_EQ(text_of(who), "Kim (class), trainee of Frida");
  EXPECT_THAT(codes.trainees_of("Frida", kLessonTime), ElementsAre("Kim"));
  EXPECT_THAT(codes.trainees_of("Ymer", kLessonTime), ElementsAre());
  EXPECT_NE(codes.find(digest, kLessonTime + 59min), nullptr);
  EXPECT_EQ(codes.find(digest, kLessonTime + 1h), nullptr);
  EXPECT_FALSE(codes.sign_in(code, "Late", kLessonTime + 1h));
  EXPECT_FALSE(codes.refresh(kLessonTime + 59min));
  EXPECT_TRUE(codes.refresh(kLessonTime + 1h));
  EXPECT_EQ(codes.codes().size(), 1u);
}

TEST(ClassCodes, AnotherCodeOrItsEndPutsOutWhoSignedInByIt) {
  ClassCodes codes;
  const std::string first = codes.make("Frida", 1h, 6, kLessonTime).digits;
  const auto kim = codes.sign_in(first, "Kim", kLessonTime);
  const std::string other = codes.make("Ymer", 1h, 6, kLessonTime).digits;
  const auto lea = codes.sign_in(other, "Lea", kLessonTime);
  codes.make("Frida", 1h, 6, kLessonTime);
  EXPECT_EQ(codes.find(digest_of(kim->token), kLessonTime), nullptr);
  EXPECT_NE(codes.find(digest_of(lea->token), kLessonTime), nullptr);
  codes.end("Ymer");
  EXPECT_EQ(codes.find(digest_of(lea->token), kLessonTime), nullptr);
}

TEST(ClassCodes, TooManyWrongOnesSpendThemAndWhoIsInStays) {
  ClassCodes codes;
  const std::string right = codes.make("Frida", 1h, 6, kLessonTime).digits;
  codes.make("Ymer", 1h, 8, kLessonTime);
  const auto kim = codes.sign_in(right, "Kim", kLessonTime);
  const std::string wrong = wrong_code(codes);
  for (unsigned i = 0; i < ClassCodes::kMostWrong; ++i) {
    EXPECT_TRUE(codes.takes_in(kLessonTime));
    EXPECT_FALSE(codes.sign_in(wrong, "Eve", kLessonTime));
  }
  EXPECT_FALSE(codes.takes_in(kLessonTime));
  EXPECT_FALSE(codes.sign_in(right, "Late", kLessonTime)) << "the right one comes too late";
  EXPECT_EQ(codes.codes().at("Frida").wrong, ClassCodes::kMostWrong);
  EXPECT_NE(codes.find(digest_of(kim->token), kLessonTime), nullptr);
  const std::string next = codes.make("Frida", 1h, 6, kLessonTime).digits;
  EXPECT_TRUE(codes.sign_in(next, "Late", kLessonTime));
}

TEST(ClassCodes, ARightCodeGivesNoNewTriesToWhoGuesses) {
  ClassCodes codes;
  const std::string right = codes.make("Frida", 1h, 6, kLessonTime).digits;
  for (int i = 0; i < 10; ++i) codes.sign_in(wrong_code(codes), "Eve", kLessonTime);
  codes.sign_in(right, "Kim", kLessonTime);
  EXPECT_EQ(codes.codes().at("Frida").wrong, 10u);
}

TEST(ClassCodes, TheFirstOfTooManyIsOut) {
  ClassCodes codes;
  const std::string code = codes.make("Frida", 1h, 6, kLessonTime).digits;
  const auto first = codes.sign_in(code, "first", kLessonTime);
  for (std::size_t i = 1; i <= ClassCodes::kMostTrainees; ++i) {
    codes.sign_in(code, "later", kLessonTime + std::chrono::seconds(i));
  }
  EXPECT_EQ(codes.find(digest_of(first->token), kLessonTime), nullptr);
  EXPECT_EQ(codes.trainees_of("Frida", kLessonTime).size(), ClassCodes::kMostTrainees);
}

TEST(GateOfAClass, KnowsTraineesOnOpenAndOnClosedServers) {
  for (const char* control : {"", "secret"}) {
    Gate gate({control, {}, {}});
    gate.make_class_code("Frida", 1h, 6, kLessonTime);
    const std::uint64_t before = gate.generation();
    const std::string code = gate.class_codes().codes().at("Frida").digits;
    const auto kim = gate.sign_in_class(code, "Kim", kLessonTime);
    ASSERT_TRUE(kim);
    EXPECT_TRUE(gate.knows(kim->token, kLessonTime));
    EXPECT_EQ(gate.who(false, kim->token, kLessonTime).role, access::TRAINEE);
    EXPECT_EQ(gate.who(true, kim->token, kLessonTime).ship, "Frida")
        << "narrowed on the own host, too";
    EXPECT_EQ(gate.end_of(kim->token, kLessonTime), kLessonTime + 1h);
    EXPECT_NE(gate.generation(), before);
    EXPECT_TRUE(gate.sign_out(kim->token));
    EXPECT_FALSE(gate.knows(kim->token, kLessonTime));
    const auto lea = gate.sign_in_class(code, "Lea", kLessonTime);
    const std::uint64_t signed_in = gate.generation();
    EXPECT_FALSE(gate.refresh(kLessonTime + 2h));
    EXPECT_NE(gate.generation(), signed_in) << "connections look at their rights";
    EXPECT_FALSE(gate.knows(lea->token, kLessonTime + 2h));
  }
}

}  // namespace
}  // namespace skerry::server
