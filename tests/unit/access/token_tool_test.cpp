#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "server/access/token_file.hpp"
#include "server/access_tool/token_command.hpp"
#include "tests/unit/access/run_tool.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::StartsWith;

class TokenTool : public testing::Test {
 protected:
  ~TokenTool() override { std::filesystem::remove_all(folder_); }

  Ran run(std::vector<std::string> arguments) {
    if (arguments.front() != "rights") {
      arguments.insert(arguments.end(), {"--tokens", file_.string()});
    }
    return run_tool(make_token_commands, std::move(arguments));
  }
  UtcTime now() const { return std::chrono::system_clock::now(); }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-token-tool-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "tokens.yaml";
};

TEST_F(TokenTool, MakesListsAndRevokes) {
  const Ran made = run({"new", "bridge 1", "--role", "trainee", "--ship", "Frida", "--for", "8h"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, StartsWith("skerry_"));
  const std::string token = made.out.substr(0, made.out.find('\n'));
  const TokenFile file = TokenFile::read(file_);
  const auto found = file.find(token, now());
  ASSERT_EQ(found.state, TokenState::good);
  EXPECT_EQ(found.token->role, access::TRAINEE);
  EXPECT_EQ(found.token->ship, "Frida");
  EXPECT_EQ(file.find(token, now() + 8h + 1min).state, TokenState::ended);
  EXPECT_EQ(file.find(token, now() + 8h - 1min).state, TokenState::good);
  EXPECT_EQ(file.text().find(token), std::string::npos) << "the file must not have the token";

  const Ran listed = run({"list"});
  EXPECT_THAT(listed.out, HasSubstr("bridge 1"));
  EXPECT_THAT(listed.out, HasSubstr("trainee"));
  EXPECT_EQ(listed.out.find(token), std::string::npos);

  EXPECT_EQ(run({"revoke", "bridge 2"}).code, echo::kExitFailure);
  EXPECT_EQ(run({"revoke", "bridge 1"}).code, 0);
  EXPECT_TRUE(TokenFile::read(file_).tokens().empty());
}

TEST_F(TokenTool, SaysWhatIsWrong) {
  EXPECT_EQ(run({"new", "a", "--role", "king"}).code, echo::kExitUsage);
  EXPECT_EQ(run({"new", "a", "--for", "8"}).code, echo::kExitUsage) << "of what?";
  EXPECT_EQ(run({"new", "a", "--for", "0h"}).code, echo::kExitUsage);
  EXPECT_EQ(run({"new"}).code, echo::kExitUsage);
  EXPECT_EQ(run({"list"}).code, echo::kExitFailure) << "there is no file yet";
  EXPECT_EQ(run({"revoke", "a"}).code, echo::kExitFailure);
  EXPECT_FALSE(std::filesystem::exists(file_)) << "and none was made";
  EXPECT_EQ(run({"new", "a"}).code, 0);
  const Ran again = run({"new", "a"});
  EXPECT_EQ(again.code, echo::kExitFailure);
  EXPECT_THAT(again.err, HasSubstr("revoke it"));
  EXPECT_THAT(again.out, testing::IsEmpty()) << "a token that is not kept must not be shown";
}

TEST_F(TokenTool, PrintsTheRights) { EXPECT_THAT(run({"rights"}).out, HasSubstr("set.world")); }

}  // namespace
}  // namespace skerry::server
