// Changes of settings, and what trainees did after what called for it.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "server/app/control/control_change.hpp"
#include "server/debrief/orders_told.hpp"

namespace skerry::server {

std::vector<RadarAboard> radars_aboard(const scenario::Scenario& scenario) {
  std::vector<RadarAboard> radars;
  for (int i = 0; i < scenario.own_ships_size(); ++i) {
    for (const scenario::Radar& radar : scenario.own_ships(i).radars()) {
      radars.push_back(
          {radar.name().empty() ? fmt::format("radar {}", radars.size()) : radar.name(),
           static_cast<std::size_t>(i)});
    }
  }
  return radars;
}

namespace {

// Steps of one control within this time are one change: a knob that is turned.
constexpr double kOneTurn_s = 3.0;

}  // namespace

std::vector<HappenedLine> setting_lines(const recording::RecordingReader& reader, UtcTime epoch,
                                        const scenario::Scenario& scenario) {
  const std::vector<RadarAboard> radars = radars_aboard(scenario);
  std::vector<recording::Topic> topics;
  for (const auto& [topic, count] : reader.summary().items) {
    if (topic.kind == recording::Kind::settings) topics.push_back(topic);
  }
  std::vector<HappenedLine> lines;
  if (topics.empty()) return lines;
  struct Turned {
    std::size_t line = 0;
    double last_s = 0.0;
    std::string from;
  };
  std::map<recording::Topic, wire::Settings> before;
  std::map<std::pair<recording::Topic, std::string>, Turned> turned;
  recording::ItemCursor items = reader.items(topics);
  while (const auto item = items.next()) {
    wire::Settings settings;
    if (!settings.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      continue;
    }
    const auto [known, is_first] = before.try_emplace(item->topic, settings);
    if (is_first) continue;
    const double at_s = in_seconds(item->time - epoch);
    for (const ControlChange& change : differences(known->second, settings)) {
      const auto [found, is_new] = turned.try_emplace({item->topic, change.control});
      Turned& turn = found->second;
      if (is_new || at_s > turn.last_s + kOneTurn_s) {
        HappenedLine line{{at_s, 0.0}, "setting", "", "", {}};
        const std::uint32_t radar = item->topic.radar;
        if (radar < radars.size()) line.own_ship = radars[radar].own_ship;
        line.who = radar < radars.size() ? radars[radar].name : fmt::format("radar {}", radar);
        if (item->topic.view > 0) line.who += fmt::format(", console view {}", item->topic.view);
        turn = {lines.size(), at_s, change.before};
        lines.push_back(std::move(line));
      }
      turn.last_s = at_s;
      lines[turn.line].text = fmt::format("{}: {} to {}", change.control, turn.from, change.after);
    }
    known->second = std::move(settings);
  }
  return lines;
}

namespace {

std::optional<double> next_of(const std::vector<HappenedLine>& happened, const std::string& kind,
                              std::size_t own_ship, double after_s) {
  for (const HappenedLine& line : happened) {
    if (line.when.at_s <= after_s || line.kind != kind || line.own_ship != own_ship) continue;
    if (line.when.at_s > after_s + Reaction::kLongest_s) break;
    return line.when.at_s - after_s;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Reaction> reactions_to(const std::vector<HappenedLine>& happened,
                                   const std::vector<ShipPassing>& passings,
                                   const std::vector<ShipTrack>& own_ships) {
  std::vector<Reaction> reactions;
  const auto add = [&](Moment when, std::string stimulus, std::size_t ship) {
    Reaction& reaction = reactions.emplace_back();
    reaction.when = when;
    reaction.stimulus = std::move(stimulus);
    reaction.own_ship = ship;
    reaction.own_name = own_ships[ship].name;
    reaction.helm_s = next_of(happened, "helm", ship, when.at_s);
    reaction.engine_s = next_of(happened, "engine", ship, when.at_s);
    reaction.setting_s = next_of(happened, "setting", ship, when.at_s);
  };
  const std::set<std::string> calls = {"event", "text", "fault", "alarm"};
  for (const HappenedLine& line : happened) {
    if (!calls.contains(line.kind)) continue;
    for (std::size_t ship = 0; ship < own_ships.size(); ++ship) {
      if (!line.own_ship || *line.own_ship == ship) {
        add(line.when, fmt::format("{}: {}", line.kind, line.text), ship);
      }
    }
  }
  for (const ShipPassing& passing : passings) {
    if (!passing.first_under) continue;
    add(*passing.first_under, fmt::format("CPA with {} forecast too small", passing.other_name),
        passing.own_ship);
    if (passing.other_own) {
      add(*passing.first_under, fmt::format("CPA with {} forecast too small", passing.own_name),
          passing.other);
    }
  }
  std::stable_sort(reactions.begin(), reactions.end(),
                   [](const Reaction& a, const Reaction& b) { return a.when.at_s < b.when.at_s; });
  return reactions;
}

}  // namespace skerry::server
