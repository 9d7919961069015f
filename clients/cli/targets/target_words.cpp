#include "clients/cli/targets/target_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "clients/cli/field_words.hpp"
#include "protocol/picture/label_text.hpp"
#include "protocol/quantity/length.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

using wire::AisTarget;
using wire::FieldDescriptor;
using wire::Target;
using wire::TargetList;

constexpr std::size_t kNameLength = 20;  // as AIS has it

std::string joined(std::string text, const std::string& more) {
  return more.empty() ? text : text + (text.empty() ? "" : ", ") + more;
}

std::string in_miles(double m) { return figure(metres(m).in_nautical_miles(), 2); }

template <typename T>
std::string notes_of_both(const T& target) {
  return target.is_dangerous() ? "DANGEROUS" : "";
}

std::string notes_of(const Target& target) {
  std::string notes = notes_of_both(target);
  if (target.is_new()) notes = joined(notes, "new");
  if (target.is_reference()) notes = joined(notes, "reference");
  if (target.is_test()) notes = joined(notes, "TEST TARGET: no echo");
  if (target.state() == wire::TARGET_FROZEN) notes = joined(notes, "where it was");
  if (target.by_hand()) notes = joined(notes, "by hand");
  return notes;
}

std::string notes_of(const AisTarget& target) {
  std::string notes = notes_of_both(target);
  if (target.target() != 0) notes = joined(notes, fmt::format("target {}", target.target()));
  return notes;
}

std::string state_of(const Target& target) {
  return wire::word_of(*wire::TargetState_descriptor(), target.state());
}
std::string state_of(const AisTarget& target) {
  if (target.is_lost()) return "lost";
  return target.is_activated() ? "activated" : "sleeping";
}

std::string name_of(const Target& target) {
  const std::string name = printable(target.name(), kNameLength);
  if (target.mmsi() == 0) return name;
  return fmt::format("{:09}{}{}", target.mmsi(), name.empty() ? "" : " ", name);
}
std::string name_of(const AisTarget& target) { return printable(target.name(), kNameLength); }

std::string number_of(const Target& target) { return fmt::format("{}", target.number()); }
std::string number_of(const AisTarget& target) { return fmt::format("{:09}", target.mmsi()); }

template <typename T>
std::string row_of(const T& target) {
  const auto or_dash = [](bool is_there, const std::string& text) { return is_there ? text : "-"; };
  std::string row = fmt::format(
      "{:>9}  {:<9} {:>8} {:>7} {:>7} {:>8} {:>7} {:>8} {:>6}  {:<{}}  {}", number_of(target),
      state_of(target), in_miles(target.range_m()), direction(target.bearing_deg()),
      or_dash(target.has_course_deg(), direction(target.course_deg())),
      or_dash(target.has_speed_kn(), figure(target.speed_kn(), 1)),
      or_dash(target.has_cpa_nm(), figure(target.cpa_nm(), 2)),
      or_dash(target.has_tcpa_min(), figure(target.tcpa_min(), 1)), figure(target.age_s(), 0),
      name_of(target), kNameLength + 10, notes_of(target));
  row.erase(row.find_last_not_of(' ') + 1);
  return row + "\n";
}

std::string heading_of(const char* number) {
  return fmt::format("{:>9}  {:<9} {:>8} {:>7} {:>7} {:>8} {:>7} {:>8} {:>6}  {:<{}}  {}\n", number,
                     "STATE", "RANGE NM", "BEARING", "COURSE", "SPEED KN", "CPA NM", "TCPA MIN",
                     "AGE S", "NAME", kNameLength + 10, "NOTES");
}

std::uint32_t key_of(const Target& target) { return target.number(); }
std::uint32_t key_of(const AisTarget& target) { return target.mmsi(); }

// A NaN would have no place in any order.
double in_any_order(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

template <typename T>
std::vector<const T*> in_order(const google::protobuf::RepeatedPtrField<T>& targets,
                               TargetSort sort) {
  const auto rank = [&](const T& target) {
    if (sort == TargetSort::number) return std::tuple(0, 0.0, key_of(target));
    if (sort == TargetSort::range) {
      return std::tuple(0, in_any_order(target.range_m()), key_of(target));
    }
    if (!target.has_cpa_nm()) return std::tuple(2, in_any_order(target.range_m()), key_of(target));
    const bool is_past = target.has_tcpa_min() && target.tcpa_min() < 0.0;
    return std::tuple(is_past ? 1 : 0, in_any_order(target.cpa_nm()), key_of(target));
  };
  std::vector<const T*> sorted;
  for (const T& target : targets) sorted.push_back(&target);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const T* a, const T* b) { return rank(*a) < rank(*b); });
  return sorted;
}

