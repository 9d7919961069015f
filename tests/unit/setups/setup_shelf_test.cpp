// Set-ups of consoles on the server: what is kept, what is refused, and what the folder has after
// it.
#include "server/setups/setup_shelf.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <array>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

std::string setup(const std::string& name, const std::string& parts = "{}") {
  return fmt::format(R"({{"kind": "skerry set-up", "version": 1, "name": "{}", "parts": {}}})",
                     name, parts);
}

// The tasks of the shelf's thread, which is the test's.
class Loop {
 public:
  void post(SetupShelf::Task task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    come_.notify_one();
  }
  // As post(), and comes back once the task is run.
  void post_and_wait(SetupShelf::Task task) {
    post(std::move(task));
    std::unique_lock lock(mutex_);
    run_.wait(lock, [this] { return tasks_.empty() && !runs_; });
  }
  void run_one() {
    std::unique_lock lock(mutex_);
    come_.wait(lock, [this] { return !tasks_.empty(); });
    SetupShelf::Task task = std::move(tasks_.front());
    tasks_.pop_front();
    runs_ = true;
    lock.unlock();
    std::exchange(task, {})();
    lock.lock();
    runs_ = false;
    run_.notify_one();
  }

 private:
  std::mutex mutex_;
  std::condition_variable come_, run_;
  bool runs_ = false;
  std::deque<SetupShelf::Task> tasks_;
};

class Setups : public testing::Test {
 protected:
  ~Setups() override { fs::remove_all(folder_); }

  SetupShelf::Config config() {
    return {folder_ / "setups", [this](SetupShelf::Task task) { loop_.post(std::move(task)); }};
  }
  SetupShelf::Outcome keep(SetupShelf& shelf, const std::string& name, const std::string& text) {
    std::optional<SetupShelf::Outcome> outcome;
    shelf.keep(name, text, [&](SetupShelf::Outcome what) { outcome = std::move(what); });
    if (!outcome) loop_.run_one();
    return outcome.value();
  }
  SetupShelf::Outcome remove(SetupShelf& shelf, const std::string& name) {
    std::optional<SetupShelf::Outcome> outcome;
    shelf.remove(name, [&](SetupShelf::Outcome what) { outcome = std::move(what); });
    if (!outcome) loop_.run_one();
    return outcome.value();
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(folder_ / "setups"))
      all.push_back(entry.path());
    return all;
  }

  fs::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-setups-XXXXXX";
    return fs::path(::mkdtemp(pattern.data()));
  }();
  Loop loop_;
};

TEST_F(Setups, AreKeptReplacedDeletedAndThereAfterARestart) {
  const std::string name = "Hafen bei Nacht \xc3\xa4/..\xe2\x98\x83 <b>";
  const std::string second = setup(name, R"({"picture": {"palette": "night"}})");
  {
    SetupShelf shelf(config());
    EXPECT_EQ(shelf.list(), "[]");
    EXPECT_EQ(keep(shelf, name, setup(name)).status, 204u);
    EXPECT_EQ(keep(shelf, "day", setup("day")).status, 204u);
    EXPECT_EQ(keep(shelf, name, second).status, 204u);
    EXPECT_EQ(files().size(), 2u) << "one of each name, and nothing beside";
    EXPECT_THAT(shelf.list(), HasSubstr(R"("name":"day")"));
  }
  SetupShelf shelf(config());
  ASSERT_NE(shelf.find(name), nullptr);
  EXPECT_EQ(*shelf.find(name), second);
  EXPECT_EQ(remove(shelf, name).status, 204u);
  EXPECT_EQ(shelf.find(name), nullptr);
  EXPECT_EQ(remove(shelf, name).status, 404u);
  EXPECT_EQ(files().size(), 1u);
}

TEST_F(Setups, WhatIsNoneIsRefusedAndSaysWhy) {
  SetupShelf shelf(config());
  const std::vector<std::array<std::string, 3>> wrong = {
      {"a", "", "not a JSON object"},
      {"a", "[1]", "not a JSON object"},
      {"a", "{\"kind\": \"skerry set-up\", ", "not a JSON object"},
      {"a", R"({"kind": "photo", "name": "a", "parts": {}})", "\"kind\" is to be"},
      {"a", setup("b"), "not that of its path"},
      {"a", setup("a", "3"), "\"parts\" are to be an object"},
      {"", setup(""), "1 to 240 bytes"},
      {"a\nb", setup("a\\nb"), "1 to 240 bytes"},
      {"\xff", setup("\xff"), "1 to 240 bytes"},
      {std::string(241, 'a'), setup(std::string(241, 'a')), "1 to 240 bytes"},
      {"a", setup("a", std::string(200, '[') + std::string(200, ']')), "no set-up"}};
  for (const auto& [name, document, why] : wrong) {
    const SetupShelf::Outcome outcome = keep(shelf, name, document);
    EXPECT_EQ(outcome.status, 400u) << document;
    EXPECT_THAT(outcome.text, HasSubstr(why)) << document;
  }
  const std::string longest =
      setup("a", "{\"x\": \"" + std::string(SetupShelf::kMostBytes, 'x') + "\"}");
  EXPECT_EQ(keep(shelf, "a", longest).status, 413u);
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Setups, AreAtMostSoMany) {
  SetupShelf shelf(config());
  for (std::size_t i = 0; i < SetupShelf::kMost; ++i) {
    const std::string name = fmt::format("set-up {}", i);
    ASSERT_EQ(keep(shelf, name, setup(name)).status, 204u) << i;
  }
  EXPECT_EQ(keep(shelf, "one more", setup("one more")).status, 507u);
  EXPECT_EQ(keep(shelf, "set-up 7", setup("set-up 7")).status, 204u) << "one that is there";
  ASSERT_EQ(remove(shelf, "set-up 7").status, 204u);
  EXPECT_EQ(keep(shelf, "one more", setup("one more")).status, 204u);
}

