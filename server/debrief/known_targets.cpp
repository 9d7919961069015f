#include "server/debrief/known_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "server/debrief/orders_told.hpp"
#include "server/relayed/values_in_range.hpp"
#include "server/tracking/watch/alert_list.hpp"

namespace skerry::server {
namespace {

constexpr double kPlaceEvery_s = 10.0;
constexpr std::size_t kMostViews = 64;

const char* word_of(wire::AlertPriority priority) {
  switch (priority) {
    case wire::ALERT_ALARM:
      return "alarm";
    case wire::ALERT_WARNING:
      return "warning";
    default:
      return "caution";
  }
}

}  // namespace

void KnownTargets::add(Moment now, const wire::TargetList& list) {
  if (list.plots() < plots_) begin_anew();
  plots_ = list.plots();
  now_ = now;
  take_targets(list);
  take_alerts(list);
}

// Another plotter: its numbers are of other targets.
void KnownTargets::begin_anew() {
  told_.clear();
  placed_s_.clear();
  for (const auto& [key, open] : open_) view_.alerts[open.index].ended = now_;
  open_.clear();
  done_.clear();
}

void KnownTargets::take_targets(const wire::TargetList& list) {
  std::set<std::uint32_t> present;
  for (const wire::Target& target : list.targets()) {
    if (target.is_test() || !present.insert(target.number()).second) continue;
    take(target);
  }
  std::erase_if(told_, [&](const auto& row) {
    if (present.contains(row.first)) return false;
    placed_s_.erase(row.second);
    return true;
  });
}

void KnownTargets::take(const wire::Target& target) {
  auto found = told_.find(target.number());
  if (found == told_.end()) {
    if (view_.targets.size() >= kMostTargets) {
      // Each time it comes it is counted once.
      told_.emplace(target.number(), kMostTargets);
      ++view_.left_out;
      return;
    }
    found = told_.emplace(target.number(), view_.targets.size()).first;
    KnownTarget& row = view_.targets.emplace_back();
    row.number = target.number();
    row.first = now_;
  }
  if (found->second >= kMostTargets) return;
  KnownTarget& row = view_.targets[found->second];
  if (row.lost) return;  // told until it is acknowledged
  row.last = now_;
  row.by_hand = row.by_hand || target.by_hand();
  if (!target.name().empty()) row.name = target.name();
  row.lost = target.state() == wire::TARGET_LOST;
  const bool is_ahead = !target.has_tcpa_min() || target.tcpa_min() >= 0.0;
  if (target.has_cpa_nm() && is_ahead &&
      (!row.least_cpa_nm || target.cpa_nm() < *row.least_cpa_nm)) {
    row.least_cpa_nm = target.cpa_nm();
    row.tcpa_min.reset();
    if (target.has_tcpa_min()) row.tcpa_min = target.tcpa_min();
    row.least_when = now_;
  }
  const auto [placed, is_first] = placed_s_.try_emplace(found->second, now_.at_s);
  if (!is_first && now_.at_s < placed->second + kPlaceEvery_s && !row.lost) return;
  if (places_ >= kMostPlaces) return;
  ++places_;
  placed->second = now_.at_s;
  row.way.push_back({target.latitude_deg(), target.longitude_deg()});
}

void KnownTargets::take_alerts(const wire::TargetList& list) {
  std::set<AlertKey> present;
  for (const wire::Alert& alert : list.alerts()) {
    if (present.insert({alert.number(), alert.instance()}).second) take(alert);
  }
  std::erase_if(open_, [&](const auto& each) {
    if (present.contains(each.first)) return false;
    end(each.first, each.second, told_.contains(each.second.target));
    return true;
  });
  std::erase_if(done_, [&](const auto& each) { return !present.contains(each.first); });
}

void KnownTargets::take(const wire::Alert& alert) {
  const AlertKey key{alert.number(), alert.instance()};
  const bool is_acknowledged = alert.state() == wire::ALERT_ACKNOWLEDGED;
  if (const auto open = open_.find(key); open != open_.end()) {
    open->second.state = alert.state();
    if (!is_acknowledged) return;
    view_.alerts[open->second.index].acknowledged = now_;
    done_[key] = open->second.index;
    open_.erase(open);
    return;
  }
  if (done_.contains(key)) {
    if (is_acknowledged || done_[key] >= kMostAlerts) return;
    done_.erase(key);  // raised again
  }
  if (view_.alerts.size() >= kMostAlerts) {
    done_[key] = kMostAlerts;
    ++view_.left_out;
    return;
  }
  KnownAlert row;
  row.number = alert.number();
  row.instance = alert.instance();
  row.priority = word_of(alert.priority());
  row.title = alert.title();
  row.text = alert.text();
  row.raised = now_;
  if (is_acknowledged) {
    row.acknowledged = now_;  // within a second, or before the recording
    done_[key] = view_.alerts.size();
  } else {
    open_[key] = {view_.alerts.size(), alert.state(), alert.target()};
  }
  view_.alerts.push_back(std::move(row));
}

// An event, and what is over, go once they are acknowledged; others with their cause.
void KnownTargets::end(const AlertKey& key, const Open& open, bool is_target_there) {
  const AlertRow* kind = find_alert_row(key.first);
  bool waited = open.state == wire::ALERT_RECTIFIED || (kind != nullptr && kind->is_event);
  // The alert of a new target goes with it, too.
  if (kind != nullptr && kind->kind == AlertKind::new_target && open.target != 0) {
    waited = waited && is_target_there;
  }
  KnownAlert& row = view_.alerts[open.index];
  (waited ? row.acknowledged : row.ended) = now_;
}

KnownView KnownTargets::finish() {
  for (const auto& [number, row] : told_) {
    if (row < view_.targets.size()) view_.targets[row].to_the_end = !view_.targets[row].lost;
  }
  return std::move(view_);
}

std::vector<KnownView> known_views(const recording::RecordingReader& reader, UtcTime epoch,
                                   double end_s, const scenario::Scenario& scenario,
                                   const std::function<double(double)>& exercise_at) {
  const std::vector<RadarAboard> radars = radars_aboard(scenario);
  std::vector<KnownView> views;
  for (const auto& [topic, count] : reader.summary().items) {
    if (topic.kind != recording::Kind::targets || count == 0) continue;
    if (views.size() == kMostViews) break;
    KnownTargets known;
    recording::ItemCursor items = reader.items({topic});
    while (const auto item = items.next()) {
      const double at_s = in_seconds(item->time - epoch);
      if (at_s > end_s) break;
      wire::TargetList list;
      if (!list.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) continue;
      bring_into_range(list);
      known.add({at_s, exercise_at(at_s)}, list);
    }
    KnownView& view = views.emplace_back(known.finish());
    view.view = topic.view;
    view.radar = fmt::format("radar {}", topic.radar);
    if (topic.radar >= radars.size()) continue;
    view.radar = radars[topic.radar].name;
    view.own_ship = radars[topic.radar].own_ship;
    view.own_name = scenario.own_ships(static_cast<int>(*view.own_ship)).name();
  }
  return views;
}

}  // namespace skerry::server
