#include "server/track_tool/plotter_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace skerry::server {
namespace {

struct Parsed {
  bool good = false;
  std::string said;
  Plotter::Rule rule;
};

Parsed parsed(std::vector<std::string> arguments) {
  CLI::App app;
  ChosenSettings settings;
  settings.add_options(app);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return {false, error.what(), {}};
  }
  return {true, "", settings.rule()};
}

TEST(PlotterSettings, EveryRowIsReadAndWrittenAtItsOwnPlace) {
  std::set<std::string> names;
  const Plotter::Rule usual;
  for (const PlotterSetting& setting : plotter_settings()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    EXPECT_LT(setting.least, setting.most) << setting.name;
    EXPECT_GE(setting.get(usual), setting.least) << setting.name;
    EXPECT_LE(setting.get(usual), setting.most) << setting.name;
    Plotter::Rule rule;
    setting.set(rule, setting.most);
    for (const PlotterSetting& other : plotter_settings()) {
      const double expected = other.name == setting.name ? setting.most : other.get(usual);
      EXPECT_EQ(other.get(rule), expected) << setting.name << " changes " << other.name;
    }
  }
}

TEST(PlotterSettings, ThePlotterTakesBothEndsOfEveryRange) {
  for (const PlotterSetting& setting : plotter_settings()) {
    for (const double value : {setting.least, setting.most}) {
      Plotter::Rule rule;
      setting.set(rule, value);
      EXPECT_NO_THROW(Plotter{rule}) << setting.name << " " << value;
    }
  }
}

TEST(PlotterSettings, TakesWhatIsInRangeAndRefusesTheRest) {
  EXPECT_EQ(parsed({}).rule.plots.beam_deg, Plotter::Rule{}.plots.beam_deg);
  for (const PlotterSetting& setting : plotter_settings()) {
    const std::string option = std::string("--") + setting.name;
    const Parsed most = parsed({option, std::to_string(setting.most)});
    EXPECT_TRUE(most.good) << most.said;
    EXPECT_EQ(setting.get(most.rule), setting.most) << setting.name;
    for (const std::string& wrong :
         {std::to_string(setting.least - 0.001), std::to_string(setting.most + 0.001),
          std::string("nan"), std::string("inf"), std::string("much")}) {
      const Parsed refused = parsed({option, wrong});
      EXPECT_FALSE(refused.good) << setting.name << " " << wrong;
      EXPECT_NE(refused.said.find(option), std::string::npos) << refused.said;
    }
    EXPECT_EQ(parsed({option, std::to_string(setting.least + 0.5)}).good, !setting.whole)
        << setting.name;
  }
}

TEST(PlotterSettings, KnowsWhatWasChosen) {
  CLI::App app;
  ChosenSettings settings;
  settings.add_options(app);
  std::vector<std::string> arguments = {"2", "--beam"};
  app.parse(arguments);
  EXPECT_TRUE(settings.has("beam"));
  EXPECT_FALSE(settings.has("pulse"));
  EXPECT_EQ(settings.rule().plots.beam_deg, 2.0);
}

TEST(PlotterSettings, HelpTellsRangeUnitAndDefault) {
  CLI::App app;
  ChosenSettings settings;
  settings.add_options(app);
  EXPECT_NE(app.help().find("0.1 to 10 deg (1.2)"), std::string::npos) << app.help();
  EXPECT_NE(app.help().find("1 to 1000 (200)"), std::string::npos) << app.help();
}

}  // namespace
}  // namespace skerry::server
