#include "server/debrief/csv_files.hpp"

#include <fmt/format.h>

#include <iterator>

#include "server/debrief/deeds.hpp"
#include "server/debrief/words.hpp"
#include "server/page/csv_table.hpp"

namespace skerry::server {
namespace {

CsvTable& operator<<(CsvTable& csv, const Moment& when) {
  return csv.fixed(when.at_s, 3).fixed(when.exercise_s, 3);
}
CsvTable& operator<<(CsvTable& csv, GeoPoint place) {
  return csv.fixed(place.latitude_deg, 7).fixed(place.longitude_deg, 7);
}

std::string tracks_csv(const std::vector<ShipTrack>& tracks) {
  CsvTable csv(
      "at_s,exercise_s,ship,latitude_deg,longitude_deg,heading_deg,course_over_ground_deg,speed_kn,"
      "rate_of_turn_deg_min,rudder_deg,shaft_rpm,engine_percent");
  for (const ShipTrack& track : tracks) {
    for (const TrackPoint& point : track.points) {
      csv << point.when << track.name << point.position << point.heading_deg
          << point.course_over_ground_deg << point.speed_kn << point.turn_deg_min
          << point.rudder_deg << point.shaft_rpm << point.engine_percent;
      csv.end();
    }
  }
  return csv.take();
}

std::string passings_csv(const Debrief& debrief) {
  CsvTable csv(
      "at_s,exercise_s,own_ship,other,least_range_m,bearing_deg,side_of_own_ship_deg,"
      "side_of_other_deg,passed,under_limit_from_s,under_limit_s,least_forecast_m");
  for (const ShipPassing& passing : debrief.passings) {
    std::optional<double> from_s, least_m;
    if (passing.first_under) {
      from_s = passing.first_under->at_s;
      least_m = passing.least_forecast_m;
    }
    csv << passing.when << passing.own_name << passing.other_name << passing.closest_m
        << passing.bearing_deg << passing.own_side_deg << passing.other_side_deg
        << side_text(passing) << from_s << passing.under_limit_s << least_m;
    csv.end();
  }
  return csv.take();
}

std::string ranges_csv(const Debrief& debrief) {
  CsvTable csv("at_s,own_ship,other,range_nm");
  for (const ShipPassing& passing : debrief.passings) {
    for (const ShipPassing::Range& range : passing.ranges) {
      csv << range.at_s << passing.own_name << passing.other_name << range.range_nm;
      csv.end();
    }
  }
  return csv.take();
}

std::string mishaps_csv(const Debrief& debrief) {
  CsvTable csv("at_s,exercise_s,kind,own_ship,other,latitude_deg,longitude_deg,speed_kn,why");
  for (std::size_t i = 0; i < debrief.contacts.size(); ++i) {
    const Contact& contact = debrief.contacts[i];
    csv << debrief.contact_moments[i] << kind_of(contact) << contact.own_name << contact.other_name
        << contact.position << contact.relative_mps * 3600.0 / 1852.0 << contact.why;
    csv.end();
  }
  return csv.take();
}

std::string timeline_csv(const Debrief& debrief) {
  CsvTable csv("at_s,exercise_s,kind,who,text");
  for (const HappenedLine& line : debrief.happened) {
    csv << line.when << line.kind << line.who << line.text;
    csv.end();
  }
  return csv.take();
}

std::string reactions_csv(const Debrief& debrief) {
  CsvTable csv("at_s,exercise_s,own_ship,stimulus,helm_after_s,engine_after_s,setting_after_s");
  for (const Reaction& reaction : debrief.reactions) {
    csv << reaction.when << reaction.own_name << reaction.stimulus << reaction.helm_s
        << reaction.engine_s << reaction.setting_s;
    csv.end();
  }
  return csv.take();
}

std::string checks_csv(const Debrief& debrief) {
  CsvTable csv("at_s,exercise_s,check,result,detail");
  for (const JudgedCheck& check : debrief.checks) {
    std::string detail;
    for (const auto& [passed, text] : check.lines) {
      detail += (detail.empty() ? "" : "; ") + std::string(passed ? "pass " : "FAIL ") + text;
    }
    csv << check.when << check.says
        << (!check.reached ? "not reached"
            : check.passed ? "passed"
                           : "failed")
        << detail;
    csv.end();
  }
  return csv.take();
}

CsvTable& operator<<(CsvTable& csv, const KnownView& view) {
  return csv << view.own_name << view.radar << std::size_t{view.view};
}
CsvTable& operator<<(CsvTable& csv, const std::optional<Moment>& when) {
  return csv << (when ? std::optional(when->at_s) : std::nullopt);
}

std::string known_targets_csv(const Debrief& debrief) {
  CsvTable csv(
      "at_s,exercise_s,own_ship,radar,view,target,name,by_hand,until_s,ending,least_cpa_nm,"
      "tcpa_min,least_cpa_at_s");
  for (const KnownView& view : debrief.known) {
    for (const KnownTarget& target : view.targets) {
      std::optional<Moment> least;
      if (target.least_cpa_nm) least = target.least_when;
      csv << target.first << view << std::size_t{target.number} << target.name
          << std::size_t{target.by_hand} << target.last.at_s << ending_text(target)
          << target.least_cpa_nm << target.tcpa_min << least;
      csv.end();
    }
  }
  return csv.take();
}

std::string known_alerts_csv(const Debrief& debrief) {
  CsvTable csv(
      "at_s,exercise_s,own_ship,radar,view,number,instance,priority,title,text,acknowledged_s,"
      "reaction_s,ended_s");
  for (const KnownView& view : debrief.known) {
    for (const KnownAlert& alert : view.alerts) {
      csv << alert.raised << view << std::size_t{alert.number} << std::size_t{alert.instance}
          << alert.priority << alert.title << alert.text << alert.acknowledged << alert.reaction_s()
          << alert.ended;
      csv.end();
    }
  }
  return csv.take();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> csv_files(const Debrief& debrief) {
  return {{"own_ships.csv", tracks_csv(debrief.own_ships)},
          {"targets.csv", tracks_csv(debrief.targets)},
          {"passings.csv", passings_csv(debrief)},
          {"ranges.csv", ranges_csv(debrief)},
          {"mishaps.csv", mishaps_csv(debrief)},
          {"timeline.csv", timeline_csv(debrief)},
          {"reactions.csv", reactions_csv(debrief)},
          {"checks.csv", checks_csv(debrief)},
          {"known_targets.csv", known_targets_csv(debrief)},
          {"known_alerts.csv", known_alerts_csv(debrief)},
          {"deeds.csv", deeds_csv(debrief)}};
}

}  // namespace skerry::server
