// The log of changes: every change is told or counted, and nobody can flood it.
#include "server/app/control/change_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/unit/net/kept_audit.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class Log : public testing::Test {
 protected:
  void change(int from, int to, const std::string& control = "gain",
              const std::string& origin = "a") {
    log_.add(origin, "radar 0 view 0", {control, std::to_string(from), std::to_string(to)}, now_);
  }
  // Told or counted, by the lines.
  std::uint64_t changes_told() const {
    std::uint64_t sum = 0;
    for (const std::string& line : lines_) {
      const std::size_t bracket = line.rfind('(');
      if (line.find(" more changes") != std::string::npos) {
        sum += std::strtoull(line.c_str(), nullptr, 10);
      } else {
        sum += bracket == std::string::npos
                   ? 1
                   : std::strtoull(line.c_str() + bracket + 1, nullptr, 10);
      }
    }
    return sum;
  }

  std::vector<std::string> lines_;
  ChangeLog log_{[this](const std::string& line) { lines_.push_back(line); }};
  ChangeLog::Clock::time_point now_{1h};
};

TEST_F(Log, AKnobThatIsTurnedIsToldAtOnceAndThenOnceASecond) {
  for (int i = 0; i < 25; ++i, now_ += 100ms) change(i, i + 1);
  now_ += 1s;
  log_.flush(now_);
  EXPECT_THAT(lines_, ElementsAre("a: radar 0 view 0: gain 0 -> 1",
                                  "a: radar 0 view 0: gain 1 -> 10 (9 changes)",
                                  "a: radar 0 view 0: gain 10 -> 20 (10 changes)",
                                  "a: radar 0 view 0: gain 20 -> 25 (5 changes)"));
  EXPECT_TRUE(log_.waits());
  now_ += 1s;
  log_.flush(now_);
  EXPECT_FALSE(log_.waits());
  EXPECT_EQ(lines_.size(), 4u);
}

TEST_F(Log, OtherControlsAndOriginsDoNotWaitForEachOther) {
  change(1, 2);
  change(1, 2, "sea");
  change(2, 3, "gain", "b");
  EXPECT_THAT(lines_, ElementsAre("a: radar 0 view 0: gain 1 -> 2", "a: radar 0 view 0: sea 1 -> 2",
                                  "b: radar 0 view 0: gain 2 -> 3"));
}

// The audit has what the log has no room for, too.
TEST_F(Log, TheAuditHasEveryChangeWithWhatWasBefore) {
  KeptAudit audit;
  log_.set_audit(&audit);
  for (int i = 0; i < 3000; ++i) {
    change(i, i + 1, "gain", "sender " + std::to_string(i % 1000));
    now_ += 100us;
  }
  log_.flush_all();
  std::uint64_t told = 0;
  for (const AuditEntry& entry : audit.entries()) told += entry.times;
  EXPECT_EQ(told, 3000u);
  EXPECT_LT(lines_.size(), 1000u) << "the log has less";
  const AuditEntry first = audit.entries().front();
  EXPECT_EQ(first.kind, AuditEntry::Kind::change);
  EXPECT_EQ(first.from, "sender 0");
  EXPECT_EQ(first.what, "radar 0 view 0: gain");
  EXPECT_EQ(first.before, "0");
  EXPECT_EQ(first.after, "1");
}

// What two people change through one client within a second is told of each.
TEST_F(Log, WhoChangedItIsWhoWasThereThen) {
  KeptAudit audit;
  log_.set_audit(&audit);
  const auto by = [&](const char* who, int to) {
    const AuditedRequest request(&audit, "a", who);
    change(to - 1, to);
  };
  by("Anna", 1);
  by("Anna", 2);
  by("Ben", 3);
  by("Anna", 4);
  log_.flush_all();
  std::vector<std::string> told;
  for (const AuditEntry& e : audit.entries()) {
    told.push_back(e.who + " " + e.before + " " + e.after + " " + std::to_string(e.times));
  }
  EXPECT_THAT(told, ElementsAre("Anna 0 1 1", "Ben 2 3 1", "Anna 1 4 2"));
}

TEST_F(Log, AFloodIsBoundedAndEveryChangeCounted) {
  std::uint64_t made = 0;
  for (int i = 0; i < 60'000; ++i) {  // a minute of a thousand a second
    change(i, i + 1, "gain", "sender " + std::to_string(i % 5000));
    ++made;
    now_ += 1ms;
  }
  EXPECT_LE(lines_.size(), ChangeLog::kMostLines + 60u * 5u + 1u);
  EXPECT_GE(lines_.size(), 100u);
  log_.flush_all();
  EXPECT_EQ(changes_told(), made);
  EXPECT_FALSE(log_.waits());
}

}  // namespace
}  // namespace skerry::server
