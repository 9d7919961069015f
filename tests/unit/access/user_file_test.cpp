#include "server/access/user_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/access/password.hpp"
#include "server/access/password_desk.hpp"
#include "server/config/config_error.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr PasswordCost kCheap{.memory_kib = 8, .passes = 1};

TEST(Password, IsKnownAgainAndNoOtherIs) {
  const std::string hash = hash_of_password("correct horse", kCheap);
  EXPECT_THAT(hash, StartsWith("$argon2id$v=19$m=8,t=1,p=1$"));
  EXPECT_TRUE(is_password(hash, "correct horse"));
  for (const char* wrong : {"", "correct hors", "correct horse ", "Correct horse"}) {
    EXPECT_FALSE(is_password(hash, wrong)) << wrong;
  }
  EXPECT_NE(hash, hash_of_password("correct horse", kCheap)) << "the salt is another";
}

TEST(Password, ByDefaultItCostsWhatOwaspAsks) {
  const std::string hash = hash_of_password("correct horse");
  EXPECT_THAT(hash, StartsWith("$argon2id$v=19$m=19456,t=2,p=1$"));
  EXPECT_TRUE(is_password(hash, "correct horse"));
}

TEST(Password, ShortLongAndUnprintableOnesAreRefused) {
  for (const std::string& wrong : {std::string(), std::string("1234567"), std::string(257, 'x'),
                                   std::string("12345678\n"), std::string("1234\0005678", 9)}) {
    EXPECT_TRUE(why_no_password(wrong)) << wrong;
    EXPECT_THROW(hash_of_password(wrong, kCheap), std::invalid_argument);
  }
  EXPECT_FALSE(why_no_password(std::string(256, 'x')));
  EXPECT_FALSE(why_no_password("\u00fc\u00e9\u4e2d\u6587"));
}

TEST(Password, AHashThatWouldCostTooMuchIsNotChecked) {
  const std::string end = "$AAAAAAAAAAAAAAAAAAAAAA$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";
  EXPECT_FALSE(why_no_hash("$argon2id$v=19$m=19456,t=2,p=1" + end));
  for (const std::string& parts : std::vector<std::string>{
           "m=4194304,t=2,p=1", "m=8,t=11,p=1", "m=8,t=1,p=5", "m=8,t=1", "m=-8,t=1,p=1",
           "m=99999999999,t=1,p=1", "t=1,m=8,p=1", "m=0,t=1,p=1", "m=8,t=0,p=1", "m=8,t=1,p=0",
           "m=16,t=1,p=4", "m=08,t=1,p=1", "m=8,t=1,p=1x", ""}) {
    EXPECT_TRUE(why_no_hash("$argon2id$v=19$" + parts + end)) << parts;
    EXPECT_FALSE(is_password("$argon2id$v=19$" + parts + end, "correct horse"));
  }
  for (const char* wrong :
       {"", "correct horse", "$2b$12$abc", "$argon2i$v=19$m=8,t=1,p=1$AA$AA",
        "$argon2id$v=19$m=8,t=1,p=1$AA", "$argon2id$v=19$m=8,t=1,p=1$AAAAAAAAAAA$AAAAAAAAAAAAAAA",
        "$argon2id$v=19$m=8,t=1,p=1$AAAAAAAAAAA$AAAAAAAAAAAAAAA\""}) {
    EXPECT_TRUE(why_no_hash(wrong)) << wrong;
  }
}

TEST(UserFile, IsReadAsItIsWritten) {
  UserFile file;
  file.add({"Anna \"A\"", access::INSTRUCTOR, "", hash_of_password("correct horse", kCheap)});
  file.add({"bridge 1", access::TRAINEE, "Frida", hash_of_password("battery staple", kCheap)});
  const UserFile read = UserFile::parse(file.text(), "users.yaml");
  EXPECT_EQ(read.users(), file.users());
  EXPECT_EQ(UserFile::parse(UserFile().text(), "users.yaml").users().size(), 0u);
}

