// A FakeHost with an own ship that can be driven, and ships around her.
#pragma once

#include <string>
#include <vector>

#include "tests/unit/net/fake_host.hpp"

namespace skerry::server {

class NavigationHost final : public FakeHost {
 public:
  using FakeHost::FakeHost;

  wire::OwnShip own_ship(std::uint32_t radar) const override {
    wire::OwnShip ship;
    ship.set_radar(radar);
    ship.set_name("Tern");
    ship.set_mmsi(257'000'111 + radar);
    ship.set_latitude_deg(60.425);
    ship.set_longitude_deg(5.04);
    ship.set_heading_deg(335);
    ship.set_course_over_ground_deg(335);
    ship.set_speed_kn(12);
    ship.set_speed_over_ground_kn(12);
    ship.set_utc_ns(1'795'252'087'060'000'000);
    ship.set_length_m(80);
    ship.set_beam_m(14);
    return ship;
  }

  // Own ship of radar 0 is among them.
  std::vector<TrafficItem> traffic() const override {
    std::vector<TrafficItem> items(2);
    items[0].number = 1;
    items[0].name = "Tern";
    items[0].mmsi = 257'000'111;
    items[0].position = {60.425, 5.04};
    items[0].radars = {0};
    items[1].number = 2;
    items[1].name = "Tanker";
    items[1].mmsi = 257'000'222;
    items[1].position = {60.445, 5.02};
    items[1].course_over_ground_deg = 160;
    items[1].speed_mps = 5;
    items[1].length_m = 182;
    items[1].beam_m = 32;
    return items;
  }

  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix& fix) override {
    const std::lock_guard lock(fixes_mutex_);
    if (radar != 0) return "radar 1 is ashore";
    fixes_.push_back(fix);
    return std::nullopt;
  }
  std::vector<OwnShipFix> fixes() const {
    const std::lock_guard lock(fixes_mutex_);
    return fixes_;
  }

 private:
  mutable std::mutex fixes_mutex_;
  std::vector<OwnShipFix> fixes_;
};

}  // namespace skerry::server
