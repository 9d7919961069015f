#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "server/access/password.hpp"
#include "server/access/user_file.hpp"
#include "server/access_tool/user_command.hpp"
#include "tests/unit/access/run_tool.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

class UserTool : public testing::Test {
 protected:
  ~UserTool() override { std::filesystem::remove_all(folder_); }

  // With that as its standard input.
  Ran run(std::vector<std::string> arguments, const std::string& input = {}) {
    arguments.insert(arguments.end(), {"--users", file_.string()});
    const std::string typed = (folder_ / "typed").string();
    std::ofstream(typed) << input;
    const int before = ::dup(STDIN_FILENO), piped = ::open(typed.c_str(), O_RDONLY | O_CLOEXEC);
    ::dup2(piped, STDIN_FILENO);
    ::close(piped);
    std::clearerr(stdin);
    std::cin.clear();
    const Ran ran = run_tool(make_user_commands, std::move(arguments));
    ::dup2(before, STDIN_FILENO);
    ::close(before);
    return ran;
  }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-user-tool-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "users.yaml";
};

TEST_F(UserTool, AddsListsChangesAndRemoves) {
  const Ran added =
      run({"add", "bridge 1", "--role", "trainee", "--ship", "Frida"}, "correct horse\n");
  ASSERT_EQ(added.code, 0) << added.err;
  const auto hash = [&] { return UserFile::read(file_).find("bridge 1")->password; };
  EXPECT_TRUE(is_password(hash(), "correct horse"));
  EXPECT_EQ(std::filesystem::status(file_).permissions() & std::filesystem::perms::all,
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const Ran listed = run({"list"});
  EXPECT_THAT(listed.out,
              testing::AllOf(HasSubstr("bridge 1"), HasSubstr("trainee"), HasSubstr("Frida")));
  EXPECT_THAT(listed.out, testing::Not(HasSubstr("argon2")));
  EXPECT_EQ(run({"passwd", "bridge 1"}, "battery staple\n").code, 0);
  EXPECT_TRUE(is_password(hash(), "battery staple"));
  EXPECT_EQ(run({"remove", "bridge 1"}).code, 0);
  EXPECT_EQ(UserFile::read(file_).users().size(), 0u);
}

TEST_F(UserTool, WhatIsWrongIsSaidAndChangesNothing) {
  ASSERT_EQ(run({"add", "Anna"}, "correct horse").code, 0) << "without an end of line, too";
  const std::string before = UserFile::read(file_).text();
  EXPECT_THAT(run({"add", "Anna"}, "another one").err, HasSubstr("there is a user 'Anna'"));
  EXPECT_THAT(run({"add", "Tom"}, "short\n").err, HasSubstr("8 to 256 bytes"));
  EXPECT_THAT(run({"add", "Tom"}).err, HasSubstr("no password was given"));
  EXPECT_EQ(run({"add", "Tom", "--role", "captain"}, "correct horse").code, echo::kExitUsage);
  EXPECT_THAT(run({"passwd", "Tom"}, "correct horse").err, HasSubstr("has no user 'Tom'"));
  EXPECT_THAT(run({"remove", "Tom"}).err, HasSubstr("has no user 'Tom'"));
  EXPECT_EQ(UserFile::read(file_).text(), before);
}

TEST_F(UserTool, WithoutAFileThereIsNothingToListOrRemove) {
  EXPECT_EQ(run({"list"}).code, 1);
  EXPECT_THAT(run({"remove", "Anna"}).err, HasSubstr(file_.string()));
}

}  // namespace
}  // namespace skerry::server
