#include "server/access/gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "server/access/password.hpp"

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
  Gate gate() { return Gate({"control", file_, {}}); }

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
  const Gate gate({"secret", {}, {}});
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

TEST_F(GateOfAFile, ACertificateIsWhoItsEntrySaysUntilATokenIsShown) {
  const std::string digest(64, 'c'), other(64, 'd');
  const std::string wall = add("wall", access::ASSESSOR);
  change_tokens(file_, [&](TokenFile& file) {
    file.add({"relay", access::TRAINEE, "Frida", "", kNow + 10s, digest});
  });
  Gate gate = this->gate();
  gate.refresh(kNow);
  for (const bool from_here : {false, true}) {
    const Who who = gate.who({from_here, "", digest}, kNow);
    EXPECT_EQ(text_of(who), "certificate relay, trainee of Frida");
    EXPECT_THAT(*why_not(who, "subscribe", "Ymer"), HasSubstr("the certificate relay is of"));
    EXPECT_EQ(text_of(gate.who({from_here, wall, digest}, kNow)), "wall, assessor");
    EXPECT_FALSE(gate.who({from_here, "a guess", digest}, kNow).role);
    EXPECT_FALSE(gate.who({from_here, digest, ""}, kNow).role) << "it is no token";
    EXPECT_FALSE(gate.who({from_here, digest, digest}, kNow).role);
    EXPECT_THAT(gate.who({from_here, "", digest}, kNow + 10s).more, HasSubstr("relay has ended"));
  }
  EXPECT_TRUE(gate.knows({false, "", digest}, kNow));
  EXPECT_FALSE(gate.knows({false, "a guess", digest}, kNow));
  EXPECT_FALSE(gate.knows({false, "", other}, kNow));
  EXPECT_FALSE(gate.knows({true, "", other}, kNow));
  EXPECT_EQ(gate.end_of({false, "", digest}, kNow), kNow + 10s);
  EXPECT_EQ(gate.who({true, "", other}, kNow).role, access::ADMIN) << "as without one";
  EXPECT_THAT(*why_not(gate.who({false, "", other}, kNow), "get_status"),
              HasSubstr("no entry among the server's tokens, or it was revoked"));

  const auto before = gate.generation();
  gate.refresh(kNow + 10s);
  EXPECT_NE(gate.generation(), before) << "it has ended, and sessions look again";
  const auto ended = gate.generation();
  change_tokens(file_, [](TokenFile& file) { EXPECT_TRUE(file.remove("relay")); });
  gate.refresh(kNow + 11s);
  EXPECT_NE(gate.generation(), ended);
  EXPECT_FALSE(gate.who({false, "", digest}, kNow).role);
}

TEST(Gate, WithoutTokensACertificateIsNobodys) {
  const std::string digest(64, 'c');
  for (const char* control : {"", "secret"}) {
    const Gate gate({control, {}, {}});
    EXPECT_EQ(gate.who({false, "", digest}, kNow).role, access::OBSERVER);
    EXPECT_TRUE(why_not(gate.who({false, "", digest}, kNow), "set.controls"));
    EXPECT_FALSE(gate.knows({false, "", digest}, kNow));
  }
}

class GateOfUsers : public testing::Test {
 protected:
  GateOfUsers() {
    change_users(file_, [](UserFile& file) {
      file.add({"Anna", access::INSTRUCTOR, "", kHash});
      file.add({"Tom", access::TRAINEE, "Frida", kOther});
    });
  }
  ~GateOfUsers() override { std::filesystem::remove_all(folder_); }
  Gate gate() { return Gate({"control", {}, file_}); }

  // Hashes are of a form that is read, and not tried here.
  static constexpr const char* kHash =
      "$argon2id$v=19$m=8,t=1,p=1$c29tZXNhbHQ$Zmlyc3RmaXJzdGZpcnN0";
  static constexpr const char* kOther =
      "$argon2id$v=19$m=8,t=1,p=1$c29tZXNhbHQ$c2Vjb25kc2Vjb25kc2Vj";
  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-gate-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "users.yaml";
};

