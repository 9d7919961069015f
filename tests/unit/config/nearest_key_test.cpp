#include "server/config/nearest_key.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace skerry::server {
namespace {

// The recursive definition of the optimal string alignment distance.
std::size_t distance_reference(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const std::string a1 = a.substr(1), b1 = b.substr(1);
  std::size_t least = std::min({distance_reference(a1, b) + 1, distance_reference(a, b1) + 1,
                                distance_reference(a1, b1) + (a[0] != b[0])});
  if (a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0]) {
    least = std::min(least, distance_reference(a.substr(2), b.substr(2)) + 1);
  }
  return least;
}

TEST(EditDistance, IsItsRecursiveDefinition) {
  std::mt19937 random(1);
  const auto word = [&] {
    std::string text(random() % 6, ' ');
    for (char& c : text) c = static_cast<char>('a' + random() % 3);
    return text;
  };
  for (int i = 0; i < 2000; ++i) {
    const std::string a = word(), b = word();
    ASSERT_EQ(edit_distance(a, b), distance_reference(a, b)) << a << " " << b;
  }
  EXPECT_EQ(edit_distance("spokse", "spokes"), 1u);
}

TEST(NearestKey, FindsASlipOfTheKeyboardAndNothingFarther) {
  const std::vector<std::string> known = {"name", "position", "course_deg", "speed_kn", "rpm"};
  EXPECT_EQ(nearest_key("nmae", known), "name");
  EXPECT_EQ(nearest_key("postion", known), "position");
  EXPECT_EQ(nearest_key("speed_km", known), "speed_kn");
  EXPECT_EQ(nearest_key("rmp", known), "rpm");
  EXPECT_EQ(nearest_key("course", known), "") << "four of six letters";
  EXPECT_EQ(nearest_key("gain", known), "");
  EXPECT_EQ(nearest_key("", known), "");
  EXPECT_EQ(nearest_key(std::string(100'000, 'a'), known), "");
}

}  // namespace
}  // namespace skerry::server
