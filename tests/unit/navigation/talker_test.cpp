#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "protocol/nmea/ais_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "server/navigation/ais_reports.hpp"
#include "tests/unit/navigation/test_world.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using enum NavigationSentence;

NavigationPlan plan_of(std::map<NavigationSentence, Duration> periods) {
  NavigationPlan plan;
  plan.periods = std::move(periods);
  plan.targets = TargetSource::truth;
  return plan;
}

// Messages and when they came, from asking every `step` from 0 to `end`, as far as `end` itself.
struct Said {
  double time_s;
  NavigationMessage message;
};
std::vector<Said> listen(NavigationTalker& talker, const NavigationWorld& world, double end_s,
                         double step_s = 0.01, double begin_s = 0.0) {
  std::vector<Said> said;
  const auto steps = static_cast<int>(std::lround((end_s - begin_s) / step_s));
  for (int i = 0; i <= steps; ++i) {
    const double time = begin_s + i * step_s;
    for (auto& message : talker.due(at_seconds(time), world)) said.push_back({time, message});
  }
  return said;
}

std::size_t count(const std::vector<Said>& said, NavigationSentence sentence) {
  return static_cast<std::size_t>(std::count_if(
      said.begin(), said.end(), [&](const Said& one) { return one.message.sentence == sentence; }));
}

// Every AIS message among them, with its time.
template <typename Kind>
std::vector<std::pair<double, Kind>> ais_of(const std::vector<Said>& said) {
  std::vector<std::pair<double, Kind>> found;
  nmea::AisAssembler assembler;
  for (const Said& one : said) {
    for (const std::string& line : one.message.lines) {
      const auto sentence = nmea::parse_sentence(line);
      if (!sentence || sentence->start != '!' || sentence->formatter == "TTD") continue;
      const auto heard = assembler.feed(*sentence);
      EXPECT_TRUE(heard) << line << heard.error().text;
      if (!heard || !heard->has_value()) continue;
      if (const auto* kind = std::get_if<Kind>(&(*heard)->message)) {
        found.push_back({one.time_s, *kind});
      }
    }
  }
  return found;
}

TEST(NavigationTalker, SaysEverySentenceAtItsOwnRate) {
  TestWorld world;
  NavigationTalker talker(plan_of({{rmc, 1s}, {hdt, 100ms}, {rot, 500ms}, {osd, 2s}, {ths, 20ms}}));
  const auto said = listen(talker, world, 59.995, 0.005);
  EXPECT_EQ(count(said, rmc), 60u);
  EXPECT_EQ(count(said, hdt), 600u);
  EXPECT_EQ(count(said, rot), 120u);
  EXPECT_EQ(count(said, osd), 30u);
  EXPECT_EQ(count(said, ths), 3000u);
  EXPECT_EQ(count(said, gga), 0u) << "not in the plan";
}