TEST_F(Setups, ThatWaitForTheDiskAreAtMostSoMany) {
  SetupShelf shelf(config());
  std::size_t kept = 0, refused = 0;
  for (std::size_t i = 0; i < SetupShelf::kMostWaiting + 3; ++i) {
    shelf.keep("a", setup("a"), [&](const SetupShelf::Outcome& outcome) {
      kept += outcome.status == 204;
      refused += outcome.status == 503;
    });
  }
  EXPECT_EQ(refused, 3u);
  for (std::size_t i = 0; i < SetupShelf::kMostWaiting; ++i) loop_.run_one();
  EXPECT_EQ(kept, SetupShelf::kMostWaiting);
}

// What waits for an answer may hold a connection, which only its own thread may end.
TEST_F(Setups, WhatWaitsForAnAnswerEndsOnTheShelfsThread) {
  SetupShelf shelf({folder_ / "setups",
                    [this](SetupShelf::Task task) { loop_.post_and_wait(std::move(task)); }});
  std::thread::id ended_on;
  {
    const std::shared_ptr<int> waits(new int(0), [&](const int* gone) {
      delete gone;
      ended_on = std::this_thread::get_id();
    });
    shelf.keep("a", setup("a"), [waits](const SetupShelf::Outcome&) { ++*waits; });
  }
  loop_.run_one();
  EXPECT_EQ(ended_on, std::this_thread::get_id());
}

TEST_F(Setups, FilesThatAreNoneAreLeftAlone) {
  fs::create_directories(folder_ / "setups");
  const auto put = [&](const char* file, const std::string& text) {
    std::ofstream(folder_ / "setups" / file) << text;
  };
  put("by-hand.json", setup("by hand"));
  put("again.json", setup("by hand"));
  put("broken.json", "{");
  put("long.json", setup("long", "{\"x\": \"" + std::string(SetupShelf::kMostBytes, 'x') + "\"}"));
  put("readme.txt", setup("text"));
  SetupShelf shelf(config());
  EXPECT_NE(shelf.find("by hand"), nullptr);
  EXPECT_EQ(shelf.find("long"), nullptr);
  EXPECT_EQ(shelf.find("text"), nullptr);
  EXPECT_EQ(files().size(), 5u);
}

TEST_F(Setups, AFolderThatIsNoneIsRefusedByName) {
  std::ofstream(folder_ / "setups") << "a file";
  try {
    SetupShelf shelf(config());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("--setups: " + (folder_ / "setups").string()));
  }
}

// A file may have no more than 16 bytes, as on a full disk: nothing of it is left behind.
TEST_F(Setups, ADiskWithoutRoomKeepsTheOneBeforeWhole) {
  SetupShelf shelf(config());
  const std::string first = setup("a");
  ASSERT_EQ(keep(shelf, "a", first).status, 204u);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{16, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const SetupShelf::Outcome outcome = keep(shelf, "a", setup("a", R"({"x": {}})"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(outcome.status, 507u);
  EXPECT_THAT(outcome.text, HasSubstr("cannot write"));
  ASSERT_EQ(files().size(), 1u);
  std::ifstream stream(files().front());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), first);
}

// The folder has gone: what was kept before stands, and the console is told.
TEST_F(Setups, ADiskThatTakesNothingIsSaidAndTheOneBeforeStands) {
  SetupShelf shelf(config());
  const std::string first = setup("a");
  ASSERT_EQ(keep(shelf, "a", first).status, 204u);
  fs::remove_all(folder_ / "setups");
  const SetupShelf::Outcome outcome = keep(shelf, "a", setup("a", R"({"x": {}})"));
  EXPECT_EQ(outcome.status, 507u);
  EXPECT_THAT(outcome.text, HasSubstr("cannot open"));
  EXPECT_EQ(*shelf.find("a"), first);
}

}  // namespace
}  // namespace skerry::server
