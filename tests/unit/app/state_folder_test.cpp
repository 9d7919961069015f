#include "server/app/options/state_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "server/app/options/options.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class StateFolder : public testing::Test {
 protected:
  ~StateFolder() override { fs::remove_all(folder_); }
  Options options_of(std::vector<std::string> arguments) const {
    std::vector<const char*> all{"skerryd", "--state", folder_.c_str()};
    for (const std::string& argument : arguments) all.push_back(argument.c_str());
    return *read_options(static_cast<int>(all.size()), all.data());
  }

  const fs::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-state-XXXXXX";
    return fs::path(::mkdtemp(pattern.data()));
  }();
};

TEST_F(StateFolder, HasAPlaceForAllThatIsKept) {
  const Options empty = options_of({});
  EXPECT_EQ(empty.audit, folder_ / "audit.jsonl");
  EXPECT_EQ(empty.recorder.folder, folder_ / "recordings");
  EXPECT_EQ(empty.net.setups, folder_ / "setups");
  EXPECT_EQ(empty.net.tokens, "") << "without its file nobody needs a token";
  EXPECT_EQ(empty.net.users, "");
  EXPECT_EQ(empty.audit_roll_bytes, 0u);
  EXPECT_EQ(options_of({"--audit-roll-mib", "5"}).audit_roll_bytes, 5u << 20);
  std::ofstream(folder_ / "tokens.yaml") << "tokens: []\n";
  std::ofstream(folder_ / "users.yaml") << "users: []\n";
  const Options full = options_of({});
  EXPECT_EQ(full.net.tokens, folder_ / "tokens.yaml");
  EXPECT_EQ(full.net.users, folder_ / "users.yaml");
}

TEST_F(StateFolder, GivesWayToWhatIsSaidOfEach) {
  const Options options = options_of(
      {"--audit", "a", "--record-folder", "r", "--setups", "s", "--tokens", "t", "--users", "u"});
  EXPECT_EQ(options.audit, "a");
  EXPECT_EQ(options.recorder.folder, "r");
  EXPECT_EQ(options.net.setups, "s");
  EXPECT_EQ(options.net.tokens, "t");
  EXPECT_EQ(options.net.users, "u");
}

TEST_F(StateFolder, IsMadeForItsUserAndGroupAlone) {
  const fs::path made = folder_ / "var" / "skerry";
  make_state_folder(made.string());
  EXPECT_TRUE(fs::is_directory(made));
  EXPECT_EQ(fs::status(made).permissions() & fs::perms::others_all, fs::perms::none);
  fs::permissions(made, fs::perms::all);
  make_state_folder(made.string());
  EXPECT_EQ(fs::status(made).permissions(), fs::perms::all) << "one that is there stays as it is";
  make_state_folder("");
  const fs::path file = folder_ / "file";
  std::ofstream(file) << "x";
  for (const fs::path& wrong : {file, file / "below"}) {
    try {
      make_state_folder(wrong.string());
      FAIL() << wrong;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("--state: " + wrong.string()));
    }
  }
}

}  // namespace
}  // namespace skerry::server