// A recording may lack where own ship was, how she moved and where her bow pointed.
TEST(NavigationTalker, SaysOfOwnShipOnlyWhatIsKnown) {
  TestWorld world;
  world.own.set_latitude_deg(0.0);
  world.own.set_longitude_deg(0.0);
  world.own.set_no_position(true);
  world.own.set_no_motion(true);
  world.own.set_no_heading(true);
  world.add(1, 2.0);
  std::map<NavigationSentence, Duration> all;
  for (std::size_t i = 0; i < kNavigationSentences; ++i) {
    all[static_cast<NavigationSentence>(i)] = 1s;
  }
  NavigationTalker talker(plan_of(all));
  const auto said = listen(talker, world, 2.0);
  const auto line = [&](NavigationSentence sentence) {
    for (const Said& one : said) {
      if (one.message.sentence == sentence) return one.message.lines.front();
    }
    return std::string("nothing");
  };
  EXPECT_EQ(line(rmc).substr(16, 8), ",V,,,,,,") << line(rmc);
  EXPECT_EQ(line(gga).substr(16, 10), ",,,,,0,00,") << line(gga);
  EXPECT_EQ(line(vtg).substr(0, 17), "$GPVTG,,T,,M,,N,,") << line(vtg);
  EXPECT_EQ(line(hdt).substr(0, 9), "$HEHDT,,T") << line(hdt);
  EXPECT_EQ(line(ths).substr(0, 9), "$HETHS,,V") << line(ths);
  EXPECT_EQ(line(rot).substr(0, 9), "$TIROT,,V") << line(rot);
  EXPECT_EQ(line(osd).substr(0, 9), "$RAOSD,,V") << line(osd);
  for (const NavigationSentence targets : {ttm, tll, ttd}) EXPECT_EQ(line(targets), "nothing");
  EXPECT_NE(line(vdm), "nothing") << "others say themselves where they are";
  const auto own = ais_of<nmea::AisPosition>(said);
  const auto hers = std::find_if(own.begin(), own.end(),
                                 [](const auto& one) { return one.second.mmsi == 257'000'111; });
  ASSERT_NE(hers, own.end());
  EXPECT_FALSE(hers->second.position || hers->second.speed_kn || hers->second.course_deg ||
               hers->second.heading_deg || hers->second.rate_of_turn_deg_min);
  EXPECT_EQ(hers->second.status, 15u);
}

TEST(NavigationTalker, LatenessDoesNotAddUpAndWhatWasMissedIsLeftOut) {
  TestWorld world;
  NavigationTalker talker(plan_of({{hdt, 100ms}}));
  // Asked too seldom: one each time, and those in between are left out.
  EXPECT_EQ(listen(talker, world, 107.0, 0.107).size(), 1001u);
  // Asked at any other moments than when it is due: as many all the same.
  NavigationTalker steady(plan_of({{hdt, 100ms}}));
  EXPECT_EQ(listen(steady, world, 59.97, 0.03).size(), 600u);
  EXPECT_EQ(listen(steady, world, 200.0, 0.05, 200.0).size(), 1u) << "after two minutes of silence";
}

TEST(NavigationTalker, SaysWhenItHasSomethingToSayAgain) {
  TestWorld world;
  NavigationTalker talker(plan_of({{rmc, 1s}, {rot, 300ms}}));
  talker.due(at_seconds(5), world);
  EXPECT_EQ(talker.next_due(), at_seconds(5.3));
  EXPECT_TRUE(talker.due(at_seconds(5.29), world).empty());
  EXPECT_EQ(talker.due(at_seconds(5.3), world).size(), 1u);
  EXPECT_EQ(talker.next_due(), at_seconds(5.6));
  NavigationTalker mute(plan_of({}));
  EXPECT_TRUE(mute.due(at_seconds(5), world).empty());
  EXPECT_EQ(mute.next_due(), ScenarioTime::max());
}

TEST(NavigationTalker, TheUsualPlanSaysAllTheSentencesButTtdLabelsAndAlerts) {
  TestWorld world;
  world.add(1, 3);
  world.own.mutable_con()->set_rudder_deg(5.0);
  NavigationPlan plan;
  plan.targets = TargetSource::truth;
  EXPECT_FALSE(fault_in(plan));
  NavigationTalker talker{plan};
  const auto said = listen(talker, world, 70.0);
  std::set<NavigationSentence> kinds;
  for (const Said& one : said) {
    kinds.insert(one.message.sentence);
    for (const std::string& line : one.message.lines) {
      EXPECT_TRUE(nmea::parse_sentence(line)) << line;
      EXPECT_LE(line.size(), nmea::kMaxSentence) << line;
    }
  }
  EXPECT_EQ(kinds.size(), kNavigationSentences - 5);
  for (const NavigationSentence left_out : {ttd, tlb, alf, alc, alr}) {
    EXPECT_FALSE(kinds.contains(left_out)) << name_of(left_out);
  }
}

