#include "server/world/traffic/traffic_class.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "server/config/nearest_key.hpp"

namespace skerry::server {
namespace {

// Those that own ships have as well (handling/ship_class.hpp) are alike in size and service speed.
// clang-format off
constexpr std::array<TrafficClass, 19> kClasses = {{
    // key          length beam height draught sigma  service most  deg/min turn speed  type, class B
    {"vlcc",        320.0, 58.0, 30.0, 20.8, 0.0, 15.5, 17.0,  20.0, 25.0, 300.0, scenario::tanker, false},
    {"tanker",      305.0, 47.2, 28.0, 18.5, 0.0, 16.0, 17.5,  20.0, 25.0, 280.0, scenario::tanker, false},
    {"cruise",      300.0, 37.0, 52.0,  8.3, 0.0, 20.0, 23.0,  35.0, 15.0, 160.0, scenario::passenger, false},
    {"bulker",      225.0, 32.3, 24.0, 14.2, 0.0, 14.0, 15.5,  25.0, 20.0, 220.0, scenario::cargo, false},
    {"container",   175.0, 25.4, 26.0,  9.5, 0.0, 16.3, 21.0,  35.0, 15.0, 150.0, scenario::cargo, false},
    {"mariner",     160.0, 23.2, 22.0,  7.5, 0.0, 15.0, 18.0,  35.0, 15.0, 130.0, scenario::cargo, false},
    {"product_tanker", 145.0, 23.0, 20.0, 9.0, 0.0, 13.5, 15.0, 35.0, 15.0, 140.0, scenario::tanker, false},
    {"naval",       135.0, 17.0, 28.0,  5.0, 0.0, 18.0, 29.0,  90.0,  7.0,  50.0, scenario::naval, false},
    {"ferry",       120.0, 20.0, 24.0,  5.5, 0.0, 18.0, 21.0,  60.0,  8.0,  60.0, scenario::passenger, false},
    {"dredger",      95.0, 18.0, 18.0,  6.0, 0.0, 10.0, 13.0,  45.0, 10.0,  80.0, scenario::dredger, false},
    {"coaster",      80.0, 13.0, 14.0,  5.2, 0.0, 12.0, 14.0,  50.0,  9.0,  70.0, scenario::cargo, false},
    {"fast_ferry",   42.0, 11.0, 11.0,  1.7, 0.0, 32.0, 37.0,  90.0,  4.0,  20.0, scenario::high_speed_craft, false},
    {"fast_craft",   38.0,  7.2, 10.0,  1.6, 0.0, 28.0, 34.0, 120.0,  4.0,  18.0, scenario::high_speed_craft, false},
    {"fishing",      30.0,  8.0, 11.0,  3.2, 0.0, 10.0, 12.0, 100.0,  5.0,  25.0, scenario::fishing, false},
    {"tug",          28.0, 10.0, 12.0,  3.8, 0.0, 10.0, 13.5, 150.0,  4.0,  20.0, scenario::tug, false},
    {"yacht",        18.0,  5.0,  6.0,  1.3, 0.0, 16.0, 26.0, 200.0,  3.0,  10.0, scenario::pleasure_craft, true},
    {"pilot",        14.0,  4.4,  5.0,  1.1, 0.0, 20.0, 26.0, 240.0,  3.0,   8.0, scenario::pilot, false},
    {"sailing",      12.0,  3.8, 10.0,  2.0, 5.0,  5.5,  9.0, 150.0,  3.0,  15.0, scenario::sailing, true},
    {"boat",          7.0,  2.5,  2.0,  0.5, 2.5, 15.0, 35.0, 360.0,  2.0,   5.0, scenario::pleasure_craft, true},
}};
// clang-format on

}  // namespace

std::span<const TrafficClass> traffic_classes() { return kClasses; }

const TrafficClass* find_traffic_class(std::string_view key) {
  for (const TrafficClass& c : kClasses) {
    if (c.key == key) return &c;
  }
  return nullptr;
}

const TrafficClass& traffic_class_of_length(double length_m) {
  const TrafficClass* nearest = &kClasses.front();
  for (const TrafficClass& c : kClasses) {
    if (std::fabs(c.length_m - length_m) < std::fabs(nearest->length_m - length_m)) nearest = &c;
  }
  return *nearest;
}

std::string traffic_class_keys() {
  std::string keys;
  for (const TrafficClass& c : kClasses) {
    if (!keys.empty()) keys += ", ";
    keys += c.key;
  }
  return keys;
}

std::string nearest_traffic_class(const std::string& key) {
  std::vector<std::string> keys;
  for (const TrafficClass& c : kClasses) keys.emplace_back(c.key);
  return nearest_key(key, keys);
}

}  // namespace skerry::server
