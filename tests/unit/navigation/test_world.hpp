// A world that a talker can be asked about, and what it said, sorted.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "protocol/nmea/sentence.hpp"
#include "server/navigation/navigation_talker.hpp"

namespace skerry::server {

class TestWorld final : public NavigationWorld {
 public:
  TestWorld() {
    own.set_name("Tern");
    own.set_mmsi(257'000'111);
    own.set_latitude_deg(60.0);
    own.set_longitude_deg(5.0);
    own.set_heading_deg(10.0);
    own.set_course_over_ground_deg(20.0);
    own.set_speed_kn(11.0);
    own.set_speed_over_ground_kn(12.0);
    own.set_rate_of_turn_deg_min(3.0);
    own.set_utc_ns(1'795'252'087'060'000'000);
    own.set_length_m(80);
    own.set_beam_m(14);
    set.set_range_nm(6);
  }
  wire::OwnShip own_ship() const override { return own; }
  wire::Settings settings() const override { return set; }
  std::vector<TrafficItem> traffic() const override {
    ++traffic_asked;
    return items;
  }

  std::shared_ptr<const wire::TargetList> targets() const override { return list; }

  // A ship north of own ship by so many miles.
  TrafficItem& add(std::uint32_t number, double north_nm, double speed_kn = 10.0,
                   TrafficKind kind = TrafficKind::ship) {
    TrafficItem item;
    item.number = number;
    item.kind = kind;
    item.name = "Target " + std::to_string(number);
    item.mmsi = 257'000'200 + number;
    item.position = {60.0 + north_nm / 60.0, 5.0};
    item.course_over_ground_deg = 180.0;
    item.heading_deg = 181.0;
    item.speed_mps = speed_kn * 1852.0 / 3600.0;
    item.length_m = 100;
    item.beam_m = 16;
    items.push_back(item);
    return items.back();
  }

  wire::OwnShip own;
  wire::Settings set;
  std::vector<TrafficItem> items;
  std::shared_ptr<const wire::TargetList> list;  // the plotter's
  mutable int traffic_asked = 0;
};

inline ScenarioTime at_seconds(double s) { return ScenarioTime(seconds_as_duration(s)); }

}  // namespace skerry::server
