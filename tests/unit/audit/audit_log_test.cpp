// The audit file of a running server: across runs, after a cut, with a full disk, and too fast.
#include "tests/unit/audit/audit_log_kit.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using Kind = AuditEntry::Kind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(AuditLogFile, GoesOnFromRunToRun) {
  AuditHead head;
  {
    AuditLog log(file_);
    for (int i = 0; i < 10; ++i) log.add(change(i));
  }
  {
    AuditLog log(file_);
    head = log.head();
    EXPECT_EQ(head.n, 10u);
    log.add(change(10));
  }
  const auto all = entries();
  ASSERT_EQ(all.size(), 11u);
  EXPECT_EQ(all[10].before(), "10");
  EXPECT_EQ(all[10].kind(), "change");
  EXPECT_TRUE(check_audit(file_, head.chain).has_wanted);
}

TEST_F(AuditLogFile, WhoIsAtAPlaceIsTold) {
  {
    AuditLog log(file_);
    log.add(change(0));
    {
      const AuditedRequest request(&log, "console 10.0.0.5:4711", "Anna, trainee");
      EXPECT_EQ(log.who_at("console 10.0.0.5:4711"), "Anna, trainee");
      log.add(change(1));
    }
    log.add(change(2));
    AuditEntry named = change(3);
    named.who = "Ben, instructor";
    log.add(named);
  }
  std::vector<std::string> who;
  for (const auto& entry : entries()) who.push_back(entry.who());
  EXPECT_THAT(who, ElementsAre("", "Anna, trainee", "", "Ben, instructor"));
}

TEST_F(AuditLogFile, TextFromOutsideCannotBreakALine) {
  {
    AuditLog log(file_);
    AuditEntry entry = change(1);
    entry.what = "a\"}\n{\"n\":2,\xff\xfe" + std::string(5000, 'x') + std::string(1, '\0');
    log.add(entry);
    log.add(change(2));
  }
  const auto all = entries();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_LE(all[0].what().size(), 3 * AuditLog::kMostText);
}

// A killed server leaves the begin of a line, of any length.
TEST_F(AuditLogFile, AnUnfinishedEntryIsCutOffAndTold) {
  {
    AuditLog log(file_);
    log.add(change(0));
    log.add(change(1));
  }
  const std::string whole = text();
  const std::size_t first = whole.find('\n') + 1;
  for (std::size_t length = 1; length < whole.size(); length += 5) {
    if (length == first) continue;
    std::ofstream(file_, std::ios::binary) << whole.substr(0, length);
    { AuditLog log(file_); }
    const auto all = entries();
    ASSERT_EQ(all.size(), length < first ? 1u : 2u) << length;
    EXPECT_EQ(all.back().what(),
              fmt::format("{} bytes of an entry that was not finished were cut off",
                          length < first ? length : length - first));
  }
}

TEST_F(AuditLogFile, WhatIsNoneIsRefusedAndLeftAlone) {
  const std::string zeros(100'000, '\0'), long_line = std::string(200'000, 'x') + "\n";
  for (const std::string& is : {std::string("some notes"), std::string("some notes\n"),
                                std::string("{\"n\":1}\n"), std::string("\n"), zeros, long_line}) {
    std::ofstream(file_, std::ios::binary) << is;
    try {
      AuditLog log(file_);
      FAIL() << is;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("--audit: " + file_.string()));
    }
    EXPECT_EQ(text(), is);
  }
  EXPECT_THROW(AuditLog{folder_}, std::runtime_error);
  EXPECT_THROW(AuditLog{folder_ / "no" / "audit"}, std::runtime_error);
}

