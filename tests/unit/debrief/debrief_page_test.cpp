// The page: it needs nothing else, and what comes from outside is text.
#include "server/debrief/debrief_page.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/debrief/csv_files.hpp"
#include "server/debrief/words.hpp"
#include "server/page/csv_cell.hpp"
#include "server/page/html_text.hpp"
#include "server/page/plot_figure.hpp"

namespace skerry::server {
namespace {

constexpr const char* kNasty = "</script><img src=x onerror=\"alert(1)\">&'\x01\xFF";

Debrief some_debrief(const std::string& name) {
  Debrief debrief;
  debrief.exercise = debrief.goal = debrief.briefing = debrief.server = debrief.chart = name;
  debrief.answers = {name};
  debrief.differs = name;
  debrief.incomplete = true;
  debrief.end = {3700.0, 3000.0};
  debrief.has_one_clock = false;
  for (const bool own : {true, false}) {
    ShipTrack& track = (own ? debrief.own_ships : debrief.targets).emplace_back();
    track.own = own;
    track.name = track.ship_class = name;
    track.length_m = 100.0;
    track.beam_m = 16.0;
    for (int i = 0; i < 3700; ++i) {
      TrackPoint& point = track.points.emplace_back();
      point.when = {1.0 * i, 0.8 * i};
      point.position = {60.0 + 1e-5 * i, 5.0 + (own ? 0.0 : 0.01)};
      point.heading_deg = i % 360;
      point.rudder_deg = 10.0;
      point.shaft_rpm = 100.0;
    }
  }
  ShipPassing& passing = debrief.passings.emplace_back();
  passing.own_name = passing.other_name = name;
  passing.closest_m = 100.0;
  passing.first_under = Moment{10.0, 8.0};
  for (int i = 0; i < 100; ++i) passing.ranges.push_back({2.0 * i, 3.0 - 0.02 * i});
  Contact contact;
  contact.own_name = contact.other_name = contact.why = name;
  contact.position = {60.01, 5.0};
  debrief.contacts = {contact, contact};
  debrief.contacts[1].kind = Contact::Kind::grounding;
  debrief.contact_moments = {{100.0, 80.0}, {200.0, 160.0}};
  for (const char* kind : {"event", "setting", "fault", "mark"}) {
    debrief.happened.push_back({{50.0, 40.0}, kind, name, name, {}});
  }
  debrief.happened.push_back({{60.0, 50.0}, name, name, name, {}});
  Reaction& reaction = debrief.reactions.emplace_back();
  reaction.stimulus = reaction.own_name = name;
  KnownView& view = debrief.known.emplace_back();
  view.own_name = view.radar = name;
  view.left_out = 3;
  KnownTarget& target = view.targets.emplace_back();
  target.name = name;
  target.least_cpa_nm = 0.2;
  target.way = {{60.0, 5.0}, {60.01, 5.01}};
  view.targets.resize(400, target);
  KnownAlert& alert = view.alerts.emplace_back();
  alert.priority = alert.title = alert.text = name;
  alert.acknowledged = Moment{20.0, 16.0};
  view.alerts.resize(400, alert);
  recording::AuditEntry entry;
  entry.set_kind("change");
  entry.set_who(name);
  entry.set_what(name);
  entry.set_after(name);
  entry.set_result(name);
  debrief.deeds.resize(20, {{30.0, 24.0}, entry});
  debrief.checks.push_back({{60.0, 60.0}, name, true, false, {{false, name}}});
  return debrief;
}

wire::Coastline some_coast() {
  wire::Coastline coast;
  coast.set_latitude_deg(60.0);
  coast.set_longitude_deg(5.0);
  wire::Coastline::Line& line = *coast.add_lines();
  for (const int step : {0, 0, 9000, 0, 0, 9000, -9000, 0}) line.add_points(step);
  return coast;
}

// Every element that is opened is closed, in order; what is wrong if not.
std::string unbalanced(const std::string& html) {
  const std::vector<std::string> single = {"meta", "input", "br", "!DOCTYPE"};
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return "an open tag at the end";
    std::string tag = html.substr(at + 1, end - at - 1);
    const bool closes = tag.starts_with('/'), itself = tag.ends_with('/');
    const std::string name = tag.substr(closes, tag.find_first_of(" \n/", closes) - closes);
    if (name == "script" && !closes) {
      at = html.find("</script>", at) - 1;
      continue;
    }
    if (name == "style" && !closes) {
      at = html.find("</style>", at) - 1;
      continue;
    }
    if (name == "script" || name == "style" || itself ||
        std::find(single.begin(), single.end(), name) != single.end()) {
      continue;
    }
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : open.back());
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

TEST(DebriefPage, HasNamesFromOutsideAsText) {
  const std::string page = debrief_page(some_debrief(kNasty), some_coast());
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("onerror=\""), std::string::npos);
  EXPECT_EQ(page.find('\x01'), std::string::npos);
  EXPECT_EQ(page.find('\xFF'), std::string::npos);
  EXPECT_EQ(unbalanced(page), "");
  std::size_t scripts = 0;
  for (std::size_t at = page.find("</script"); at != std::string::npos;
       at = page.find("</script", at + 1)) {
    ++scripts;
  }
  EXPECT_EQ(scripts, 1u);
  EXPECT_NE(page.find("&lt;/script&gt;&lt;img src=x onerror=&quot;alert(1)&quot;&gt;&amp;&#39;"),
            std::string::npos);
}

TEST(DebriefPage, NeedsNothingFromElsewhere) {
  const std::string page = debrief_page(some_debrief("Plain"), some_coast());
  for (const char* word : {"src=", "@import", "url(", "https:", "<link", "fetch(", "<iframe"}) {
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  // The name of SVG for scripts is no address that is looked at.
  const std::size_t first = page.find("http://");
  EXPECT_EQ(page.compare(first, 26, "http://www.w3.org/2000/svg"), 0);
  EXPECT_EQ(page.find("http://", first + 1), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_EQ(page.find("inf "), std::string::npos);
}

TEST(DebriefPage, OfNothingAtAllIsAPage) {
  const std::string page = debrief_page(Debrief{}, {});
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_NE(page.find("Collisions: 0, groundings: 0."), std::string::npos);
}

TEST(DebriefPage, IsSmallAfterLongExercises) {
  Debrief debrief = some_debrief("Long");
  ShipTrack& track = debrief.own_ships[0];
  track.points.clear();
  for (int i = 0; i < 8 * 3600; ++i) {
    TrackPoint& point = track.points.emplace_back();
    point.when = {1.0 * i, 1.0 * i};
    point.position = {60.0 + 2e-5 * i, 5.0};
    point.heading_deg = 180.0 + 90.0 * ((i * 7919) % 1000) / 1000.0;
  }
  debrief.end = {8.0 * 3600.0, 8.0 * 3600.0};
  EXPECT_LT(debrief_page(debrief, {}).size(), 400'000u);
}

TEST(DebriefPage, PlotsKeepPeaks) {
  PlotCurve curve;
  for (int i = 0; i < 100'000; ++i) curve.points.push_back({1.0 * i, i == 77'777 ? 30.0 : 0.0});
  PlotFrame frame;
  frame.title = "Peak";
  frame.end_s = 100'000.0;
  const std::string plot = plot_figure(frame, {curve}, {});
  EXPECT_LT(plot.size(), 40'000u);
  EXPECT_NE(plot.find(" 22.0L"), std::string::npos) << "at the top of the axis";
}

TEST(DebriefPage, ClocksAndBearings) {
  EXPECT_EQ(clock_text(0.0), "0:00");
  EXPECT_EQ(clock_text(125.9), "2:05");
  EXPECT_EQ(clock_text(3725.0), "1:02:05");
  EXPECT_EQ(clock_text(-3.0), "0:00");
  EXPECT_EQ(bearing_text(359.7), "000°");
  EXPECT_EQ(bearing_text(45.2), "045°");
  EXPECT_EQ(miles_text(100.0), "0.05 NM (100 m)");
  EXPECT_EQ(shortened("Sjø og strand", 3), "Sj...") << "no half of a letter";
}

TEST(DebriefTables, HaveCellsThatNoSpreadsheetTakesForMore) {
  EXPECT_EQ(csv_cell("plain"), "plain");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"so\""), "\"say \"\"so\"\"\"");
  EXPECT_EQ(csv_cell("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_cell("=1+1"), "'=1+1");
  for (const auto& [name, text] : csv_files(some_debrief("Ship, large"))) {
    EXPECT_TRUE(name.ends_with(".csv"));
    EXPECT_TRUE(text.ends_with("\r\n")) << name;
    EXPECT_NE(text.find("at_s,"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace skerry::server
