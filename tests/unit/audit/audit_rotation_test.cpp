// An audit over several files: moved away by hand, or by their size.
#include <algorithm>

#include "tests/unit/audit/audit_log_kit.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class AuditRotation : public AuditLogFile {};

// Moved away, then told: another file at the old place goes on from it.
TEST_F(AuditRotation, GoesOnInANewFileThatNamesTheEndOfTheOld) {
  const fs::path old = folder_ / "audit.jsonl.1";
  {
    AuditLog log(file_);
    for (int i = 0; i < 5; ++i) log.add(change(i));
    while (log.head().n < 5) std::this_thread::yield();
    fs::rename(file_, old);
    log.add(change(5));
    while (log.head().n < 6) std::this_thread::yield();
    log.reopen();
    while (log.head().n < 7) std::this_thread::yield();
    log.add(change(6));
  }
  { AuditLog(file_).add(change(7)); }
  const AuditCheck first = check_audit(old);
  EXPECT_EQ(first.entries, 6u) << "what came before it was told";
  std::vector<std::string> whats;
  const AuditCheck second = check_audit(
      file_, {}, [&](const audit::Entry& entry) { whats.push_back(entry.what()); }, first.head);
  EXPECT_EQ(second.wrong_line, 0u) << second.wrong;
  EXPECT_EQ(second.follows, first.head);
  EXPECT_EQ(second.head.n, 9u) << "the next run goes on";
  ASSERT_EQ(whats.size(), 3u);
  EXPECT_EQ(whats[0], "a new file goes on from entry 6, head " + first.head.chain);
}

TEST_F(AuditRotation, AFileThatIsInPlaceOrInTheWayLosesNothing) {
  const fs::path old = folder_ / "audit.jsonl.1";
  {
    AuditLog log(file_);
    log.add(change(0));
    log.reopen();
    log.add(change(1));
    while (log.head().n < 2) std::this_thread::yield();
    fs::rename(file_, old);
    std::ofstream(file_) << "in the way\n";
    log.reopen();
    while (log.head().n < 3) std::this_thread::yield();
    log.add(change(2));
  }
  EXPECT_EQ(text(), "in the way\n");
  file_ = old;
  const auto all = entries();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_THAT(all[2].what(), HasSubstr("no new file: --audit: "));
  EXPECT_THAT(all[2].what(), HasSubstr("is not empty; move it away"));
}

// What waits because the disk is full goes to the next file, which may be on another.
TEST_F(AuditRotation, WhatWaitsIsInTheNextFile) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const fs::path old = folder_ / "audit.jsonl.1";
  {
    AuditLog log(file_);
    log.add(change(0));
    while (log.head().n < 1) std::this_thread::yield();
    const rlimit none{fs::file_size(file_), before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
    log.add(change(1));
    await(log, 2);
    fs::rename(file_, old);
    log.reopen();
    await(log, 3);
    ::setrlimit(RLIMIT_FSIZE, &before);
    while (log.head().n < 3) std::this_thread::yield();
  }
  std::signal(SIGXFSZ, handler);
  const AuditCheck first = check_audit(old);
  EXPECT_EQ(first.entries, 1u);
  const AuditCheck second = check_audit(file_, {}, {}, first.head);
  EXPECT_EQ(second.wrong_line, 0u) << second.wrong;
  EXPECT_EQ(second.head.n, 3u);
}

// By its size, and its name says which entries it has.
TEST_F(AuditRotation, ALargeFileIsMovedAwayAndTheNextGoesOn) {
  constexpr std::uint64_t kRoll = 2000;
  {
    AuditLog log(file_, kRoll);
    for (std::uint32_t i = 0; i < 60; ++i) {
      log.add(change(static_cast<int>(i)));
      if (i % 5 == 4) {
        while (log.ask({}).unwritten > 0) std::this_thread::yield();
      }
    }
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder_)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::rotate(files.begin(), files.begin() + 1, files.end());  // the present one is the last
  ASSERT_GE(files.size(), 4u);
  AuditHead head;
  std::uint64_t changes = 0;
  for (const fs::path& file : files) {
    const AuditCheck check = check_audit(
        file, {}, [&](const audit::Entry& entry) { changes += entry.kind() == "change"; }, head);
    ASSERT_EQ(check.wrong_line, 0u) << file << ": " << check.wrong;
    head = check.head;
    if (file != file_) {
      EXPECT_EQ(file, file_.string() + fmt::format(".{:010}", head.n));
      EXPECT_GE(fs::file_size(file), kRoll);
      EXPECT_LT(fs::file_size(file), 10 * kRoll);
    }
  }
  EXPECT_EQ(changes, 60u);
}

// As of a server that was killed between the move and the first entry of the next file.
TEST_F(AuditRotation, ANewRunGoesOnFromWhatWasMovedAwayLast) {
  const auto moved = [&](const char* number) { return fs::path(file_.string() + "." + number); };
  { AuditLog(file_).add(change(0)); }
  fs::rename(file_, moved("0000000001"));
  { AuditLog(file_).add(change(1)); }
  fs::rename(file_, moved("0000000003"));
  std::ofstream(file_.string() + ".bak") << "notes\n";
  std::ofstream(file_.string()).close();
  { AuditLog(file_).add(change(2)); }
  AuditHead head;
  for (const fs::path& file : {moved("0000000001"), moved("0000000003"), file_}) {
    const AuditCheck check = check_audit(file, {}, {}, head);
    ASSERT_EQ(check.wrong_line, 0u) << file << ": " << check.wrong;
    head = check.head;
  }
  EXPECT_EQ(head.n, 5u);
  // One that is no audit file holds nobody up.
  fs::rename(file_, moved("0000000005"));
  std::ofstream(moved("9999999999")) << "notes\n";
  { AuditLog(file_).add(change(3)); }
  EXPECT_EQ(check_audit(file_).head.n, 1u);
}

TEST_F(AuditRotation, ALargeFileThatCannotBeMovedGoesOn) {
  std::ofstream(file_.string() + ".0000000010") << "mine";
  {
    AuditLog log(file_, 1);
    for (int i = 0; i < 10; ++i) log.add(change(i));
    while (log.ask({}).newest < 10 || log.ask({}).unwritten > 0) std::this_thread::yield();
  }
  std::uint64_t changes = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.file_size() == 4) continue;
    check_audit(entry.path(), {}, [&](const audit::Entry& e) { changes += e.kind() == "change"; });
  }
  EXPECT_EQ(changes, 10u);
}

}  // namespace
}  // namespace skerry::server
