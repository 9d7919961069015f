// skerry coast judge, on a made-up coast and on Bergen's.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "echo/coast_tool/judge_command.hpp"
#include "echo/coast_tool/judge_run.hpp"
#include "echo/kernel/hash.hpp"
#include "tests/scenes/charts.hpp"

namespace skerry::echo {
namespace {

const CoastArea kArea{"islands", 59.9, 60.1, 9.8, 10.2};

// An island of 1500 vertices, wavy at all scales, and an islet of 8, at most 4 km from 60 N 10 E.
CoastChart wavy_islands() {
  CoastChart chart;
  chart.centre = kArea.centre();
  chart.radius_m = 20e3;
  chart.source = "made up";
  const auto add = [&](int corners, double radius_deg, double north, std::uint64_t identity) {
    CoastRing ring;
    for (int i = 0; i < corners; ++i) {
      const double turn = 6.283185307179586 * i / corners;
      double r = radius_deg;
      for (int wave = 3; wave < corners / 4; wave *= 2) {
        const double phase = 6.3 * as_unit(mixed(identity, static_cast<std::uint64_t>(wave)));
        r += 0.6 * radius_deg / wave * std::sin(wave * turn + phase);
      }
      // Counter-clockwise: land on the left.
      ring.vertices.push_back({60.0 + north + r * std::sin(turn), 10.0 + 2.0 * r * std::cos(turn)});
      ring.vertex_ids.push_back(mixed(identity, 1000000u + static_cast<std::uint64_t>(i)));
    }
    ring.edges.assign(ring.vertices.size(), EdgeKind::shoreline);
    chart.rings.push_back(std::move(ring));
  };
  add(1500, 0.02, 0.0, 1);
  add(8, 0.001, 0.06, 2);
  return chart;
}

const Telling kQuiet = [](const std::string&) {};

TEST(ThinnedCoast, KeepsANestedSubsetAndHoldsTheRestBack) {
  const CoastChart chart = wavy_islands();
  const ThinnedCoast coast(chart, kArea, 6);
  ASSERT_EQ(coast.coarse().rings.size(), 1u);  // the islet is too small to be thinned
  ASSERT_EQ(coast.fine().rings.size(), 1u);
  const CoastRing &fine = chart.rings[0], &coarse = coast.coarse().rings[0];
  ASSERT_EQ(coarse.vertices.size(), 250u);
  for (std::size_t i = 0; i < coarse.vertices.size(); ++i) {
    EXPECT_EQ(coarse.vertices[i], fine.vertices[6 * i]);
    EXPECT_EQ(coarse.vertex_ids[i], fine.vertex_ids[6 * i]);
  }
  ASSERT_EQ(coast.real().size(), 250u);
  const CoastPieces chords = coast.chords();
  for (std::size_t i = 0; i < coast.real().size(); ++i) {
    EXPECT_EQ(coast.real()[i].size(), 7u);
    EXPECT_EQ(coast.real()[i].front(), chords[i].front());
    EXPECT_EQ(coast.real()[i].back(), chords[i].back());
  }
}

TEST(ThinnedCoast, KeepsTheEndsOfStretchesAndNoBinBorder) {
  CoastChart chart = wavy_islands();
  // A border of two edges: the shore is the 1498 others, from vertex 702 around to vertex 700.
  chart.rings[0].edges[700] = chart.rings[0].edges[701] = EdgeKind::bin_border;
  const ThinnedCoast coast(chart, kArea, 6);
  const CoastRing& coarse = coast.coarse().rings[0];
  EXPECT_EQ(coast.real().size(), 250u);  // 249 of 6 edges and one of 4
  EXPECT_EQ(coarse.vertices.size(), 252u);
  int borders = 0;
  for (std::size_t i = 0; i < coarse.edges.size(); ++i) {
    if (coarse.edges[i] != EdgeKind::bin_border) continue;
    ++borders;
    EXPECT_EQ(coarse.vertex_ids[i], chart.rings[0].vertex_ids[699u + borders]);
  }
  EXPECT_EQ(borders, 2);
}

TEST(ThinnedCoast, EveryContestantJoinsWhereTheChartDoesAndDrawsTheSameForASeed) {
  ThinnedCoast coast(wavy_islands(), kArea, 6);
  const CoastPieces chords = coast.chords();
  as_printed::Parameters printed;
  printed.threshold_px = 10.0;
  printed.sigma_px = 3.0;
  printed.control_value_px = 0.0;
  std::vector<Contestant> all = {{"straight", CoastStyle{CoastMethod::straight, 1.0}}};
  for (CoastMethod m :
       {CoastMethod::random_koch, CoastMethod::midpoint, CoastMethod::weierstrass}) {
    all.push_back({"corrected", CoastStyle{m, 1.15}});
    printed.method = m;
    all.push_back({"printed", printed});
  }
  for (const Contestant& contestant : all) {
    const CoastPieces one = coast.drawn_by(contestant, 1, 2.0);
    ASSERT_EQ(one.size(), chords.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].front(), chords[i].front());
      EXPECT_EQ(one[i].back(), chords[i].back());
    }
    EXPECT_EQ(one, coast.drawn_by(contestant, 1, 2.0));
    EXPECT_EQ(one != coast.drawn_by(contestant, 2, 2.0), contestant.random()) << contestant.name;
  }
  EXPECT_EQ(coast.drawn_by(all[0], 1, 2.0), chords);
}

TEST(ThinnedCoast, RefusesACoastOfWhichTooLittleIsLeft) {
  try {
    ThinnedCoast(wavy_islands(), {"elsewhere", 10.0, 11.0, 10.0, 11.0}, 6);
    FAIL() << "not refused";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("only 0 edges"), std::string::npos) << error.what();
  }
}

