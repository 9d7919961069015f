#include "server/navigation/navigation_talker.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "protocol/nmea/ais_sentences.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/speed.hpp"
#include "protocol/wire/own_ship_place.hpp"
#include "server/navigation/ais_reports.hpp"
#include "server/navigation/con_sentences.hpp"
#include "server/navigation/own_ship_sentences.hpp"
#include "server/navigation/target_sentences.hpp"

namespace skerry::server {
namespace {

// Long enough for every sentence about targets to say that one is lost.
Duration lost_for(const NavigationPlan& plan) {
  Duration longest = std::chrono::seconds(1);
  for (const auto& [sentence, period] : plan.periods) {
    if (is_of_targets(sentence)) longest = std::max(longest, period);
  }
  return longest * 2;
}

// A moment within `interval` that is the station's own: golden section steps spread evenly.
Duration phase_of(std::uint32_t number, Duration interval) {
  const std::uint32_t fraction = number * 2654435769u;
  return Duration(static_cast<std::int64_t>(static_cast<double>(interval.count()) *
                                            (fraction / kUnitsPerTurn)));
}

// The next time after `was` that lies after `now`; what was missed is left out.
ScenarioTime after(ScenarioTime was, Duration period, ScenarioTime now) {
  const ScenarioTime next = was + period;
  return next > now ? next : now + period;
}

}  // namespace

NavigationTalker::NavigationTalker(const NavigationPlan& plan)
    : plan_(plan),
      tracks_(plan.tracking_range_nm * Length::kMetresPerNauticalMile, plan.tracked_targets,
              lost_for(plan)),
      plotted_(plan.tracking_range_nm * Length::kMetresPerNauticalMile, plan.tracked_targets,
               lost_for(plan)) {}

NavigationTalker::ToldNow NavigationTalker::told_targets(ScenarioTime now,
                                                         const NavigationWorld& world) {
  if (plan_.targets == TargetSource::plotted) {
    const auto list = world.targets();
    if (list == nullptr) return {};
    return {plotted_.update(*list, now),
            UtcTime(Duration(static_cast<std::int64_t>(list->utc_ns())))};
  }
  const wire::OwnShip own = world.own_ship();
  const std::optional<GeoPoint> here = wire::place_known_of(own);
  if (!here || own.no_motion()) return {};  // CPA needs to know
  return {true_targets(tracks_.update(*here, world.traffic(), now), own),
          UtcTime(Duration(static_cast<std::int64_t>(own.utc_ns())))};
}

std::vector<NavigationMessage> NavigationTalker::due(ScenarioTime now,
                                                     const NavigationWorld& world) {
  std::vector<NavigationMessage> out;
  if (!begun_) {
    begun_ = true;
    for (const auto& [sentence, unused] : plan_.periods) next_[sentence] = now;
    own_station_ = {now, now};
  }
  std::optional<wire::OwnShip> own;
  std::optional<std::vector<TrafficItem>> traffic;
  std::optional<ToldNow> told;
  const auto the_own = [&]() -> const wire::OwnShip& {
    if (!own) own = world.own_ship();
    return *own;
  };
  const auto the_traffic = [&]() -> const std::vector<TrafficItem>& {
    if (!traffic) traffic = world.traffic();
    return *traffic;
  };
  for (auto& [sentence, next] : next_) {
    if (next > now) continue;
    if (sentence == NavigationSentence::vdm) {
      if (!the_own().no_ais()) say_ais(now, the_own(), the_traffic(), out);
      next = after(next, kTrafficStep, now);
      continue;
    }
    if (sentence == NavigationSentence::vdo) {
      say_own_ais(now, the_own(), out);
      next = own_mmsi(*own) == 0 ? after(next, std::chrono::seconds(1), now)
                                 : std::min(own_station_.position, own_station_.fixed);
      continue;
    }
    next = after(next, plan_.periods[sentence], now);
    if (is_of_targets(sentence)) {
      if (!told) told = told_targets(now, world);
      if (sentence == NavigationSentence::ttd) ++ttd_identifier_;
      auto lines = target_sentences(sentence, told->targets, told->utc, ttd_identifier_);
      if (sentence == NavigationSentence::ttd) {
        if (!lines.empty()) out.push_back({sentence, std::move(lines)});
      } else {
        for (std::string& line : lines) out.push_back({sentence, {std::move(line)}});
      }
      continue;
    }
    if (is_of_alerts(sentence)) {
      const auto list = world.targets();
      if (list == nullptr) continue;
      auto lines = alerts_.sentences(sentence, *list);
      if (!lines.empty()) out.push_back({sentence, std::move(lines)});
      continue;
    }
    if (is_of_con(sentence)) {
      if (the_own().has_con()) out.push_back({sentence, {con_sentence(sentence, the_own())}});
      continue;
    }
    const wire::Settings settings =
        sentence == NavigationSentence::rsd ? world.settings() : wire::Settings();
    out.push_back(
        {sentence, {own_ship_sentence(sentence, the_own(), settings, plan_.says_simulated)}});
  }
  return out;
}

ScenarioTime NavigationTalker::next_due() const {
  ScenarioTime first = ScenarioTime::max();
  for (const auto& [unused, next] : next_) first = std::min(first, next);
  return first;
}

std::uint32_t NavigationTalker::own_mmsi(const wire::OwnShip& own) const {
  return plan_.own_mmsi != 0 ? plan_.own_mmsi : own.mmsi();
}

void NavigationTalker::say_ais(ScenarioTime now, const wire::OwnShip& own,
                               const std::vector<TrafficItem>& traffic,
                               std::vector<NavigationMessage>& out) {
  const std::optional<GeoPoint> here = wire::place_known_of(own);
  const UtcTime utc{Duration(static_cast<std::int64_t>(own.utc_ns()))};
  const double range_m = plan_.ais_range_nm * Length::kMetresPerNauticalMile;
  const Duration fixed_period =
      plan_.static_period == kAsAisDoes ? kStaticInterval : plan_.static_period;
  const Duration position_period = plan_.periods[NavigationSentence::vdm];
  struct Near {
    double range_m;
    const TrafficItem* item;
  };
  std::vector<Near> near;
  for (const TrafficItem& item : traffic) {
    if (item.mmsi == 0 || item.kind == TrafficKind::other) continue;
    const double range = here ? place_of(item.position, *here).range_m : 0.0;
    if (range <= range_m) near.push_back({range, &item});
  }
  if (near.size() > kMostAis) {
    std::nth_element(near.begin(), near.begin() + kMostAis, near.end(),
                     [](const Near& a, const Near& b) { return a.range_m < b.range_m; });
    near.resize(kMostAis);
  }
  std::map<std::uint32_t, Station> stations;
  for (const Near& one : near) {
    const TrafficItem& item = *one.item;
    const Duration period =
        position_period != kAsAisDoes
            ? position_period
            : position_interval(item.kind, item.speed_mps, item.rate_of_turn_deg_min);
    const auto known = stations_.find(item.number);
    Station station = known != stations_.end() ? known->second
                                               : Station{now + phase_of(item.number, period),
                                                         now + phase_of(item.number, fixed_period)};
    // One that gathers way, or turns, need not wait for her old interval to end.
    station.position = std::min(station.position, now + period);
    if (station.position <= now) {
      if (const auto report = position_report(item, utc)) {
        add_ais(NavigationSentence::vdm, *report, out);
      }
      station.position = after(station.position, period, now);
    }
    if (station.fixed <= now) {
      for (const auto& report : static_reports(item)) {
        add_ais(NavigationSentence::vdm, report, out);
      }
      station.fixed = after(station.fixed, fixed_period, now);
    }
    stations.insert({item.number, station});
  }
  stations_ = std::move(stations);
}

void NavigationTalker::say_own_ais(ScenarioTime now, const wire::OwnShip& own,
                                   std::vector<NavigationMessage>& out) {
  const std::uint32_t mmsi = own_mmsi(own);
  if (mmsi == 0) return;
  const Duration plan = plan_.periods[NavigationSentence::vdo];
  const Duration period =
      plan != kAsAisDoes ? plan
                         : position_interval(TrafficKind::ship, own.speed_over_ground_kn() * kKnot,
                                             own.rate_of_turn_deg_min());
  if (own_station_.position <= now) {
    add_ais(NavigationSentence::vdo, own_position_report(own, mmsi), out);
    own_station_.position = after(own_station_.position, period, now);
  }
  if (own_station_.fixed <= now) {
    add_ais(NavigationSentence::vdo, own_static_report(own, mmsi), out);
    own_station_.fixed =
        after(own_station_.fixed,
              plan_.static_period == kAsAisDoes ? kStaticInterval : plan_.static_period, now);
  }
}

void NavigationTalker::add_ais(NavigationSentence sentence, const nmea::AisMessage& message,
                               std::vector<NavigationMessage>& out) {
  out.push_back({sentence, nmea::encode_ais(message, sentence == NavigationSentence::vdo,
                                            ais_identifier_, channel_b_ ? 'B' : 'A')});
  if (out.back().lines.size() > 1) ais_identifier_ = (ais_identifier_ + 1) % 10;
  channel_b_ = !channel_b_;
}

}  // namespace skerry::server