TEST_F(GateOfUsers, WhoSignsInIsSheFromEverywhere) {
  Gate gate = this->gate();
  EXPECT_FALSE(gate.who(false, "", kNow).role);
  EXPECT_THAT(*why_not(gate.who(false, "", kNow), "get_status"), HasSubstr("sign in"));
  EXPECT_EQ(gate.who(true, "", kNow).role, access::ADMIN);
  EXPECT_EQ(gate.hash_of("Anna"), kHash);
  const auto made = gate.sign_in("Tom", kOther, kNow);
  ASSERT_TRUE(made);
  for (const bool from_here : {false, true}) {
    const Who who = gate.who(from_here, made->token, kNow);
    EXPECT_EQ(who.role, access::TRAINEE);
    EXPECT_EQ(who.ship, "Frida");
    EXPECT_EQ(who.name, "Tom");
  }
  EXPECT_EQ(made->ends, kNow + Gate::kSignedIn);
  EXPECT_EQ(gate.end_of(made->token, kNow), made->ends);
  EXPECT_FALSE(gate.end_of("another", kNow));
}

TEST_F(GateOfUsers, ANameThatNobodyHasIsTriedAsLong) {
  const Gate gate = this->gate();
  EXPECT_FALSE(gate.has_user("Eve"));
  EXPECT_FALSE(why_no_hash(gate.hash_of("Eve")));
  EXPECT_THAT(gate.hash_of("Eve"), HasSubstr("m=19456,t=2,p=1")) << "as `skerry user` makes them";
  EXPECT_FALSE(is_password(gate.hash_of("Eve"), ""));
}

TEST_F(GateOfUsers, AHashThatIsNoMoreHersSignsNobodyIn) {
  Gate gate = this->gate();
  EXPECT_FALSE(gate.sign_in("Anna", kOther, kNow));
  EXPECT_FALSE(gate.sign_in("Eve", gate.hash_of("Eve"), kNow));
}

TEST_F(GateOfUsers, ASessionEndsToTheSecondAndWhenSheSignsOut) {
  Gate gate = this->gate();
  const auto first = gate.sign_in("Anna", kHash, kNow), second = gate.sign_in("Anna", kHash, kNow);
  ASSERT_NE(first->token, second->token);
  const auto before = gate.generation();
  EXPECT_TRUE(gate.sign_out(second->token));
  EXPECT_FALSE(gate.sign_out(second->token));
  EXPECT_FALSE(gate.sign_out(""));
  EXPECT_NE(gate.generation(), before) << "sessions look again";
  EXPECT_FALSE(gate.who(false, second->token, kNow).role);
  EXPECT_TRUE(gate.who(false, first->token, first->ends - 1ms).role);
  EXPECT_FALSE(gate.who(false, first->token, first->ends).role);
  const auto later = gate.generation();
  gate.refresh(first->ends);
  EXPECT_NE(gate.generation(), later);
}

TEST_F(GateOfUsers, AnotherPasswordOrNoEntryEndsHerSessions) {
  Gate gate = this->gate();
  const auto anna = gate.sign_in("Anna", kHash, kNow), tom = gate.sign_in("Tom", kOther, kNow);
  change_users(file_, [](UserFile& file) {
    file.set_password("Anna", kOther);
    file.remove("Tom");
  });
  EXPECT_FALSE(gate.refresh(kNow + 1s));
  EXPECT_FALSE(gate.who(false, anna->token, kNow + 1s).role);
  EXPECT_FALSE(gate.who(false, tom->token, kNow + 1s).role);
}

TEST_F(GateOfUsers, ADamagedFileIsToldOnceAndWhoIsSignedInStays) {
  Gate gate = this->gate();
  const auto anna = gate.sign_in("Anna", kHash, kNow);
  std::ofstream(file_) << "users:\n  - name: Anna\n    password: 12\n";
  const auto wrong = gate.refresh(kNow);
  ASSERT_TRUE(wrong);
  EXPECT_THAT(*wrong, HasSubstr("users.yaml:3"));
  EXPECT_FALSE(gate.refresh(kNow + 1s)) << "told once";
  EXPECT_TRUE(gate.who(false, anna->token, kNow + 1s).role);
}

TEST_F(GateOfUsers, OfTooManySessionsOfOneUserTheOldestEnds) {
  Gate gate = this->gate();
  const auto tom = gate.sign_in("Tom", kOther, kNow);
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i <= Gate::kMostOfUser; ++i) {
    tokens.push_back(gate.sign_in("Anna", kHash, kNow + std::chrono::seconds(i))->token);
  }
  EXPECT_FALSE(gate.who(false, tokens.front(), kNow).role);
  for (std::size_t i = 1; i < tokens.size(); ++i)
    EXPECT_TRUE(gate.who(false, tokens[i], kNow).role);
  EXPECT_TRUE(gate.who(false, tom->token, kNow).role) << "others' stay";
}

}  // namespace
}  // namespace skerry::server
