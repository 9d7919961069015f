// A sea of made plots, a plotter without video that gets them, and the watch over it.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/tracking/watch/target_watch.hpp"
#include "server/tracking/watch/vectors.hpp"
#include "tests/unit/plotter/made_plots.hpp"
#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {

// By an antenna of 24 turns a minute; an update after each of them.
struct WatchedSea {
  static constexpr double kTurn_s = 2.5;

  MadeSea sea;
  PlanePoint own_mps;      // over ground
  PlanePoint current_mps;  // the water's
  double heading_deg = 0.0;
  bool has_heading = true, has_place = true, has_log = true, has_gnss = true;
  std::vector<AisContact> ais;
  std::function<void(double)> before_update = [](double) {};  // at that time

  TargetWatch watch{1, 2};
  Plotter plotter{watch.plotter_rule()};
  double now_s = 0.0;

  WatchedSea() {
    wire::TargetOrder all;
    all.mutable_rules()->set_acquire(wire::AUTO_ACQUIRE_ALL);
    order(all);
  }
  void set_own_way(double course_deg, double speed_kn) {
    sea.own = straight_way({}, course_deg, speed_kn);
    own_mps = vector_of(course_deg, speed_kn * kKnot);
    heading_deg = course_deg;
  }

  OwnSensors sensors() const {
    OwnSensors own;
    own.utc = utc_at(now_s);
    if (has_place) own.place = sea.geo(sea.own(now_s));
    if (has_heading) own.heading_deg = heading_deg;
    if (has_gnss && has_place) own.over_ground_mps = own_mps;
    if (has_log && has_heading) own.through_water_mps = own_mps - current_mps;
    return own;
  }
  void update() {
    before_update(now_s);
    watch.update(sensors(), ais, plotter);
  }
  // Whole turns; while heading or position is lost the plotter gets nothing.
  void go_on_for(double seconds) {
    const double until_s = now_s + seconds;
    while (now_s + kTurn_s <= until_s + 1e-6) {
      if (TargetWatch::can_plot(sensors())) {
        ++sea.seed;
        sail(sea, plotter.tracker(), now_s, now_s + kTurn_s);
      }
      now_s += kTurn_s;
      update();
    }
  }

  wire::Reply order(const wire::TargetOrder& order) { return watch.order(order, plotter); }
  const wire::TargetList& list() const { return watch.list(); }
  // nullptr: no such target.
  const wire::Target* target(std::uint32_t number) const {
    for (const wire::Target& target : list().targets()) {
      if (target.number() == number) return &target;
    }
    return nullptr;
  }
  const wire::AisTarget* ais_target(std::uint32_t mmsi) const {
    for (const wire::AisTarget& target : list().ais()) {
      if (target.mmsi() == mmsi) return &target;
    }
    return nullptr;
  }
  std::vector<wire::Alert> alerts(std::uint32_t number) const {
    std::vector<wire::Alert> found;
    for (const wire::Alert& alert : list().alerts()) {
      if (alert.number() == number) found.push_back(alert);
    }
    return found;
  }
  // The first of that number; an empty one if there is none.
  wire::Alert alert(std::uint32_t number) const {
    const auto found = alerts(number);
    return found.empty() ? wire::Alert{} : found.front();
  }
  // "3044 3048": in the order in which they are told.
  std::string alert_numbers() const {
    std::string numbers;
    for (const wire::Alert& alert : list().alerts()) {
      numbers += (numbers.empty() ? "" : " ") + std::to_string(alert.number());
    }
    return numbers;
  }
  wire::Reply acknowledge(std::uint32_t number, std::uint32_t instance = 0) {
    wire::TargetOrder acknowledge;
    auto& key = *acknowledge.add_acknowledge();
    key.set_number(number);
    key.set_instance(instance);
    return order(acknowledge);
  }
};

// A ship that tells where she is by AIS, at the moment of each update.
inline void tell_by_ais(WatchedSea& sea, std::uint32_t mmsi, const Way& way, double course_deg,
                        double speed_kn, const std::string& name = "ALMA") {
  const auto before = sea.before_update;
  sea.before_update = [=, &sea](double t) {
    before(t);
    std::erase_if(sea.ais, [&](const AisContact& contact) { return contact.mmsi == mmsi; });
    sea.ais.push_back({.mmsi = mmsi,
                       .name = name,
                       .place = sea.sea.geo(way(t)),
                       .course_deg = course_deg,
                       .speed_mps = speed_kn * kKnot,
                       .heading_deg = course_deg,
                       .utc = utc_at(t)});
  };
}

}  // namespace skerry::server