TEST(Judge, SaysOfEachMethodWhatItMeasures) {
  const JudgeOptions options{.keep = 6, .seeds = 1, .scales_nm = {0.75}};
  const Judgement judgement = judge(wavy_islands(), kArea, options, kQuiet);
  ASSERT_EQ(judgement.methods.size(), 9u);
  const std::string text = judgement_text(judgement), csv = judgement_csv(judgement);
  for (const JudgedMethod& method : judgement.methods) {
    EXPECT_NE(text.find("\n" + method.name), std::string::npos) << method.name;
    EXPECT_NE(csv.find("islands,\"" + method.name + "\",1,,dimension_error,"), std::string::npos);
    EXPECT_NE(csv.find("islands,\"" + method.name + "\",1,0.75,outline_above_beam,"),
              std::string::npos);
  }
  EXPECT_NE(text.find("recorded: HALO20"), std::string::npos);
  EXPECT_EQ(judgement.methods[0].name, "conventional");
  EXPECT_EQ(judgement.methods[0].scores[0].depth_distance, 1.0);
  EXPECT_LT(judgement.methods[1].scores[0].depth_distance, 1.0);
}

TEST(Judge, IsTheSameEveryTimeAndAnotherForAnotherSeed) {
  const JudgeOptions options{.keep = 6, .seeds = 2, .scales_nm = {}};
  const Judgement judgement = judge(wavy_islands(), kArea, options, kQuiet);
  ASSERT_EQ(judgement.methods[0].scores.size(), 1u);  // nothing of chance in it
  ASSERT_EQ(judgement.methods[1].scores.size(), 2u);
  EXPECT_NE(judgement.methods[1].scores[0].apart_rms_m, judgement.methods[1].scores[1].apart_rms_m);
  const Judgement again = judge(wavy_islands(), kArea, options, kQuiet);
  EXPECT_EQ(judgement_text(again), judgement_text(judgement));
  EXPECT_EQ(judgement_csv(again), judgement_csv(judgement));
}

TEST(Judge, OfBergenPutsEveryCorrectedMethodBeforeTheConventionalOneButInPlace) {
  const CoastArea area{"bergen", 60.15, 60.4, 4.9, 5.3};
  const auto chart = scenes::world_chart(area.centre(), area.radius());
  if (!chart) GTEST_SKIP() << "no GSHHG chart is installed";
  const Judgement j = judge(*chart, area, {.seeds = 2, .scales_nm = {}}, kQuiet);
  const CoastScore& flat = j.methods.front().scores[0];
  for (std::size_t i = 1; i < j.methods.size(); ++i) {
    const JudgedMethod& method = j.methods[i];
    if (method.name.rfind("printed", 0) == 0) continue;
    for (const CoastScore& score : method.scores) {
      EXPECT_LT(score.dimension_error, 0.8 * flat.dimension_error) << method.name;
      EXPECT_LT(score.depth_distance, 0.6) << method.name;
      EXPECT_LT(score.spectrum_error, 0.75) << method.name;
      EXPECT_GT(score.apart_rms_m, flat.apart_rms_m) << method.name;
      EXPECT_LT(score.apart_rms_m, 1.25 * flat.apart_rms_m) << method.name;
    }
  }
}

int run(std::vector<std::string> words) {
  CLI::App app;
  const Command command = make_judge_command(app);
  std::reverse(words.begin(), words.end());
  words.push_back("judge");
  try {
    app.parse(words);
  } catch (const CLI::ParseError&) {
    return kExitUsage;
  }
  return command.run();
}

TEST(JudgeCommand, RefusesWhatItCannotDoWithTheRangeAllowed) {
  EXPECT_EQ(run({"--keep", "1"}), kExitUsage);
  EXPECT_EQ(run({"--seeds", "0"}), kExitUsage);
  EXPECT_EQ(run({"--place", "atlantis"}), kExitUsage);
  EXPECT_EQ(run({"--area", "60,5,61,6", "--place", "bergen"}), kExitUsage);
  testing::internal::CaptureStderr();
  EXPECT_EQ(run({"--ranges", "5"}), kExitUsage);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("0.75"), std::string::npos);
  EXPECT_EQ(run({"--area", "60,5"}), kExitUsage);
}

TEST(JudgeCommand, WritesItsTablesAndFigures) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const std::string shore = (folder / "judge_shore.geojson").string();
  const std::string out = (folder / "judge.txt").string(), csv = (folder / "judge.csv").string();
  {
    std::ofstream file(shore);
    file << R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)";
    const CoastChart chart = wavy_islands();
    const CoastRing& ring = chart.rings[0];
    file.precision(9);
    for (const GeoPoint p : ring.vertices)
      file << "[" << p.longitude_deg << "," << p.latitude_deg << "],";
    file << "[" << ring.vertices[0].longitude_deg << "," << ring.vertices[0].latitude_deg
         << "]]]}}";
  }
  EXPECT_EQ(run({"--chart", shore, "--area", "59.9,9.8,60.1,10.2", "--seeds", "1", "--no-pictures",
                 "-o", out, "--csv", csv}),
            kExitOk);
  const auto all_of = [](const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  EXPECT_NE(all_of(out).find("real coast, held back"), std::string::npos);
  EXPECT_EQ(all_of(csv).rfind("coast,method,seed,picture_nm,measure,value\n", 0), 0u);
  EXPECT_THROW(run({"--chart", shore, "--area", "59.9,9.8,60.1,10.2", "--seeds", "1",
                    "--no-pictures", "-o", (folder / "absent" / "x").string()}),
               std::runtime_error);
  for (const std::string& file : {shore, out, csv}) std::filesystem::remove(file);
}

}  // namespace
}  // namespace skerry::echo