// A ship with a class, at 10 kn into a wind of 20 kn that comes from her starboard bow.
TEST(NavigationTalker, TheConOfAShipWithAClassSpeaks) {
  TestWorld world;
  world.own.set_heading_deg(0.0);
  wire::ConState& con = *world.own.mutable_con();
  con.set_rudder_deg(-12.5);
  con.set_shaft_rpm(-80.0);
  con.set_draught_m(8.0);
  con.set_depth_below_keel_m(12.0);
  con.set_wind_from_deg(90.0);
  con.set_wind_kn(10.0);
  con.set_ground_ahead_kn(10.0);
  con.set_water_ahead_kn(9.0);
  con.set_water_starboard_kn(-1.0);
  con.set_current_set_deg(45.0);
  con.set_current_kn(1.5);
  NavigationTalker talker(plan_of(
      {{rsa, 1s}, {rpm, 1s}, {dpt, 1s}, {mwv, 1s}, {mwd, 1s}, {vdr, 1s}, {xte, 1s}, {vbw, 1s}}));
  std::map<NavigationSentence, std::string> lines;
  for (const Said& one : listen(talker, world, 0.0)) {
    lines[one.message.sentence] = one.message.lines.front();
  }
  EXPECT_EQ(lines[rsa].substr(0, 13), "$AGRSA,-12.5,");
  EXPECT_EQ(lines[rpm].substr(0, 18), "$RCRPM,S,0,-80.0,1");
  EXPECT_EQ(lines[dpt].substr(0, 17), "$SDDPT,15.0,-3.0,");
  EXPECT_EQ(lines[mwv].substr(0, 21), "$WIMWV,45.0,R,14.1,N,");
  EXPECT_EQ(lines[mwd].substr(0, 14), "$WIMWD,90.0,T,");
  EXPECT_EQ(lines[vdr].substr(0, 14), "$IIVDR,45.0,T,");
  EXPECT_EQ(lines[xte].substr(0, 11), "$IIXTE,V,V,");
  EXPECT_EQ(lines[vbw].substr(0, 20), "$VDVBW,9.00,-1.00,A,");
  // Without a class she has no con.
  world.own.clear_con();
  NavigationTalker silent(plan_of({{rsa, 1s}, {xte, 1s}}));
  EXPECT_TRUE(listen(silent, world, 3.0).empty());
}

TEST(NavigationTalker, TheLogHasTheDriftAcross) {
  TestWorld world;
  NavigationTalker talker(plan_of({{vbw, 1s}}));
  const auto said = listen(talker, world, 0.0);
  const auto sentence = nmea::parse_sentence(said.at(0).message.lines.at(0)).value();
  const auto log = nmea::decode_vbw(sentence).value();
  EXPECT_EQ(log.water_ahead_kn, 11.0);
  // 12 kn, 10 degrees to starboard of the bow.
  EXPECT_NEAR(*log.ground_ahead_kn, 11.82, 0.005);
  EXPECT_NEAR(*log.ground_starboard_kn, 2.08, 0.005);
}

TEST(NavigationTalker, WithoutMmsiOwnShipHasNoAis) {
  TestWorld world;
  world.own.set_mmsi(0);
  NavigationTalker talker(plan_of({{vdo, 1s}}));
  EXPECT_TRUE(listen(talker, world, 5.0).empty());
  NavigationPlan plan = plan_of({{vdo, 1s}});
  plan.own_mmsi = 123'456'789;
  NavigationTalker named(plan);
  const auto reports = ais_of<nmea::AisPosition>(listen(named, world, 5.99));
  ASSERT_EQ(reports.size(), 6u);
  EXPECT_EQ(reports[0].second.mmsi, 123'456'789u);
  EXPECT_EQ(reports[0].second.heading_deg, 10.0);
}

