// Lists of targets as a server might send them.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/quantity/length.hpp"
#include "protocol/wire/targets.pb.h"

namespace skerry::client {

inline constexpr std::uint64_t kMadeAt_ns = 1'795'000'000'000'000'000;  // 2026-11-18, 11:06:40 UTC

inline wire::Target made_target(std::uint32_t number, double range_nm, double bearing_deg) {
  wire::Target target;
  target.set_number(number);
  target.set_state(wire::TARGET_TRACKED);
  target.set_range_m(nautical_miles(range_nm).in_metres());
  target.set_bearing_deg(bearing_deg);
  target.set_latitude_deg(60.5);
  target.set_longitude_deg(-5.25);
  target.set_age_s(1.2);
  return target;
}

inline wire::Target made_mover(std::uint32_t number, double range_nm, double cpa_nm,
                               double tcpa_min) {
  wire::Target target = made_target(number, range_nm, 45.0);
  target.set_course_deg(180.0);
  target.set_speed_kn(12.04);
  target.set_cpa_nm(cpa_nm);
  target.set_tcpa_min(tcpa_min);
  return target;
}

inline wire::Alert made_alert(std::uint32_t instance, wire::AlertState state) {
  wire::Alert alert;
  alert.set_number(3044);
  alert.set_instance(instance);
  alert.set_priority(wire::ALERT_ALARM);
  alert.set_state(state);
  alert.set_title("CPA/TCPA");
  alert.set_text("Target 3: CPA 0.2 NM in 8 min");
  alert.set_utc_ns(kMadeAt_ns);
  return alert;
}

// Three tracked targets and two of AIS, nothing else.
inline wire::TargetList made_list() {
  wire::TargetList list;
  list.set_utc_ns(kMadeAt_ns);
  list.set_stabilised_by("GNSS");
  list.set_own_course_deg(335.04);
  list.set_own_speed_kn(12.0);
  list.set_tracked(3);
  list.mutable_rules()->set_capacity(100);
  list.mutable_rules()->set_cpa_nm(1.0);
  *list.add_targets() = made_mover(2, 5.0, 1.5, 20.0);
  *list.add_targets() = made_mover(3, 9.0, 0.25, 8.0);
  *list.add_targets() = made_target(4, 1.0, 359.96);
  list.mutable_targets(2)->set_state(wire::TARGET_ACQUIRING);
  auto* ferry = list.add_ais();
  ferry->set_mmsi(2570100);
  ferry->set_name("FERRY, \"BLUE\"");
  ferry->set_range_m(3704.0);
  ferry->set_is_activated(true);
  list.add_ais()->set_mmsi(257000002);
  return list;
}

}  // namespace skerry::client
