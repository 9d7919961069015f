// The audit file of a running server, by its tools.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/system/running_server.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Audit : public testing::Test {
 protected:
  Ending audit(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all{skerry_program(), "audit"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all);
  }
  std::string head() const {
    const std::string out = audit({"verify", file_}).out;
    const std::size_t at = out.find("head ");
    return at == std::string::npos ? "" : out.substr(at + 5, 64);
  }
  std::vector<std::string> server() const { return {"--scenario", scenario_, "--audit", file_}; }

  TempFolder folder_;
  std::string file_ = folder_.path("audit.jsonl");
  std::string scenario_ = folder_.write("small.yaml", small_scenario());
};

TEST_F(Audit, HasWhoChangedWhatAndIsShownAndVerified) {
  {
    const RunningServer server(this->server());
    EXPECT_EQ(server.skerry("set", {"--gain", "71"}).code, 0);
    EXPECT_EQ(server.skerry("set", {"--lock", "gain"}).code, 0);
    EXPECT_EQ(server.skerry("set", {"--gain", "72"}).code, 1);
  }
  const std::string first = head();
  {
    const RunningServer server(this->server());
    EXPECT_EQ(server.skerry("set", {"--gain", "73"}).code, 0);
  }
  const Ending shown = audit({"show", file_});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out,
              AllOf(HasSubstr("gain: 50 -> 71"), HasSubstr("gain: 50 -> 73"), HasSubstr("lock"),
                    HasSubstr("gain: locked by the instructor"), HasSubstr("from head " + first)));
  EXPECT_EQ(audit({"verify", file_, "--head", first}).code, 0);
  EXPECT_EQ(audit({"verify", file_, "--head", std::string(64, 'a')}).code, 1);

  EXPECT_EQ(audit({"verify", file_, "--head", first.substr(0, 10)}).code, 2);

  std::string text = text_of_file(file_);
  text.replace(text.find("\"71\""), 4, "\"17\"");
  std::ofstream(file_, std::ios::binary) << text;
  const Ending changed = audit({"verify", file_});
  EXPECT_EQ(changed.code, 1);
  EXPECT_THAT(changed.err, HasSubstr(file_ + ":2: entry 2 or one before it is not as it was"));
}

TEST_F(Audit, AFileThatIsNoneStopsTheStartWithItsName) {
  std::ofstream(file_) << "notes\n";
  const Ending refused = run({skerryd_program(), "--scenario", scenario_, "--audit", file_});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--audit: " + file_ + ": its end is no entry"));
}

}  // namespace
}  // namespace skerry::system_test
