// The chain of the audit file: what is found out, and what only a noted head finds out.
#include "server/audit/audit_chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace skerry::server {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class AuditChain : public testing::Test {
 protected:
  AuditChain() {
    AuditHead head;
    for (int i = 1; i <= 20; ++i) {
      audit::Entry entry;
      entry.set_utc("2026-11-29T12:00:" + std::to_string(i + 10) + ".000Z");
      entry.set_kind("change");
      entry.set_who("Anna \"\\ \xc3\xa4");
      entry.set_what("gain");
      entry.set_before(std::to_string(i));
      lines_.push_back(audit_line(entry, head));
      heads_.push_back(head.chain);
    }
  }
  ~AuditChain() override { fs::remove(file_); }

  AuditCheck check(const std::string& wanted = {}) {
    std::ofstream out(file_, std::ios::binary);
    for (const std::string& line : lines_) out << line;
    out.close();
    return check_audit(file_, wanted);
  }

  std::vector<std::string> lines_, heads_;
  fs::path file_ = [] {
    std::string pattern = testing::TempDir() + "skerry-audit-XXXXXX";
    const int descriptor = ::mkstemp(pattern.data());
    if (descriptor >= 0) ::close(descriptor);
    return fs::path(pattern);
  }();
};

// By another program: SHA-256 of 64 zeros and of what stands before ,"chain": .
TEST_F(AuditChain, IsWhatItsDescriptionSays) {
  AuditHead head;
  audit::Entry entry;
  entry.set_kind("server");
  EXPECT_EQ(audit_line(entry, head),
            "{\"n\":1,\"kind\":\"server\",\"chain\":"
            "\"f2bcf8bfea863b5b88b80f1ee6f411f61eb362e2e93bdb9bcbbd6dda2931d393\"}\n");
}

// A line of a later version, by another program.
TEST_F(AuditChain, AMemberThatItDoesNotKnowIsPassedOver) {
  lines_ = {
      "{\"n\":1,\"kind\":\"server\",\"mood\":\"good\",\"chain\":"
      "\"45e275a9492e1fc558c8e1358cc93a7315de594c56745f0c3891aab969228932\"}\n"};
  const AuditCheck found = check();
  EXPECT_EQ(found.wrong_line, 0u) << found.wrong;
  EXPECT_EQ(found.entries, 1u);
}

TEST_F(AuditChain, AWholeFileIsGood) {
  std::vector<std::string> before;
  check();
  const AuditCheck found =
      check_audit(file_, heads_[6], [&](const audit::Entry& e) { before.push_back(e.before()); });
  EXPECT_EQ(found.wrong_line, 0u) << found.wrong;
  EXPECT_EQ(found.head.n, 20u);
  EXPECT_EQ(found.head.chain, heads_.back());
  EXPECT_TRUE(found.has_wanted);
  EXPECT_EQ(found.first_utc, "2026-11-29T12:00:11.000Z");
  EXPECT_EQ(found.last_utc, "2026-11-29T12:00:30.000Z");
  EXPECT_EQ(before.size(), 20u);
  EXPECT_EQ(before[4], "5");
}

TEST_F(AuditChain, EveryChangedByteOfEveryLineIsFoundOut) {
  const std::vector<std::string> good = lines_;
  for (const std::size_t line : {0, 9, 19}) {
    for (std::size_t byte = 0; byte + 1 < good[line].size(); ++byte) {
      lines_ = good;
      lines_[line][byte] ^= 1;
      const AuditCheck found = check();
      ASSERT_EQ(found.wrong_line, line + 1) << "byte " << byte;
      ASSERT_EQ(found.head.n, line);
      ASSERT_FALSE(found.wrong.empty());
    }
  }
}

