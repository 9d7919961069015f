#include "server/net/http/audit_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/net/kept_audit.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

// Answers with what it is given, and keeps the question.
class AskedAudit final : public KeptAudit {
 public:
  AuditAnswer ask(const AuditQuestion& question) const override {
    asked.push_back(question);
    return answer;
  }
  void tell(std::uint32_t n, const std::string& what) {
    auto entry = std::make_shared<recording::AuditEntry>();
    entry->set_n(n);
    entry->set_what(what);
    answer.entries.push_back(std::move(entry));
  }
  AuditAnswer answer;
  mutable std::vector<AuditQuestion> asked;
};

TEST(AuditPage, HasTheEntriesAsTheirFileHasThem) {
  AskedAudit audit;
  EXPECT_EQ(audit_page(&audit, "/audit").body,
            "{\"entries\":[],\"newest\":0,\"has_file\":false,\"unwritten\":0}\n");
  audit.tell(8, "gain \"x\"");
  audit.tell(7, "sign in");
  audit.answer.newest = 8;
  audit.answer.has_file = true;
  audit.answer.unwritten = 3;
  const WebAnswer page = audit_page(&audit, "/audit");
  EXPECT_EQ(page.mime, "application/json");
  EXPECT_EQ(page.body,
            "{\"entries\":[{\"n\":8,\"what\":\"gain \\\"x\\\"\"},\n{\"n\":7,\"what\":\"sign in\"}],"
            "\"newest\":8,\"has_file\":true,\"unwritten\":3}\n");
  EXPECT_EQ(audit_page(nullptr, "/audit").status, 200u);
}

TEST(AuditPage, AsksForWhatTheQuerySays) {
  AskedAudit audit;
  audit_page(&audit, "/audit?last=20&after=7&who=Anna+%C3%A4&kind=sign_in");
  audit_page(&audit, "/audit?kind=&who=");
  ASSERT_EQ(audit.asked.size(), 2u);
  EXPECT_EQ(audit.asked[0].most, 20u);
  EXPECT_EQ(audit.asked[0].after, 7u);
  EXPECT_EQ(audit.asked[0].who, "Anna \xc3\xa4");
  EXPECT_EQ(audit.asked[0].kind, "sign_in");
  EXPECT_EQ(audit.asked[1].most, 200u);
  EXPECT_EQ(audit.asked[1].kind, "");
}

TEST(AuditPage, SaysWhatAQueryMayHave) {
  AskedAudit audit;
  EXPECT_EQ(audit_page(&audit, "/audit?who=" + std::string(201, 'a')).status, 400u);
  for (const char* query :
       {"last=1001", "last=-1", "last=x", "last=", "after=4294967296", "kind=all", "size=3",
        "who=%", "who=%zz", "who=a&who=b", "&&", "%00=1"}) {
    const WebAnswer answer = audit_page(&audit, std::string("/audit?") + query);
    EXPECT_EQ(answer.status, 400u) << query;
    EXPECT_THAT(answer.body, HasSubstr("last=0..1000")) << query;
  }
  EXPECT_TRUE(audit.asked.empty());
}

}  // namespace
}  // namespace skerry::server
