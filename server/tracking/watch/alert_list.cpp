#include "server/tracking/watch/alert_list.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace skerry::server {
namespace {

constexpr std::array<AlertRow, 6> kRows{{
    {AlertKind::approach, 3044, wire::ALERT_ALARM, "A", "CPA/TCPA", false, false},
    {AlertKind::new_target, 3048, wire::ALERT_WARNING, "B", "New target", true, true},
    {AlertKind::lost_target, 3052, wire::ALERT_WARNING, "B", "Lost target", true, true},
    {AlertKind::lost_input, 3015, wire::ALERT_WARNING, "B", "Lost input", true, false},
    {AlertKind::capacity_exceeded, 3042, wire::ALERT_WARNING, "B", "Capacity full", true, false},
    {AlertKind::capacity_near, 3043, wire::ALERT_CAUTION, "C", "Capacity 90 %", false, false},
}};

constexpr bool rows_are_in_order() {
  for (std::size_t k = 0; k < kRows.size(); ++k) {
    if (static_cast<std::size_t>(kRows[k].kind) != k || kRows[k].title.size() > 16) return false;
  }
  return true;
}
static_assert(rows_are_in_order());

constexpr std::uint32_t kLastRevision = 99;

}  // namespace

const AlertRow& row_of(AlertKind kind) { return kRows[static_cast<std::size_t>(kind)]; }

const AlertRow* find_alert_row(std::uint32_t number) {
  const auto row = std::find_if(kRows.begin(), kRows.end(),
                                [&](const AlertRow& r) { return r.number == number; });
  return row == kRows.end() ? nullptr : &*row;
}

void AlertList::change(Entry& entry, wire::AlertState state) {
  entry.state = state;
  entry.revision = entry.revision % kLastRevision + 1;
  entry.changed = now_;
}

void AlertList::go_on(UtcTime now) {
  now_ = now;
  for (auto& [key, entry] : alerts_) {
    if (entry.state == wire::ALERT_SILENCED && now - entry.silenced >= kSilence) {
      change(entry, wire::ALERT_ACTIVE);
    }
    const bool waits = entry.state == wire::ALERT_ACTIVE || entry.state == wire::ALERT_SILENCED;
    if (!waits || row_of(key.first).priority == wire::ALERT_CAUTION) continue;
    const auto times = static_cast<std::uint32_t>((now - entry.raised) / kEscalates);
    if (times <= entry.escalations) continue;
    entry.escalations = times;
    change(entry, entry.state);
  }
}

std::uint32_t AlertList::new_instance(AlertKind kind) {
  std::uint32_t& last = instances_[kind];
  do {
    last = last % kLastInstance + 1;
  } while (has(row_of(kind).number, last));
  return last;
}

void AlertList::raise(AlertKind kind, const AlertSubject& subject, std::string text) {
  const Key key{kind, subject};
  auto found = alerts_.find(key);
  if (found == alerts_.end()) {
    Entry entry;
    entry.instance = new_instance(kind);
    entry.changed = entry.raised = now_;
    entry.text = std::move(text);
    alerts_.emplace(key, std::move(entry));
    make_room();
  } else if (found->second.state == wire::ALERT_RECTIFIED) {
    found->second.raised = now_;
    found->second.escalations = 0;
    found->second.text = std::move(text);
    change(found->second, wire::ALERT_ACTIVE);
  }
}

void AlertList::make_room() {
  if (alerts_.size() <= kMost) return;
  alerts_.erase(std::min_element(alerts_.begin(), alerts_.end(), [](const auto& a, const auto& b) {
    return std::tuple(row_of(a.first.first).priority, a.second.changed, a.second.instance) <
           std::tuple(row_of(b.first.first).priority, b.second.changed, b.second.instance);
  }));
}

void AlertList::end(AlertKind kind, const AlertSubject& subject) {
  const auto found = alerts_.find({kind, subject});
  if (found == alerts_.end() || found->second.state == wire::ALERT_RECTIFIED) return;
  if (found->second.state == wire::ALERT_ACKNOWLEDGED || !row_of(kind).stays_rectified) {
    alerts_.erase(found);
  } else {
    change(found->second, wire::ALERT_RECTIFIED);
  }
}

void AlertList::remove(const AlertSubject& subject) {
  std::erase_if(alerts_, [&](const auto& alert) { return alert.first.second == subject; });
}

void AlertList::move(AlertKind kind, const AlertSubject& from, const AlertSubject& to) {
  auto node = alerts_.extract({kind, from});
  if (node.empty()) return;
  node.key().second = to;
  alerts_.insert(std::move(node));
}

void AlertList::copy(AlertKind kind, const AlertSubject& from, const AlertSubject& to) {
  const auto found = alerts_.find({kind, from});
  if (found == alerts_.end() || has(kind, to)) return;
  Entry entry = found->second;
  entry.instance = new_instance(kind);
  alerts_.emplace(Key{kind, to}, std::move(entry));
  make_room();
}

bool AlertList::has(AlertKind kind, const AlertSubject& subject) const {
  return alerts_.contains({kind, subject});
}

bool AlertList::has(std::uint32_t number, std::uint32_t instance) const {
  return std::any_of(alerts_.begin(), alerts_.end(), [&](const auto& alert) {
    return row_of(alert.first.first).number == number && alert.second.instance == instance;
  });
}

bool AlertList::is_unacknowledged(AlertKind kind, const AlertSubject& subject) const {
  const auto found = alerts_.find({kind, subject});
  return found != alerts_.end() && found->second.state != wire::ALERT_ACKNOWLEDGED;
}

void AlertList::acknowledge(std::uint32_t number, std::uint32_t instance) {
  for (auto at = alerts_.begin(); at != alerts_.end();) {
    auto& [key, entry] = *at;
    const AlertRow& row = row_of(key.first);
    const bool meant = row.number == number && (instance == 0 || entry.instance == instance);
    if (!meant || row.priority == wire::ALERT_CAUTION) {
      ++at;
    } else if (row.is_event || entry.state == wire::ALERT_RECTIFIED) {
      at = alerts_.erase(at);
    } else {
      if (entry.state != wire::ALERT_ACKNOWLEDGED) change(entry, wire::ALERT_ACKNOWLEDGED);
      ++at;
    }
  }
}

void AlertList::silence() {
  for (auto& [key, entry] : alerts_) {
    if (entry.state != wire::ALERT_ACTIVE || row_of(key.first).priority == wire::ALERT_CAUTION) {
      continue;
    }
    entry.silenced = now_;
    change(entry, wire::ALERT_SILENCED);
  }
}

std::vector<wire::Alert> AlertList::told() const {
  std::vector<wire::Alert> told;
  for (const auto& [key, entry] : alerts_) {
    const AlertRow& row = row_of(key.first);
    wire::Alert alert;
    alert.set_number(row.number);
    alert.set_instance(entry.instance);
    alert.set_revision(entry.revision);
    alert.set_priority(row.priority);
    alert.set_category(std::string(row.category));
    alert.set_state(entry.state);
    alert.set_title(std::string(row.title));
    alert.set_text(entry.text);
    alert.set_target(key.second.target);
    alert.set_mmsi(key.second.mmsi);
    alert.set_utc_ns(static_cast<std::uint64_t>(entry.changed.time_since_epoch().count()));
    alert.set_escalations(entry.escalations);
    told.push_back(std::move(alert));
  }
  std::stable_sort(told.begin(), told.end(), [](const wire::Alert& a, const wire::Alert& b) {
    return std::tuple(b.priority(), b.utc_ns()) < std::tuple(a.priority(), a.utc_ns());
  });
  return told;
}

}  // namespace skerry::server