// The intervals of ITU-R M.1371-5.
TEST(NavigationTalker, ShipsReportAsFastAsTheyGo) {
  TestWorld world;
  world.add(1, 3, 0.0);                                   // lies still: 3 minutes
  world.add(2, 4, 10.0);                                  // 10 s
  world.add(3, 5, 18.0);                                  // 6 s
  world.add(4, 6, 30.0);                                  // 2 s
  world.add(5, 7, 10.0).rate_of_turn_deg_min = 40.0;      // 3 1/3 s
  world.add(6, 8, 1.0, TrafficKind::boat);                // 3 minutes
  world.add(7, 9, 10.0, TrafficKind::boat);               // 30 s
  world.add(8, 10, 0.0, TrafficKind::aid_to_navigation);  // 3 minutes
  world.add(9, 11, 0.0, TrafficKind::other);
  world.add(10, 12, 10.0).mmsi = 0;
  world.add(11, 70, 10.0);  // beyond VHF
  NavigationTalker talker(plan_of({{vdm, kAsAisDoes}}));
  const auto said = listen(talker, world, 1799.99, 0.1);
  std::map<std::uint32_t, int> reports;
  for (const auto& [time, report] : ais_of<nmea::AisPosition>(said)) ++reports[report.mmsi];
  EXPECT_EQ(reports.size(), 7u);
  EXPECT_EQ(reports[257'000'201], 10);
  EXPECT_NEAR(reports[257'000'202], 180, 1);
  EXPECT_NEAR(reports[257'000'203], 300, 1);
  EXPECT_NEAR(reports[257'000'204], 900, 1);
  EXPECT_NEAR(reports[257'000'205], 540, 16);  // of tenths of a second
  EXPECT_EQ(reports[257'000'206], 10);
  EXPECT_NEAR(reports[257'000'207], 60, 1);
  EXPECT_EQ(ais_of<nmea::AisAid>(said).size(), 10u);
  EXPECT_EQ(ais_of<nmea::AisVoyage>(said).size(), 5u * 30u) << "names once a minute";
  EXPECT_EQ(ais_of<nmea::AisStatic>(said).size(), 2u * 2u * 30u);
}

// 3 1/3 s, in a day of turning too: with 3.333 s the last of them came 8.6 s early.
TEST(NavigationTalker, ATurningShipReportsThreeTimesInTenSeconds) {
  const Duration interval = position_interval(TrafficKind::ship, 12.0 * 0.5144, 30.0);
  EXPECT_LT(std::chrono::abs(interval * 3 * 8640 - Duration(24h)), Duration(1ms));
}

TEST(NavigationTalker, AConfiguredRateHoldsForAllOfThem) {
  TestWorld world;
  for (std::uint32_t i = 1; i <= 50; ++i) world.add(i, 0.1 * i, 0.0);
  NavigationPlan plan = plan_of({{vdm, 10s}});
  plan.static_period = kAsAisDoes;
  NavigationTalker talker(plan);
  const auto said = listen(talker, world, 99.95, 0.05);
  EXPECT_EQ(ais_of<nmea::AisPosition>(said).size(), 500u);
  // They do not speak all at once: no second has more than a fifth of those of ten seconds.
  std::map<int, int> of_second;
  for (const auto& [time, report] : ais_of<nmea::AisPosition>(said)) {
    ++of_second[static_cast<int>(time)];
  }
  for (const auto& [second, messages] : of_second) EXPECT_LE(messages, 10) << second;
  EXPECT_LE(world.traffic_asked, 1001) << "the traffic is looked at ten times a second";
}

TEST(NavigationTalker, OneThatGathersWayDoesNotWaitForHerOldInterval) {
  TestWorld world;
  world.add(1, 3, 0.0);
  NavigationTalker talker(plan_of({{vdm, kAsAisDoes}}));
  listen(talker, world, 400.0, 0.1);
  world.items[0].speed_mps = 5.0;
  const auto reports = ais_of<nmea::AisPosition>(listen(talker, world, 412.0, 0.1, 400.1));
  ASSERT_FALSE(reports.empty());
  EXPECT_LE(reports[0].first, 410.2);
}

