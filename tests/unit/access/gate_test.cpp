#include "server/access/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const UtcTime kNow{std::chrono::seconds(1'800'000'000)};

class GateOfAFile : public testing::Test {
 protected:
  ~GateOfAFile() override { std::filesystem::remove_all(folder_); }

  std::string add(const std::string& name, Role role, const std::string& ship = {},
                  std::optional<UtcTime> ends = {}) {
    const std::string token = make_token();
    change_tokens(file_, [&](TokenFile& file) {
      file.add({name, role, ship, digest_of(token), ends});
    });
    return token;
  }
  Gate gate() { return Gate({"control", file_}); }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-gate-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "tokens.yaml";
};

TEST(Gate, WithoutTokensTheOwnHostIsFreeAndOthersLook) {
  const Gate gate({});
  EXPECT_EQ(gate.who(true, "", kNow).role, access::ADMIN);
  EXPECT_EQ(gate.who(true, "anything", kNow).role, access::ADMIN);
  const Who other = gate.who(false, "anything", kNow);
  EXPECT_EQ(other.role, access::OBSERVER);
  EXPECT_THAT(*why_not(other, "set.controls"), HasSubstr("start the server with a control token"));
  EXPECT_FALSE(why_not(other, "subscribe", "Frida"));
}

TEST(Gate, TheControlTokenMakesAnAdmin) {
  const Gate gate({"secret", {}});
  EXPECT_EQ(gate.who(false, "secret", kNow).role, access::ADMIN);
  for (const char* wrong : {"", "Secret", "secre", "secrets"}) {
    const Who who = gate.who(false, wrong, kNow);
    EXPECT_EQ(who.role, access::OBSERVER) << wrong;
    EXPECT_THAT(*why_not(who, "record"), HasSubstr("token")) << wrong;
  }
}

TEST_F(GateOfAFile, AMissingFileIsAnErrorThatNamesTheCommand) {
  try {
    gate();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file_.string()));
    EXPECT_THAT(error.what(), HasSubstr("skerry token new"));
  }
}

TEST_F(GateOfAFile, GivesEachTokenItsRoleAndShip) {
  const std::string trainee = add("bridge 1", access::TRAINEE, "Frida");
  const std::string wall = add("wall", access::OBSERVER);
  const Gate gate = this->gate();
  for (const bool from_here : {false, true}) {
    const Who who = gate.who(from_here, trainee, kNow);
    EXPECT_EQ(who.role, access::TRAINEE);
    EXPECT_EQ(who.ship, "Frida");
    EXPECT_EQ(who.name, "bridge 1");
    EXPECT_EQ(gate.who(from_here, wall, kNow).role, access::OBSERVER);
    EXPECT_EQ(gate.who(from_here, "control", kNow).role, access::ADMIN);
    EXPECT_FALSE(gate.who(from_here, "a guess", kNow).role) << "also from the server's own host";
  }
  EXPECT_EQ(gate.who(true, "", kNow).role, access::ADMIN);
  EXPECT_FALSE(gate.who(false, "", kNow).role);
  EXPECT_THAT(*why_not(gate.who(false, "", kNow), "get_status"), HasSubstr("skerry token new"));
}

TEST_F(GateOfAFile, ATokenEndsToTheSecond) {
  const std::string token = add("exam", access::OBSERVER, {}, kNow + 10s);
  Gate gate = this->gate();
  gate.refresh(kNow);
  const auto before = gate.generation();
  EXPECT_TRUE(gate.who(false, token, kNow + 9999ms).role);
  gate.refresh(kNow + 9s);
  EXPECT_EQ(gate.generation(), before);
  EXPECT_FALSE(gate.who(false, token, kNow + 10s).role);
  EXPECT_THAT(gate.who(false, token, kNow + 10s).more, HasSubstr("exam has ended"));
  gate.refresh(kNow + 10s);
  EXPECT_NE(gate.generation(), before) << "sessions look again";
}

TEST_F(GateOfAFile, RevokedTokensAndNewOnesAreHeededAtTheNextLook) {
  const std::string first = add("first", access::OBSERVER);
  Gate gate = this->gate();
  const auto before = gate.generation();
  EXPECT_FALSE(gate.refresh(kNow));
  EXPECT_EQ(gate.generation(), before) << "nothing has changed";
  const std::string second = add("second", access::ADMIN);
  change_tokens(file_, [](TokenFile& file) { EXPECT_TRUE(file.remove("first")); });
  EXPECT_FALSE(gate.refresh(kNow + 1s));
  EXPECT_NE(gate.generation(), before);
  EXPECT_FALSE(gate.who(false, first, kNow).role);
  EXPECT_EQ(gate.who(false, second, kNow).role, access::ADMIN);
}

TEST_F(GateOfAFile, ADamagedOrLostFileIsToldOnceAndWhatWasReadHolds) {
  const std::string token = add("wall", access::OBSERVER);
  Gate gate = this->gate();
  std::ofstream(file_) << "tokens:\n  - name: wall\n    sha256: 12\n";
  const auto wrong = gate.refresh(kNow);
  ASSERT_TRUE(wrong);
  EXPECT_THAT(*wrong, HasSubstr(":3:"));
  EXPECT_THAT(*wrong, HasSubstr("64 hexadecimal digits"));
  EXPECT_FALSE(gate.refresh(kNow + 1s)) << "it was told";
  EXPECT_TRUE(gate.who(false, token, kNow).role);
  std::filesystem::remove(file_);
  EXPECT_TRUE(gate.refresh(kNow + 2s));
  EXPECT_TRUE(gate.who(false, token, kNow).role);
}

}  // namespace
}  // namespace skerry::server
