// Scores as tables and as a page.
#include "server/plotter/judge/score_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "server/plotter/judge/score_text.hpp"
#include "tests/unit/plotter/judge/made_scene.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;
using testing::Not;

PlanePoint going_north(double t) { return {0.0, 5.0 * t}; }

Truth some_truth() { return {{made::target("<b>&", 0, 60, going_north)}, made::still(0, 60)}; }

std::vector<Told> some_told() {
  Told told{"=other \"maker\" <script>", {made::track("1", 10, 60, [](double t) {
              return going_north(t) + PlanePoint{3.0, 4.0};
            })}};
  for (ToldPoint& point : told.tracks[0].points) {
    point.course_deg = 0.0;
    point.speed_kn = 9.0;
  }
  return {told, {"nothing", {}}};
}

std::vector<SceneScore> scores() {
  std::vector<SceneScore> out;
  JudgeRule rule;
  rule.step_s = 1.0;
  for (const Told& told : some_told()) out.push_back(track_score(some_truth(), told, rule));
  return out;
}

TEST(ScoreTable, HasALineForEachTrackerAndTarget) {
  const std::string table = score_table(scores());
  EXPECT_THAT(table, HasSubstr("nothing"));
  EXPECT_THAT(table, HasSubstr("  <b>&"));
  EXPECT_THAT(table.substr(table.find('\n') + 1, 100), HasSubstr(" 83.6 "));  // 51 of 61 steps
  EXPECT_THAT(table.substr(table.find("  <b>&")), HasSubstr(" 83.6 "));
  std::istringstream lines(table);
  std::size_t header = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("tracker")) header = line.size();
  std::istringstream again(table);
  for (std::string line; std::getline(again, line);) {
    if (line.starts_with("nothing ")) {
      EXPECT_EQ(line.size(), header) << line;
    }
  }
}

TEST(ScoreCsv, HasARowForEachThingAndSafeCells) {
  const auto files = score_csv_files(scores());
  ASSERT_EQ(files.size(), 5u);
  const auto rows = [&](std::size_t index) {
    return std::count(files[index].second.begin(), files[index].second.end(), '\n');
  };
  EXPECT_EQ(files[0].first, "scenes.csv");
  EXPECT_EQ(rows(0), 1 + 2);
  EXPECT_EQ(rows(1), 1 + 2);
  EXPECT_EQ(rows(2), 1 + 1);
  EXPECT_EQ(rows(3), 1 + 2 * 61);
  EXPECT_EQ(rows(4), 1 + 51);
  EXPECT_THAT(files[0].second, HasSubstr("\"'=other \"\"maker\"\" <script>\""));
  for (const auto& [name, text] : files) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    while (std::getline(lines, line))
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << name << ": " << line;
  }
}

TEST(ScorePage, EscapesNamesAndHasItsFigures) {
  const Truth truth = some_truth();
  const auto told = some_told();
  const auto judged = scores();
  const std::string page = score_page({"Title & more", {"a note <i>"}}, truth, told, judged);
  EXPECT_THAT(page, HasSubstr("Title &amp; more"));
  EXPECT_THAT(page, HasSubstr("a note &lt;i&gt;"));
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;"));
  EXPECT_THAT(page, Not(HasSubstr("<b>&")));
  EXPECT_EQ(page.find("<script>"), page.rfind("<script>"));  // the page's own
  for (const char* figure : {"OSPA", "GOSPA", "tracks over the truth", "Error of place",
                             "Error of course", "Error of CPA"})
    EXPECT_THAT(page, HasSubstr(figure));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, Not(HasSubstr("http://www.example")));
}

}  // namespace
}  // namespace skerry::server