TEST(NavigationTalker, TellsOfTheNearestThousandStations) {
  TestWorld world;
  for (std::uint32_t i = 1; i <= 1500; ++i) world.add(i, 0.01 * i);
  NavigationTalker talker(plan_of({{vdm, 1s}}));
  const auto said = listen(talker, world, 1.9, 0.1);
  std::set<std::uint32_t> stations;
  for (const auto& [time, report] : ais_of<nmea::AisPosition>(said)) stations.insert(report.mmsi);
  EXPECT_EQ(stations.size(), NavigationTalker::kMostAis);
  EXPECT_EQ(*stations.rbegin(), 257'001'200u);
}

TEST(NavigationTalker, TargetsHaveRangeBearingAndClosestApproach) {
  TestWorld world;
  world.own.set_course_over_ground_deg(0.0);
  world.own.set_speed_over_ground_kn(10.0);
  world.add(1, 5.0, 20.0);  // head on: 5 minutes' latitude are 5.0017 NM at 60 N
  NavigationTalker talker(plan_of({{ttm, 1s}, {tll, 1s}, {ttd, 1s}}));
  const auto said = listen(talker, world, 0.0);
  ASSERT_EQ(said.size(), 3u);
  const auto ttm_line = nmea::parse_sentence(said[0].message.lines.at(0)).value();
  const auto target = nmea::decode_ttm(ttm_line).value();
  EXPECT_EQ(target.number, 1u);
  EXPECT_NEAR(target.range_nm, 5.014, 0.002) << "a minute of latitude is 1857 m at 60 N";
  EXPECT_NEAR(target.bearing_deg, 0.0, 0.05);
  EXPECT_NEAR(target.speed_kn.value(), 20.0, 0.05);
  EXPECT_EQ(target.course_deg, 180.0);
  EXPECT_NEAR(target.cpa_nm.value(), 0.0, 0.005);
  EXPECT_NEAR(target.tcpa_min.value(), 10.0, 0.06);
  EXPECT_EQ(target.name, "Target 1");
}

TEST(NavigationPlan, FaultsNameTheValueAndItsRange) {
  const auto fault = [](auto change) {
    NavigationPlan plan;
    change(plan);
    return fault_in(plan).value_or("none");
  };
  EXPECT_NE(fault([](auto& p) { p.periods[hdt] = 1ms; }).find("hdt is 0.001 s"), std::string::npos);
  EXPECT_NE(fault([](auto& p) { p.periods[hdt] = 0s; }).find("0.02 s"), std::string::npos);
  EXPECT_NE(fault([](auto& p) { p.periods[vdm] = 2h; }).find("3600 s"), std::string::npos);
  EXPECT_EQ(fault([](auto& p) { p.periods[vdm] = kAsAisDoes; }), "none");
  EXPECT_NE(fault([](auto& p) { p.static_period = 10ms; }).find("names"), std::string::npos);
  EXPECT_NE(fault([](auto& p) { p.own_mmsi = 1'000'000'000; }).find("MMSI"), std::string::npos);
  EXPECT_NE(fault([](auto& p) { p.ais_range_nm = 0; }).find("1 to 1000"), std::string::npos);
  EXPECT_NE(fault([](auto& p) { p.tracking_range_nm = 500; }).find("120"), std::string::npos);
  EXPECT_NE(fault([](auto& p) { p.tracked_targets = 100; }).find("99"), std::string::npos);
  EXPECT_EQ(find_navigation_sentence("ttd"), ttd);
  EXPECT_FALSE(find_navigation_sentence("TTD"));
  for (std::size_t i = 0; i < kNavigationSentences; ++i) {
    const auto sentence = static_cast<NavigationSentence>(i);
    EXPECT_EQ(find_navigation_sentence(name_of(sentence)), sentence);
  }
}

}  // namespace
}  // namespace skerry::server
