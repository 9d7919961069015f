// "A server that is killed loses at most the last second of its recording": in every way to record,
// whether the radar is busy or sends nothing.
//
// SKERRY_KILLS=1000 for as many kills; each way once without.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "protocol/recording/repair.hpp"
#include "tests/system/child_process.hpp"
#include "tests/system/sudden_death_kit.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::system_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Words of recorder_child.  To a recorder a paused exercise is one that is given nothing, be its
// radars at work or in standby.
const std::vector<std::vector<std::string>> kWays = {
    {"calm"},
    {"quiet"},
    {"calm", "exercise"},
    {"quiet", "exercise"},
    {"calm", "inputs"},
    {"quiet", "inputs"},
    {"calm", "one"},
    {"quiet", "one", "exercise"},
    {"calm", "all-views"},
    {"calm", "compact", "zstd"},
    {"quiet", "compact", "none", "exercise"},
    {"calm", "none"},
    {"calm", "roll-size", "exercise"},
    {"calm", "roll-time"},
    {"quiet", "roll-time", "inputs"},
    {"quiet", "roll-time", "zstd"},
};
constexpr std::size_t kAtOnce = 8;

struct Victim {
  Victim(const std::string& in, const std::vector<std::string>& words)
      : folder((std::filesystem::create_directory(in), in)), tale(in + "/tale") {
    std::vector<std::string> arguments{RECORDER_CHILD_PROGRAM, folder, tale.path(), "a"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    child = std::make_unique<ChildProcess>(std::move(arguments));
    EXPECT_EQ(child->read_line(), "recording");
  }
  void kill() {
    killed = steady_clock::now();
    child->signal(SIGKILL);
    child->wait();
  }
  std::vector<std::string> files() const {
    std::vector<std::string> paths{folder + "/a.mcap"};
    for (int i = 2;; ++i) {
      const std::string next = fmt::format("{}/a-{:03}.mcap", folder, i);
      if (!std::filesystem::exists(next)) return paths;
      paths.push_back(next);
    }
  }

  std::string folder;
  Tale tale;
  std::unique_ptr<ChildProcess> child;
  steady_clock::time_point killed;
};

// Spokes up to a second before, or at least that they did not come.
void check(const Victim& victim, bool has_spokes) {
  const Found found = check_bytes(victim.files(), victim.tale.begin());
  if (has_spokes) {
    EXPECT_GE(found.next, victim.tale.published(victim.killed - kMostLost));
    EXPECT_EQ(found.missing, found.told);
  } else {
    EXPECT_LE(Duration(victim.killed - found.reached).count(), kMostLost.count());
  }
  const std::string last = victim.files().back(), whole = last + ".repaired";
  EXPECT_TRUE(recording::repair(last, whole).ok());
  EXPECT_TRUE(server::recorded(whole).is_whole);
}

TEST(SuddenDeathInEveryWay, TakesNoMoreThanTheLastSecond) {
  std::mt19937 random(20261128);
  const std::size_t rounds =
      std::max<std::size_t>(1, static_cast<std::size_t>(kills()) / kWays.size());
  std::size_t killed = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t from = 0; from < kWays.size(); from += kAtOnce) {
      const server::ScratchFolder folder;
      std::vector<std::unique_ptr<Victim>> victims;
      for (std::size_t i = from; i < std::min(from + kAtOnce, kWays.size()); ++i) {
        victims.push_back(std::make_unique<Victim>(folder.path(std::to_string(i)), kWays[i]));
      }
      std::this_thread::sleep_for(
          milliseconds(std::uniform_int_distribution<int>(1200, 2200)(random)));
      for (const auto& victim : victims) victim->kill();
      for (std::size_t i = 0; i < victims.size(); ++i) {
        const std::vector<std::string>& words = kWays[from + i];
        SCOPED_TRACE(fmt::format("round {}: {}", round, fmt::join(words, " ")));
        const bool has_spokes = words.front() == "calm" &&
                                std::find(words.begin(), words.end(), "inputs") == words.end();
        check(*victims[i], has_spokes);
        ++killed;
      }
    }
  }
  fmt::print("{} kills in {} ways\n", killed, kWays.size());
}

}  // namespace
}  // namespace skerry::system_test
