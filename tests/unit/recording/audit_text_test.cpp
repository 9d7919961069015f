#include "protocol/recording/audit_text.hpp"

#include <gtest/gtest.h>

namespace skerry::recording {
namespace {

TEST(AuditText, SaysWhatWasBeforeAndAfterWhereThereIsOne) {
  AuditEntry entry;
  EXPECT_EQ(audit_text(entry), "");
  entry.set_what("radar 0 view 0: gain");
  EXPECT_EQ(audit_text(entry), "radar 0 view 0: gain");
  entry.set_after("71");
  EXPECT_EQ(audit_text(entry), "radar 0 view 0: gain: 71");
  entry.set_before("50");
  entry.set_times(3);
  EXPECT_EQ(audit_text(entry), "radar 0 view 0: gain: 50 -> 71 (3 changes)");
  entry.clear_after();
  entry.clear_times();
  entry.set_result("ok");
  EXPECT_EQ(audit_text(entry), "radar 0 view 0: gain: 50 -> nothing: ok");
}

}  // namespace
}  // namespace skerry::recording