TEST_F(AuditLogFile, IsOfOneServer) {
  const AuditLog first(file_);
  try {
    AuditLog second(file_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another server"));
  }
}

// Of each address so many; the rest is counted in a line that names it.
TEST_F(AuditLogFile, AFloodFromOneAddressPushesOutNobodyElses) {
  constexpr int kFlood = 20000;
  {
    AuditLog log(file_);
    for (int i = 0; i < kFlood; ++i) {
      const std::string from = fmt::format("console 10.0.0.66:{}", 1024 + i);
      log.add({.kind = Kind::refusal, .from = from, .what = "no"});
      log.add({.kind = Kind::change, .from = from, .what = "gain"});
    }
    log.add({.kind = Kind::refusal, .from = "console 10.0.0.5:4711", .what = "not you"});
    for (int i = 0; i < 10; ++i) log.add(change(i));
  }
  int refusals = 0, changes = 0, others = 0, counted = 0;
  for (const auto& entry : entries()) {
    if (entry.from().starts_with("console 10.0.0.5:")) {
      ++others;
    } else if (entry.what() == "no") {
      ++refusals;
    } else if (entry.what() == "gain") {
      ++changes;
    } else {
      EXPECT_EQ(entry.from(), "console 10.0.0.66");
      EXPECT_THAT(entry.what(), HasSubstr("more from there, which came too fast"));
      counted += std::stoi(entry.what());
    }
  }
  EXPECT_EQ(others, 11);
  EXPECT_GE(refusals, 50);
  EXPECT_GE(changes, 500);
  EXPECT_LT(refusals + changes, 2000);
  EXPECT_EQ(refusals + changes + counted, 2 * kFlood);
}

// From ever other addresses: together no more than so many.
TEST_F(AuditLogFile, StrangersTogetherCannotFillTheDisk) {
  constexpr int kFlood = 20000;
  {
    AuditLog log(file_);
    for (int i = 0; i < kFlood; ++i) {
      log.add({.kind = Kind::refusal,
               .from = fmt::format("console 10.{}.{}.1:99", i / 250, i % 250),
               .what = "no"});
    }
    for (int i = 0; i < 10; ++i) log.add(change(i));
  }
  int refusals = 0, counted = 0, changes = 0;
  for (const auto& entry : entries()) {
    changes += entry.from() == "console 10.0.0.5:4711";
    refusals += entry.what() == "no";
    if (entry.what().find("too fast") != std::string::npos) counted += std::stoi(entry.what());
  }
  EXPECT_EQ(changes, 10);
  EXPECT_LT(refusals, 1000);
  EXPECT_EQ(refusals + counted, kFlood);
}

// A file may have no more than so many bytes, as on a full disk.
TEST_F(AuditLogFile, AFullDiskLosesNothingThatWaits) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  {
    AuditLog log(file_);
    log.add(change(0));
    while (log.head().n < 1) std::this_thread::yield();
    const std::string one = text();
    // Room for half of the next.
    const rlimit small{one.size() + one.size() / 2, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    log.add(change(1));
    log.add(change(2));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(log.head().n, 1u);
    EXPECT_EQ(text(), one) << "nothing is half written";
    ::setrlimit(RLIMIT_FSIZE, &before);
    while (log.head().n < 3) std::this_thread::yield();
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(entries().size(), 3u);
}

// The newest are in memory, with a file and without.
TEST_F(AuditLogFile, TheNewestCanBeAskedForByNumberPlaceAndKind) {
  for (const fs::path& file : {file_, fs::path()}) {
    AuditLog log(file);
    log.add({.what = "begin"});
    log.add({.kind = Kind::change, .from = "console 10.0.0.5:1", .who = "Anna", .what = "a"});
    log.add({.kind = Kind::change, .from = "HTTP 10.0.0.6:1", .what = "b"});
    log.add({.kind = Kind::refusal, .from = "console 10.0.0.5:1", .what = "c"});
    await(log, 4);
    EXPECT_THAT(whats(log.ask({})), ElementsAre("c", "b", "a", "begin"));
    EXPECT_THAT(whats(log.ask({.most = 2})), ElementsAre("c", "b"));
    EXPECT_THAT(whats(log.ask({.after = 3})), ElementsAre("c"));
    EXPECT_THAT(whats(log.ask({.after = 4})), IsEmpty());
    EXPECT_THAT(whats(log.ask({.who = "aNN"})), ElementsAre("a"));
    EXPECT_THAT(whats(log.ask({.who = "10.0.0.5"})), ElementsAre("c", "a"));
    EXPECT_THAT(whats(log.ask({.who = "10.0.0.5", .kind = "change"})), ElementsAre("a"));
    EXPECT_EQ(log.ask({}).has_file, !file.empty());
    EXPECT_EQ(log.ask({.most = 0}).newest, 4u);
  }
}

TEST_F(AuditLogFile, InMemoryAreSoManyAndNoMore) {
  AuditLog log({});
  constexpr std::uint32_t kMany = 2 * AuditLog::kMostRecent;
  for (std::uint32_t i = 0; i < kMany; ++i) {
    log.add({.what = std::to_string(i)});
    if (i % 1000 == 999) await(log, i);
  }
  await(log, kMany);
  const AuditAnswer all = log.ask({.most = kMany});
  ASSERT_EQ(all.entries.size(), AuditLog::kMostRecent);
  EXPECT_EQ(all.entries.front()->n(), kMany);
  EXPECT_EQ(all.entries.back()->n(), kMany - AuditLog::kMostRecent + 1);
}

TEST_F(AuditLogFile, ATakerGetsEachOnceInOrderAlsoWhileTheDiskTakesNothing) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  std::vector<std::uint32_t> taken;
  {
    AuditLog log(file_);
    log.add({.what = "not taken"});
    await(log, 1);
    log.give_to([&](const AuditEntryPtr& entry) { taken.push_back(entry->n()); });
    const rlimit none{0, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
    for (int i = 0; i < 20; ++i) log.add(change(i));
    await(log, 21);
    EXPECT_GE(log.ask({}).unwritten, 20u);
    ::setrlimit(RLIMIT_FSIZE, &before);
    while (log.head().n < 21) std::this_thread::yield();
    EXPECT_EQ(log.ask({}).unwritten, 0u);
    log.give_to(nullptr);
    log.add(change(21));
  }
  std::signal(SIGXFSZ, handler);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t n = 2; n <= 21; ++n) expected.push_back(n);
  EXPECT_EQ(taken, expected);
  EXPECT_EQ(entries().size(), 22u);
}

}  // namespace
}  // namespace skerry::server
