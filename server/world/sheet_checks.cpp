#include <fmt/format.h>

#include <set>
#include <string>

#include "server/world/exercise_sheet.hpp"

namespace skerry::server {
namespace {

using NameSet = std::set<std::string>;

class SheetChecker {
 public:
  SheetChecker(const scenario::Scenario& scenario, YamlSource& source)
      : sheet_(scenario.exercise()), source_(source) {
    for (const auto& ship : scenario.own_ships()) {
      ships_.insert(ship.name());
      for (const auto& radar : ship.radars()) radars_.insert(radar.name());
    }
    for (const auto& target : scenario.targets()) {
      echoes_.insert(target.name());
      if (target.kind() == scenario::Target::ship) ships_.insert(target.name());
    }
    for (const auto& racon : scenario.racons()) {
      if (!racon.name().empty()) echoes_.insert(racon.name());
    }
    for (const auto& sart : scenario.sarts()) echoes_.insert(sart.name());
    for (const auto& event : scenario.events()) events_.insert(event.name());
  }

  void check() const {
    if (sheet_.answers_size() > kMaxSheetAnswers) {
      refuse("exercise.answers", fmt::format("{} entries; allowed: at most {}",
                                             sheet_.answers_size(), kMaxSheetAnswers));
    }
    if (sheet_.checks_size() > kMaxSheetChecks) {
      refuse("exercise.checks",
             fmt::format("{} entries; allowed: at most {}", sheet_.checks_size(), kMaxSheetChecks));
      return;
    }
    for (int i = 0; i < sheet_.checks_size(); ++i) {
      check_one(sheet_.checks(i), fmt::format("exercise.checks[{}]", i));
    }
  }

 private:
  void refuse(const std::string& path, const std::string& text) const {
    source_.refuse(path, text);
  }

  void check_name(const std::string& name, const std::string& path, const char* what,
                  const NameSet& names) const {
    if (!source_.is_sound(path) || names.contains(name)) return;
    std::string list;
    int count = 0;
    for (const std::string& each : names) {
      if (++count <= 20) list += (list.empty() ? "" : ", ") + each;
    }
    if (count > 20) list += fmt::format(" and {} more", count - 20);
    refuse(path, fmt::format("there is no {} \"{}\"; allowed: {}", what, printable(name),
                             list.empty() ? "none is there" : list));
  }

  void check_one(const scenario::ExerciseCheck& check, const std::string& path) const {
    if (source_.is_sound(path + ".at_min") && check.at_min() > sheet_.length_min()) {
      refuse(path + ".at_min", fmt::format("{} min is after the end; allowed: up to length_min, {}",
                                           check.at_min(), sheet_.length_min()));
    }
    if (check.has_radar()) check_name(check.radar(), path + ".radar", "radar", radars_);
    check_echoes(check.sees(), path + ".sees");
    check_echoes(check.misses(), path + ".misses");
    for (int i = 0; i < check.apart_size(); ++i) {
      const auto& apart = check.apart(i);
      const std::string entry = fmt::format("{}.apart[{}]", path, i);
      check_name(apart.ship(), entry + ".ship", "ship", ships_);
      check_name(apart.other(), entry + ".other", "ship", ships_);
      if (!apart.has_least_nm() && !apart.has_most_nm()) {
        refuse(entry, "asks nothing; expected least_nm or most_nm besides");
      }
    }
    if (check.has_event()) check_name(check.event(), path + ".event", "event", events_);
    const bool asks = check.sees_size() > 0 || check.misses_size() > 0 || check.apart_size() > 0 ||
                      check.has_event() || check.has_gyro_error_least_deg() ||
                      check.has_position_error_least_m() || check.has_land() ||
                      check.has_clutter_least_percent() || check.has_clutter_most_percent();
    if (!asks && source_.is_sound(path)) {
      refuse(path,
             "asks nothing; expected sees, misses, apart, event, land, clutter_least_percent, "
             "clutter_most_percent, gyro_error_least_deg or position_error_least_m");
    }
  }

  void check_echoes(const google::protobuf::RepeatedPtrField<std::string>& names,
                    const std::string& path) const {
    if (!source_.is_sound(path)) return;
    for (int i = 0; i < names.size(); ++i) {
      check_name(names[i], fmt::format("{}[{}]", path, i), "target, racon or SART", echoes_);
    }
  }

  const scenario::ExerciseSheet& sheet_;
  YamlSource& source_;
  NameSet ships_, echoes_, radars_, events_;
};

}  // namespace

void name_sarts(scenario::Scenario& scenario) {
  for (int i = 0; i < scenario.sarts_size(); ++i) {
    scenario::Sart& sart = *scenario.mutable_sarts(i);
    if (sart.name().empty()) sart.set_name(fmt::format("SART {}", i + 1));
  }
}

void check_sheet(const scenario::Scenario& scenario, YamlSource& source) {
  if (scenario.has_exercise()) SheetChecker(scenario, source).check();
}

}  // namespace skerry::server