TEST(UserFile, WhatIsWrongIsToldWithItsLine) {
  const std::string hash = hash_of_password("correct horse", kCheap);
  const std::string good = "users:\n  - name: Anna\n    password: \"" + hash + "\"\n";
  const std::vector<std::pair<std::string, std::vector<std::string>>> all = {
      {"users:\n  - name: Anna\n    password: horse\n", {"users.yaml:3", "no Argon2id hash"}},
      {"users:\n  - name: Anna\n", {"users.yaml:2", "password"}},
      {good + "  - name: Anna\n    password: \"" + hash + "\"\n", {"users.yaml:4", "earlier user"}},
      {good + "    role: captain\n", {"users.yaml:4", "captain", "instructor"}},
      {good + "    rank: 7\n", {"users.yaml:4", "rank"}},
      {"users: 7\n", {"users.yaml:1"}},
      {"users:\n  - name: [\n", {"users.yaml"}}};
  for (const auto& [text, parts] : all) {
    try {
      UserFile::parse(text, "users.yaml");
      ADD_FAILURE() << text;
    } catch (const ConfigError& error) {
      for (const std::string& part : parts) EXPECT_THAT(error.what(), HasSubstr(part)) << text;
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("horse"))) << "no password in a log";
    }
  }
}

TEST(UserFile, NamesAreOnceAndPrintable) {
  UserFile file;
  file.add({"Anna", access::OBSERVER, "", "hash"});
  EXPECT_THROW(file.add({"Anna", access::ADMIN, "", "hash"}), std::invalid_argument);
  for (const std::string& name : {std::string(), std::string(65, 'x'), std::string("a\nb")}) {
    EXPECT_THROW(file.add({name, access::OBSERVER, "", "hash"}), std::invalid_argument);
  }
  EXPECT_TRUE(file.set_password("Anna", "other"));
  EXPECT_EQ(file.find("Anna")->password, "other");
  EXPECT_FALSE(file.set_password("Tom", "other"));
  EXPECT_TRUE(file.remove("Anna"));
  EXPECT_FALSE(file.remove("Anna"));
}

// Runs what the desk posts on the test's own thread.
class Posted {
 public:
  void post(PasswordDesk::Task task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    change_.notify_one();
  }
  void run(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::unique_lock lock(mutex_);
      change_.wait(lock, [this] { return !tasks_.empty(); });
      const PasswordDesk::Task task = std::move(tasks_.front());
      tasks_.erase(tasks_.begin());
      lock.unlock();
      task();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable change_;
  std::vector<PasswordDesk::Task> tasks_;
};

TEST(PasswordDesk, AnswersInTurnOnTheCallersThread) {
  const std::string hash = hash_of_password("correct horse", kCheap);
  Posted posted;
  PasswordDesk desk([&](PasswordDesk::Task task) { posted.post(std::move(task)); });
  const auto here = std::this_thread::get_id();
  std::vector<bool> answers;
  for (const char* tried : {"correct horse", "incorrect", "correct horse"}) {
    EXPECT_TRUE(desk.try_password(hash, tried, [&](bool is_right) {
      EXPECT_EQ(std::this_thread::get_id(), here);
      answers.push_back(is_right);
    }));
  }
  posted.run(3);
  EXPECT_EQ(answers, (std::vector<bool>{true, false, true}));
}

TEST(PasswordDesk, RefusesWhenTooManyWaitAndEndsWithThem) {
  const std::string dear = hash_of_password("correct horse", {.memory_kib = 16'384, .passes = 4});
  Posted posted;
  const auto held = std::make_shared<int>(7);
  std::size_t taken = 0;
  {
    PasswordDesk desk([&](PasswordDesk::Task task) { posted.post(std::move(task)); });
    while (desk.try_password(dear, "correct horse", [held](bool) {})) {
      ++taken;
      ASSERT_LT(taken, 1'000u);
    }
  }
  EXPECT_GE(taken, PasswordDesk::kMostWaiting);
}

}  // namespace
}  // namespace skerry::server
