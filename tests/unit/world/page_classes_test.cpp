// The instructor's page names the classes of ships that the server has.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include "server/world/handling/ship_class.hpp"
#include "server/world/traffic/traffic_class.hpp"

namespace skerry::server {
namespace {

using Words = std::set<std::string>;

// The words of `export const NAME = ...;` in the page's table.
Words words_of_page(const std::string& name) {
  std::ifstream file(SKERRY_SOURCE_DIR "/clients/web/src/exercise/ship_classes.js");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = text.find("export const " + name + " = ");
  if (begin == std::string::npos) return {};
  std::string list = text.substr(begin, text.find(';', begin) - begin);
  list = list.substr(list.find('=') + 1, list.find(".split") - list.find('=') - 1);
  static const std::regex word("[a-z_]+");
  return {std::sregex_token_iterator(list.begin(), list.end(), word), std::sregex_token_iterator()};
}

TEST(PageClasses, AreTheServers) {
  Words own, targets;
  for (const ShipClass& each : ship_classes()) own.emplace(each.key);
  for (const TrafficClass& each : traffic_classes()) targets.emplace(each.key);
  EXPECT_EQ(words_of_page("OWN_SHIP_CLASSES"), own);
  EXPECT_EQ(words_of_page("TARGET_CLASSES"), targets);
}

}  // namespace
}  // namespace skerry::server