std::string own_ship_of(const TargetList& list) {
  std::string text;
  if (list.has_own_course_deg()) {
    text = fmt::format("course {} at {} kn", direction(list.own_course_deg()),
                       figure(list.own_speed_kn(), 1));
  }
  if (list.has_own_heading_deg())
    text = joined(text, "heading " + direction(list.own_heading_deg()));
  return text.empty() ? "her motion and heading are not known" : text;
}

std::string alerts_of(const TargetList& list) {
  if (list.alerts().empty()) return "";
  std::string out = fmt::format("\n{:<10} {:<8} {:<13} {:<8}  {}\n", "ALERT", "PRIORITY", "STATE",
                                "SINCE", "TEXT");
  for (const wire::Alert& alert : list.alerts()) {
    out += fmt::format("{:<10} {:<8} {:<13} {:<8}  {}: {}\n",
                       fmt::format("{}.{}", alert.number(), alert.instance()),
                       wire::word_of(*wire::AlertPriority_descriptor(), alert.priority()),
                       wire::word_of(*wire::AlertState_descriptor(), alert.state()),
                       clock_in_words(alert.utc_ns()), printable(alert.title(), 16),
                       printable(alert.text(), 200));
  }
  return out;
}

// As spreadsheets read it: names come from the air.
std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : printable(text, 40)) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_number(bool is_there, double value, int decimals) {
  if (!is_there || !std::isfinite(value)) return "";
  return fmt::format("{:.{}f}", value, decimals);
}

// What both kinds have, from `state` to `age_s`.
template <typename T>
std::string csv_middle(const T& target) {
  return fmt::format("{},{},{},{},{},{},{},{}", state_of(target),
                     csv_number(true, metres(target.range_m()).in_nautical_miles(), 4),
                     csv_number(true, target.bearing_deg(), 2),
                     csv_number(target.has_course_deg(), target.course_deg(), 2),
                     csv_number(target.has_speed_kn(), target.speed_kn(), 2),
                     csv_number(target.has_cpa_nm(), target.cpa_nm(), 4),
                     csv_number(target.has_tcpa_min(), target.tcpa_min(), 2),
                     csv_number(true, target.age_s(), 1));
}

template <typename T>
std::string csv_place(const T& target) {
  return fmt::format("{},{}", csv_number(true, target.latitude_deg(), 6),
                     csv_number(true, target.longitude_deg(), 6));
}

}  // namespace

std::string figure(double value, int decimals) {
  if (!(std::abs(value) < 1e6)) return "-";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
  return text;
}

std::string direction(double degrees) {
  if (!(std::abs(degrees) < 1e6)) return "-";
  std::string text = bearing_text(degrees - 360.0 * std::floor(degrees / 360.0));
  text.pop_back();  // the picture's degree sign
  return text;
}

std::string clock_in_words(std::uint64_t utc_ns) {
  const std::uint64_t seconds = utc_ns / 1'000'000'000;
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
}

std::string alert_in_words(const wire::Alert& alert) {
  return fmt::format("{} {}.{} {}",
                     wire::word_of(*wire::AlertPriority_descriptor(), alert.priority()),
                     alert.number(), alert.instance(), printable(alert.title(), 16));
}

std::string zone_in_words(const wire::TargetZone& zone) {
  const std::string sector =
      zone.from_deg() == zone.to_deg()
          ? "all round"
          : fmt::format("{} to {} from {}", direction(zone.from_deg()), direction(zone.to_deg()),
                        zone.relative() ? "the bow" : "north");
  return fmt::format("zone {}: {}, {} to {} NM, {}", zone.number(),
                     wire::word_of(*wire::TargetZone::Kind_descriptor(), zone.kind()),
                     figure(zone.inner_nm(), 2), figure(zone.outer_nm(), 2), sector);
}

std::string trial_in_words(const wire::TrialOrder& order) {
  std::string text = fmt::format("course {} at {} kn in {} min", direction(order.course_deg()),
                                 figure(order.speed_kn(), 1), figure(order.delay_min(), 1));
  if (order.turn_rate_deg_min() > 0.0) {
    text += fmt::format(", {} deg/min", figure(order.turn_rate_deg_min(), 0));
  }
  if (order.acceleration_kn_min() > 0.0) {
    text += fmt::format(", {} kn/min", figure(order.acceleration_kn_min(), 1));
  }
  return text;
}

