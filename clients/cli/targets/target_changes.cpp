// What has happened between two lists.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "clients/cli/targets/target_words.hpp"
#include "protocol/quantity/length.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

using wire::AisTarget;
using wire::Alert;
using wire::Target;
using wire::TargetList;

class Changes {
 public:
  Changes(const TargetList& before, const TargetList& after) : before_(before), after_(after) {}

  std::vector<std::string> all() {
    view();
    tracked();
    ais();
    alerts();
    return std::move(lines_);
  }

 private:
  void add(const std::string& text) {
    lines_.push_back(clock_in_words(after_.utc_ns()) + "  " + text);
  }
  // Of all that has a key, in both lists.
  template <typename Items, typename Key, typename Same, typename Came, typename Gone>
  void compare(const Items& was, const Items& is, Key key, Same same, Came came, Gone gone) {
    const auto find = [&](const Items& in, const auto& wanted) {
      return std::find_if(in.begin(), in.end(),
                          [&](const auto& item) { return key(item) == key(wanted); });
    };
    for (const auto& item : is) {
      const auto old = find(was, item);
      old == was.end() ? came(item) : same(*old, item);
    }
    for (const auto& item : was) {
      if (find(is, item) == is.end()) gone(item);
    }
  }

  void view();
  void tracked();
  void ais();
  void alerts();
  void target_changed(const Target& was, const Target& is);

  const TargetList& before_;
  const TargetList& after_;
  std::vector<std::string> lines_;
};

template <typename T>
std::string place_in_words(const T& target) {
  return fmt::format("{} NM, {}", figure(metres(target.range_m()).in_nautical_miles(), 2),
                     direction(target.bearing_deg()));
}

std::string motion_in_words(const Target& target) {
  if (!target.has_course_deg()) return "";
  return fmt::format(", course {} at {} kn", direction(target.course_deg()),
                     figure(target.speed_kn(), 1));
}

std::string approach_in_words(const Target& target) {
  if (!target.has_cpa_nm()) return "";
  std::string text = fmt::format(", CPA {} NM", figure(target.cpa_nm(), 2));
  if (target.has_tcpa_min()) text += fmt::format(" in {} min", figure(target.tcpa_min(), 1));
  return text;
}

std::string ship_in_words(std::uint32_t mmsi, const std::string& name) {
  return fmt::format("AIS {:09}{}{}", mmsi, name.empty() ? "" : " ", printable(name, 20));
}

void Changes::view() {
  if (after_.problem() != before_.problem()) {
    add(after_.problem().empty() ? "no problem any more"
                                 : "problem: " + printable(after_.problem(), 300));
  }
  if (after_.stabilised_by() != before_.stabilised_by() ||
      after_.stabilisation() != before_.stabilisation()) {
    add(after_.stabilised_by().empty()
            ? "courses and speeds are not known"
            : fmt::format("courses and speeds: {}, by {}",
                          wire::word_of(*wire::Stabilisation_descriptor(), after_.stabilisation()),
                          printable(after_.stabilised_by(), 40)));
  }
  if (after_.rules().SerializeAsString() != before_.rules().SerializeAsString()) {
    wire::TargetRules changed = after_.rules();
    for (const wire::FieldDescriptor* field : wire::fields_of(*wire::TargetRules::descriptor())) {
      if (wire::value_of(before_.rules(), *field) == wire::value_of(after_.rules(), *field)) {
        changed.GetReflection()->ClearField(&changed, field);
      }
    }
    add("rules: " + rules_in_words(changed));
  }
  compare(
      before_.zones(), after_.zones(), [](const auto& zone) { return zone.number(); },
      [this](const auto& was, const auto& is) {
        if (was.SerializeAsString() != is.SerializeAsString()) add(zone_in_words(is));
      },
      [this](const auto& zone) { add(zone_in_words(zone)); },
      [this](const auto& zone) { add(fmt::format("zone {}: removed", zone.number())); });
  if (after_.has_trial() &&
      (!before_.has_trial() ||
       after_.trial().order().SerializeAsString() != before_.trial().order().SerializeAsString())) {
    add("trial: " + trial_in_words(after_.trial().order()));
  }
  if (before_.has_trial() && !after_.has_trial()) add("trial: ended");
  if (after_.test_targets() != before_.test_targets()) {
    add(after_.test_targets() ? "test targets on" : "test targets off");
  }
}

void Changes::tracked() {
  compare(
      before_.targets(), after_.targets(), [](const Target& target) { return target.number(); },
      [this](const Target& was, const Target& is) { target_changed(was, is); },
      [this](const Target& target) {
        add(fmt::format("target {}: {}, {}{}{}", target.number(),
                        target.is_test() ? "test target" : "acquired", place_in_words(target),
                        target.by_hand() ? ", by hand" : "", motion_in_words(target)));
        if (target.is_dangerous()) target_changed(Target(), target);
      },
      [this](const Target& target) {
        add(fmt::format("target {}: no longer listed", target.number()));
      });
}

void Changes::target_changed(const Target& was, const Target& is) {
  const std::string who = fmt::format("target {}: ", is.number());
  if (was.number() == is.number() && was.state() != is.state()) {
    add(who + wire::word_of(*wire::TargetState_descriptor(), is.state()) + ", " +
        place_in_words(is) + motion_in_words(is));
  }
  if (was.is_dangerous() != is.is_dangerous()) {
    add(who + (is.is_dangerous() ? "dangerous" : "no longer dangerous") + approach_in_words(is));
  }
  if (was.number() != is.number()) return;
  if (was.mmsi() != is.mmsi()) {
    add(who + (is.mmsi() == 0 ? "no AIS target" : "is " + ship_in_words(is.mmsi(), is.name())));
  }
  if (was.is_reference() != is.is_reference()) {
    add(who + (is.is_reference() ? "the reference" : "no longer the reference"));
  }
}

// Those that only sleep come and go without a word.
void Changes::ais() {
  const auto changed = [this](bool was_activated, bool was_lost, const AisTarget& is) {
    const std::string who = ship_in_words(is.mmsi(), is.name()) + ": ";
    if (is.is_lost() != was_lost) {
      add(who + (is.is_lost() ? "lost" : "heard again"));
    } else if (is.is_activated() != was_activated) {
      add(who + (is.is_activated() ? "activated, " + place_in_words(is) : "sleeping"));
    }
  };
  compare(
      before_.ais(), after_.ais(), [](const AisTarget& target) { return target.mmsi(); },
      [&](const AisTarget& was, const AisTarget& is) {
        changed(was.is_activated(), was.is_lost(), is);
      },
      [&](const AisTarget& is) { changed(false, false, is); },
      [this](const AisTarget& was) {
        if (was.is_activated()) add(ship_in_words(was.mmsi(), was.name()) + ": no longer listed");
      });
}

void Changes::alerts() {
  compare(
      before_.alerts(), after_.alerts(),
      [](const Alert& alert) { return std::pair(alert.number(), alert.instance()); },
      [this](const Alert& was, const Alert& is) {
        if (was.state() != is.state()) {
          add(alert_in_words(is) + ": " +
              wire::word_of(*wire::AlertState_descriptor(), is.state()));
        } else if (was.escalations() != is.escalations()) {
          add(alert_in_words(is) + ": still not acknowledged");
        }
      },
      [this](const Alert& alert) {
        add(alert_in_words(alert) + ": " + printable(alert.text(), 200));
      },
      [this](const Alert& alert) { add(alert_in_words(alert) + ": over"); });
}

}  // namespace

std::vector<std::string> target_changes(const TargetList& before, const TargetList& after) {
  return Changes(before, after).all();
}

}  // namespace skerry::client
