// An audit in a folder of its own.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "server/audit/audit_log.hpp"

namespace skerry::server {

class AuditLogFile : public testing::Test {
 protected:
  ~AuditLogFile() override { std::filesystem::remove_all(folder_); }

  AuditEntry change(int i) const {
    return {.kind = AuditEntry::Kind::change,
            .from = "console 10.0.0.5:4711",
            .what = "radar 0 view 0: gain",
            .before = std::to_string(i),
            .after = std::to_string(i + 1)};
  }
  // The entries of a file that must be good.
  std::vector<audit::Entry> entries() const {
    std::vector<audit::Entry> all;
    const AuditCheck check =
        check_audit(file_, {}, [&](const audit::Entry& entry) { all.push_back(entry); });
    EXPECT_EQ(check.wrong_line, 0u) << check.wrong;
    EXPECT_EQ(check.unfinished_bytes, 0u);
    return all;
  }
  std::string text() const {
    std::stringstream all;
    all << std::ifstream(file_, std::ios::binary).rdbuf();
    return all.str();
  }

  static std::vector<std::string> whats(const AuditAnswer& answer) {
    std::vector<std::string> all;
    for (const AuditEntryPtr& entry : answer.entries) all.push_back(entry->what());
    return all;
  }
  // Until the thread has numbered so many.
  static void await(const AuditLog& log, std::uint32_t n) {
    while (log.ask({}).newest < n) std::this_thread::yield();
  }

  std::filesystem::path folder_ = [] {
    std::string pattern = testing::TempDir() + "skerry-audit-XXXXXX";
    return std::filesystem::path(::mkdtemp(pattern.data()));
  }();
  std::filesystem::path file_ = folder_ / "audit.jsonl";
};

}  // namespace skerry::server
