// The built program `skerry`, whose command coast runs skerry-coast.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "server/app/options/coast_rules.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/clients/program.hpp"
#include "tests/unit/measure/exact_fbm.hpp"

namespace skerry::echo {
namespace {

using client::Program;
using client::test_folder;
using client::text_of_file;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Outcome {
  int code;
  std::string out, err;
};

Outcome coast(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "coast");
  Program program(std::move(arguments));
  const int code = program.wait();
  return {code, program.out(), program.err()};
}

// Koch's island: 674 km of coast around (50 N, 5 W) in edges of 55 m; `with_kinds`: rocky, and
// another one of artificial shore at 51 N.
std::string island(const std::string& folder, bool with_kinds) {
  const std::string file = folder + "/island.geojson";
  std::ofstream out(file);
  const auto add = [&](double north, const char* type) {
    out << R"({"type": "Feature", "properties": {)" << type
        << R"(}, "geometry": {"type": "Polygon", "coordinates": [[)";
    PlanePoint from{-20000.0, 10000.0};
    std::string first;
    for (double degrees : {0.0, -120.0, -240.0}) {
      const auto side = test::turned(test::koch_curve(6, 40000.0), degrees);
      for (PlanePoint p : side) {
        const PlanePoint at = from + p;
        char text[80];
        std::snprintf(text, sizeof text, "[%.7f, %.7f]", -5.0 + at.east_m / 71700.0,
                      north + at.north_m / 111200.0);
        if (first.empty()) first = text;
        out << text << ", ";
      }
      from = from + side.back();
    }
    out << first << "]]}}";
  };
  out << R"({"type": "FeatureCollection", "features": [)";
  add(50.0, with_kinds ? R"("type": "rocky")" : "");
  if (with_kinds) {
    out << ", ";
    add(51.0, R"("type": "artificial")");
  }
  out << "]}";
  return file;
}

std::string scenario_part(const std::string& out) { return out.substr(out.find("\ncoast:\n") + 1); }

// Rules read as skerryd reads them, behind an own ship.
CoastRules rules_of(const std::string& coast) {
  const std::string ship =
      "name: Test\nown_ships:\n  - name: Test\n    position: {lat: 60, lon: 5}\n    radars: [{}]\n";
  return server::coast_rules(server::parse_scenario(ship + coast, "test.yaml"));
}

TEST(FitCommand, MeasuresAChartAndGivesTheLinesOfAScenario) {
  const std::string folder = test_folder();
  const Outcome fit = coast({"fit", "--chart", island(folder, false), "--csv", folder + "/s.csv",
                             "--yaml", folder + "/c.yaml", "--method", "midpoint"});
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out,
              AllOf(StartsWith("chart ("), HasSubstr("chart island.geojson"),
                    HasSubstr("all coast: 674 km in 1 line, 12288 edges of 54.9 m"),
                    HasSubstr("D by octave"), HasSubstr("Extrapolated below the chart's mean edge"),
                    HasSubstr("midpoint: asked for"),
                    HasSubstr("  unknown: {method: midpoint, dimension: 1.2"),
                    HasSubstr("  rocky: {method: midpoint, dimension: 1.2")));
  EXPECT_EQ(scenario_part(fit.out), text_of_file(folder + "/c.yaml"));
  EXPECT_THAT(fit.err, Not(HasSubstr("counting")));  // no progress but on a terminal

  const CoastRules rules = rules_of(scenario_part(fit.out));
  const CoastStyle& rocky = rules.styles[static_cast<std::size_t>(CoastType::rocky)];
  EXPECT_EQ(rocky.method, CoastMethod::midpoint);
  EXPECT_NEAR(rocky.dimension, 1.262, 0.06);
  EXPECT_EQ(rules.styles[static_cast<std::size_t>(CoastType::unknown)], rocky);

  const std::string csv = text_of_file(folder + "/s.csv");
  EXPECT_THAT(csv, StartsWith("coast,scale_m,boxes,local_dimension_to_next,chords,middle_offset,"
                              "middle_offset_error,offset_dimension\nall,50,"));
  for (std::size_t at = 0, end; at < csv.size(); at = end + 1) {
    end = csv.find('\n', at);
    EXPECT_EQ(std::count(csv.begin() + static_cast<std::ptrdiff_t>(at),
                         csv.begin() + static_cast<std::ptrdiff_t>(end), ','),
              7)
        << csv.substr(at, end - at);
  }
}

