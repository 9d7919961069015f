#include "tests/system/fleet/history_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::fleet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using End = AppendTold::End;

ToldHistory good() {
  ToldHistory history;
  history.log = {{10, 5, 3, "a", "h", ""}, {11, 5, 3, "b", "h", ""}, {14, 12, 4, "c", "h", ""}};
  history.appends = {{"p", "a", 5, 100, 200, End::done, 10},
                     {"q", "b", 5, 150, 300, End::done, 11},
                     {"q", "c", 12, 310, 320, End::unknown, 0},
                     {"p", "d", 5, 330, 340, End::never, 0}};
  history.watches = {{"p", 1, {{10, "a"}, {11, "b"}, {14, "c"}}}, {"q", 11, {{11, "b"}}}};
  return history;
}

template <typename Change>
std::vector<std::string> said(Change change) {
  ToldHistory history = good();
  change(history);
  return contradictions(history);
}

TEST(HistoryCheck, FindsNothingInAGoodHistory) { EXPECT_THAT(contradictions(good()), IsEmpty()); }

TEST(HistoryCheck, FindsWhatCannotBe) {
  EXPECT_THAT(said([](auto& h) { h.appends[0].id = "x"; }),
              ElementsAre(HasSubstr("x was acknowledged to p and is not there")));
  EXPECT_THAT(said([](auto& h) { h.appends[0].revision = 9; }),
              ElementsAre(HasSubstr("acknowledged in revision 9 and is in 10")));
  EXPECT_THAT(said([](auto& h) { h.appends[3].id = "c"; }),
              ElementsAre(HasSubstr("c was refused to p for good and is there")));
  EXPECT_THAT(said([](auto& h) { h.log[2].epoch = 4; }),
              ElementsAre(HasSubstr("c of epoch 4 stands behind epoch 5")));
  EXPECT_THAT(said([](auto& h) { h.log[2].tick = 2; }),
              ElementsAre(HasSubstr("c of tick 2 stands behind tick 3")));
  EXPECT_THAT(said([](auto& h) {
                h.log[2].id = "a";
                h.watches[0].orders.pop_back();
              }),
              ElementsAre(HasSubstr("a is there twice")));
  EXPECT_THAT(said([](auto& h) {
                std::swap(h.log[0], h.log[1]);
                h.watches.clear();
              }),
              ElementsAre(HasSubstr("a of revision 10 stands behind revision 11")));
  EXPECT_THAT(said([](auto& h) {
                h.appends[1].ended_ns = 160;
                h.appends[0].began_ns = 170;
              }),
              ElementsAre(HasSubstr("a in revision 10 was begun after b in 11 was acknowledged")));
  EXPECT_THAT(said([](auto& h) { h.watches[0].orders.erase(h.watches[0].orders.begin() + 1); }),
              ElementsAre(HasSubstr("gave c of revision 14, and b of 11 is next")));
  EXPECT_THAT(said([](auto& h) { h.watches[1].orders.emplace_back(11, "b"); }),
              ElementsAre(HasSubstr("gave b of revision 11, and c of 14 is next")));
}

}  // namespace
}  // namespace skerry::fleet