TEST_F(AuditChain, ALineTakenOutPutInOrElsewhereIsFoundOut) {
  const std::vector<std::string> good = lines_;
  lines_.erase(lines_.begin() + 4);
  EXPECT_EQ(check().wrong_line, 5u);
  EXPECT_THAT(check().wrong, HasSubstr("entry 6 follows entry 4"));
  lines_ = good;
  lines_.insert(lines_.begin() + 4, good[4]);
  EXPECT_EQ(check().wrong_line, 6u);
  lines_ = good;
  std::swap(lines_[7], lines_[8]);
  EXPECT_EQ(check().wrong_line, 8u);
  lines_ = good;
  lines_.insert(lines_.begin() + 4, "\n");
  EXPECT_EQ(check().wrong_line, 5u);
  lines_ = good;
  lines_.insert(lines_.begin(), std::string(100'000, 'x') + "\n");
  EXPECT_EQ(check().wrong_line, 1u);
}

// The end cut off, or all of it made anew, holds together: only a noted head tells.
TEST_F(AuditChain, ALostEndIsFoundOutByANotedHead) {
  lines_.resize(15);
  EXPECT_EQ(check().wrong_line, 0u);
  EXPECT_FALSE(check(heads_.back()).has_wanted);
  EXPECT_TRUE(check(heads_[14]).has_wanted);
}

TEST_F(AuditChain, AnEntryThatWasBeingWrittenIsTold) {
  lines_.back().resize(30);
  const AuditCheck found = check();
  EXPECT_EQ(found.wrong_line, 0u);
  EXPECT_EQ(found.head.n, 19u);
  EXPECT_EQ(found.unfinished_bytes, 30u);
}

// As after a rotation: the first line of the second file names the end of the first.
class AuditChainOfFiles : public AuditChain {
 protected:
  AuditChainOfFiles() {
    const AuditCheck first = check();
    end_ = first.head;
    AuditHead head = end_;
    lines_.clear();
    for (int i = 1; i <= 5; ++i) {
      audit::Entry entry;
      if (i == 1) entry.set_follows(head.chain);
      entry.set_what("in the second file " + std::to_string(i));
      lines_.push_back(audit_line(entry, head));
    }
    check();
  }
  AuditHead end_;
};

TEST_F(AuditChainOfFiles, GoesOnFromFileToFile) {
  const AuditCheck alone = check_audit(file_);
  EXPECT_EQ(alone.wrong_line, 0u) << alone.wrong;
  EXPECT_EQ(alone.entries, 5u);
  EXPECT_EQ(alone.head.n, 25u);
  EXPECT_EQ(alone.follows, end_);
  EXPECT_EQ(check_audit(file_, {}, {}, end_).head, alone.head);
  EXPECT_TRUE(check_audit(file_, end_.chain, {}, end_).has_wanted);
  EXPECT_TRUE(check_audit(file_, end_.chain).has_wanted) << "by its first line";
  EXPECT_FALSE(check_audit(file_, heads_[3]).has_wanted);
}

TEST_F(AuditChainOfFiles, AnotherFileBeforeIsFoundOut) {
  AuditHead other = end_;
  other.chain[0] = other.chain[0] == 'a' ? 'b' : 'a';
  const AuditCheck changed = check_audit(file_, {}, {}, other);
  EXPECT_EQ(changed.wrong_line, 1u);
  EXPECT_THAT(changed.wrong, HasSubstr("goes on from another audit"));
  other = end_;
  other.n -= 1;
  EXPECT_EQ(check_audit(file_, {}, {}, other).wrong_line, 1u) << "one is missing between";
  lines_.erase(lines_.begin());
  EXPECT_EQ(check().wrong_line, 1u) << "its first line is missing";
}

TEST_F(AuditChainOfFiles, EveryChangedByteOfItsFirstLineIsFoundOut) {
  const std::string good = lines_[0];
  for (std::size_t byte = 0; byte + 1 < good.size(); ++byte) {
    lines_[0] = good;
    lines_[0][byte] ^= 1;
    ASSERT_EQ(check().wrong_line, 1u) << "byte " << byte;
  }
}

TEST_F(AuditChain, GarbageIsNoEntryAndNoCrash) {
  for (const char* text : {"", "{}", "{\"n\":1}", "\xff\xfe\n\n\n", "[1,2,3]\n"}) {
    lines_ = {text};
    const AuditCheck found = check();
    EXPECT_EQ(found.head.n, 0u) << text;
  }
  EXPECT_THROW(check_audit("/no/such/file"), std::runtime_error);
  EXPECT_THROW(check_audit(file_.parent_path()), std::runtime_error) << "a folder is no good file";
}

}  // namespace
}  // namespace skerry::server