TEST(FitCommand, MeasuresEachKindByItself) {
  const Outcome fit = coast({"fit", "--chart", island(test_folder(), true)});
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out, AllOf(HasSubstr("\nartificial coast: "), HasSubstr("\nrocky coast: "),
                             HasSubstr("  artificial: {method: straight, dimension: 1}\n"),
                             HasSubstr("  rocky: {method: "), Not(HasSubstr("  unknown: "))));
}

TEST(FitCommand, MapsStretches) {
  const std::string folder = test_folder();
  const Outcome fit = coast({"fit", "--chart", island(folder, false), "--stretches", "--stretch-km",
                             "50", "--yaml", folder + "/c.yaml"});
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out, AllOf(HasSubstr("13 stretches: D from 1."), HasSubstr("with a place for")));
  const CoastRules rules = rules_of(text_of_file(folder + "/c.yaml"));
  ASSERT_EQ(rules.places.size(), 13u);
  EXPECT_TRUE(rules.places[0].style.has_value());
  EXPECT_GT(rules.places[0].radius_m, 5000.0);
  EXPECT_NEAR(rules.places[0].centre.latitude_deg, 50.1, 0.4);
}

TEST(FitCommand, GivesTheSameTwice) {
  const std::string file = island(test_folder(), false);
  EXPECT_EQ(coast({"fit", "--chart", file}).out, coast({"fit", "--chart", file}).out);
}

TEST(FitCommand, SaysWhatIsWrongWhereAndWhatToDo) {
  const std::string file = island(test_folder(), false);
  struct Case {
    std::vector<std::string> arguments;
    int code;
    const char* text;
  };
  for (const Case& c :
       {Case{{"fit", "--chart", file, "--area", "1,2,3"}, 2, "3 numbers; expected two opposite"},
        Case{{"fit", "--chart", file, "--area", "10,10,11,11"}, 1, "no coast in area (10..11 N"},
        Case{{"fit", "--chart", file, "--from", "10000", "--to", "40000"}, 1, "Take a larger area"},
        Case{{"fit", "--chart", "/nowhere/x.000"}, 1, "/nowhere/x.000"},
        Case{{"fit", "--chart", file + ".txt"}, 1, "expected"},
        Case{{"fit", "--place", "london"}, 2, "london"},
        Case{{"fit", "--place", "bergen", "--area", "1,2,3,4"}, 2, "excludes"},
        Case{{"fit", "--chart", file, "--method", "circle"}, 2, "random_koch"},
        Case{{"fit", "--chart", file, "--from", "50", "--to", "150"}, 2, "four times --from"},
        Case{{"fit", "--chart", file, "--from", "-1"}, 2, "--from"},
        Case{{"fit", "--chart", file, "--csv", "/nowhere/x.csv"}, 1, "cannot write /nowhere/x.csv"},
        Case{{}, 2, "SUBCOMMAND"}, Case{{"frobnicate"}, 2, "subcommand"}}) {
    const Outcome fit = coast(c.arguments);
    EXPECT_EQ(fit.code, c.code) << c.text;
    EXPECT_THAT(fit.err, HasSubstr(c.text));
    EXPECT_EQ(fit.out, "");
  }
}

TEST(FitCommand, HasHelpWithExamples) {
  const Outcome help = coast({"fit", "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("skerry coast fit --place bergen"), HasSubstr("--area"),
                              HasSubstr("--stretches")));
}

TEST(CoastCommand, SaysThatTheToolIsMissing) {
  const std::string folder = test_folder();
  const std::filesystem::path lone = folder + "/skerry";
  std::filesystem::copy_file(SKERRY_PROGRAM, lone);
  const std::string command = "PATH=/nowhere " + lone.string() + " coast fit 2> " + folder + "/err";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_THAT(text_of_file(folder + "/err"),
              AllOf(HasSubstr("no program skerry-coast beside " + lone.string()),
                    HasSubstr("nor in PATH"), HasSubstr("put skerry-coast into " + folder)));
}

TEST(CoastCommand, FindsTheToolInThePathToo) {
  const std::string folder = test_folder();
  std::filesystem::copy_file(SKERRY_PROGRAM, folder + "/skerry");
  const std::string tools = std::filesystem::path(SKERRY_PROGRAM).parent_path().string();
  const std::string command =
      "PATH=" + tools + " " + folder + "/skerry coast --version > " + folder + "/out";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(text_of_file(folder + "/out"), StartsWith("skerry-coast "));
}

}  // namespace
}  // namespace skerry::echo