std::string trial_text(const TargetList& list) {
  struct Row {
    const wire::Trial::Outcome* outcome;
    std::string who, name, now;
  };
  std::vector<Row> rows;
  for (const auto& outcome : list.trial().outcomes()) {
    Row row{&outcome, fmt::format("{:09}", outcome.mmsi()), "", "-"};
    const auto take = [&](const auto& target) {
      row.name = name_of(target);
      if (target.has_cpa_nm()) row.now = figure(target.cpa_nm(), 2);
    };
    if (outcome.target() != 0) {
      row.who = fmt::format("{}", outcome.target());
      for (const Target& target : list.targets()) {
        if (target.number() == outcome.target()) take(target);
      }
    } else {
      for (const AisTarget& target : list.ais()) {
        if (target.mmsi() == outcome.mmsi()) take(target);
      }
    }
    rows.push_back(std::move(row));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return in_any_order(a.outcome->cpa_nm()) < in_any_order(b.outcome->cpa_nm());
  });
  std::string out = fmt::format("trial: {}; begins in {} s\n", trial_in_words(list.trial().order()),
                                figure(list.trial().begins_s(), 0));
  if (rows.empty()) return out + "no target whose motion is known\n";
  out += fmt::format("{:>9} {:>7} {:>8} {:>10}  {:<{}}  {}\n", "TARGET", "CPA NM", "TCPA MIN",
                     "CPA NM NOW", "NAME", kNameLength + 10, "NOTES");
  for (const Row& row : rows) {
    std::string line =
        fmt::format("{:>9} {:>7} {:>8} {:>10}  {:<{}}  {}", row.who,
                    figure(row.outcome->cpa_nm(), 2), figure(row.outcome->tcpa_min(), 1), row.now,
                    row.name, kNameLength + 10, notes_of_both(*row.outcome));
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  return out;
}

std::string rules_in_words(const wire::TargetRules& rules) {
  std::string text;
  for (const FieldDescriptor* field : wire::fields_of(*wire::TargetRules::descriptor())) {
    if (!wire::value_of(rules, *field)) continue;
    text = joined(text, fmt::format("{} {}", wire::spoken_name(*field), text_of(rules, *field)));
  }
  return text;
}

std::string rules_text(const wire::TargetRules& rules) {
  std::string out;
  for (const FieldDescriptor* field : wire::fields_of(*wire::TargetRules::descriptor())) {
    const std::vector<std::string> words = words_of(*field);
    const std::string choice = words.empty() ? "" : fmt::format(", {}", fmt::join(words, " or "));
    out +=
        fmt::format("{:<20} {:<10} {:<16} {}{}\n", wire::spoken_name(*field),
                    text_of(rules, *field), "--" + distinct_name(*field), help_of(*field), choice);
  }
  return out;
}

std::string targets_text(const TargetList& list, TargetSort sort) {
  std::string out = fmt::format(
      "TARGETS  {} of {}, radar {} view {}, {} UTC; {}\nOWN      {}\n", list.tracked(),
      list.rules().capacity(), list.radar(), list.view(), clock_in_words(list.utc_ns()),
      list.stabilised_by().empty()
          ? "courses and speeds are not known"
          : fmt::format("courses and speeds are {} {}, by {}",
                        list.stabilisation() == wire::STABILISATION_GROUND ? "over" : "through the",
                        wire::word_of(*wire::Stabilisation_descriptor(), list.stabilisation()),
                        printable(list.stabilised_by(), 40)),
      own_ship_of(list));
  if (!list.problem().empty()) out += fmt::format("PROBLEM  {}\n", printable(list.problem()));
  for (const wire::TargetZone& zone : list.zones()) out += zone_in_words(zone) + "\n";
  if (list.test_targets()) out += "TEST     targets marked as such have no echo\n";
  out += "\n";
  out += list.targets().empty() ? "no targets\n" : heading_of("TARGET");
  for (const Target* target : in_order(list.targets(), sort)) out += row_of(*target);
  if (!list.ais().empty()) out += "\n" + heading_of("AIS");
  for (const AisTarget* target : in_order(list.ais(), sort)) out += row_of(*target);
  if (list.ais_left_out() > 0) {
    out += fmt::format("{} AIS targets farther off are left out\n", list.ais_left_out());
  }
  if (list.has_trial()) out += "\n" + trial_text(list);
  return out + alerts_of(list);
}

std::string targets_csv(const TargetList& list, TargetSort sort) {
  std::string out =
      "kind,number,mmsi,state,range_nm,bearing_deg,course_deg,speed_kn,cpa_nm,tcpa_min,age_s,"
      "lat_deg,lon_deg,name,dangerous,new,reference,test,by_hand\n";
  for (const Target* target : in_order(list.targets(), sort)) {
    out += fmt::format("tracked,{},{},{},{},{},{:d},{:d},{:d},{:d},{:d}\n", target->number(),
                       target->mmsi() == 0 ? "" : fmt::format("{}", target->mmsi()),
                       csv_middle(*target), csv_place(*target), csv_text(target->name()),
                       target->is_dangerous(), target->is_new(), target->is_reference(),
                       target->is_test(), target->by_hand());
  }
  for (const AisTarget* target : in_order(list.ais(), sort)) {
    out += fmt::format("ais,{},{},{},{},{},{:d},0,0,0,0\n",
                       target->target() == 0 ? "" : fmt::format("{}", target->target()),
                       target->mmsi(), csv_middle(*target), csv_place(*target),
                       csv_text(target->name()), target->is_dangerous());
  }
  return out;
}

}  // namespace skerry::client
