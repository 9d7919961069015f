#include "server/app/control/change_log.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace skerry::server {

ChangeLog::ChangeLog()
    : sink_([](const std::string& line) {
        spdlog::default_logger()->clone(kControlLogger)->info("{}", line);
      }) {}

void ChangeLog::add(const std::string& origin, const std::string& place,
                    const ControlChange& change, Clock::time_point now) {
  flush(now);
  Key key{origin, audit_ == nullptr ? "" : audit_->who_at(origin), place, change.control};
  const auto known = entries_.find(key);
  if (known != entries_.end()) {
    Entry& entry = known->second;
    if (entry.changes++ == 0) entry.before = change.before;
    entry.after = change.after;
  } else if (entries_.size() < kMaxWaiting) {
    tell(key, {now, 1, change.before, change.after});
    entries_.emplace(std::move(key), Entry{now});
  } else {
    ++left_out_;
    audit(key, {now, 1, change.before, change.after});
  }
}

void ChangeLog::flush(Clock::time_point now) {
  look_at_clock(now);
  for (auto it = entries_.begin(); it != entries_.end();) {
    Entry& entry = it->second;
    if (now - entry.told < kQuietTime) {
      ++it;
    } else if (entry.changes == 0) {
      it = entries_.erase(it);
    } else {
      tell(it->first, entry);
      entry = {now};
      ++it;
    }
  }
  if (left_out_ > 0 && take_room()) tell_left_out();
}

void ChangeLog::flush_all() {
  room_ = kMaxWaiting * kLineTime;
  for (const auto& [key, entry] : entries_) {
    if (entry.changes > 0) tell(key, entry);
  }
  entries_.clear();
  if (left_out_ > 0) tell_left_out();
}

void ChangeLog::look_at_clock(Clock::time_point now) {
  room_ = std::min<Clock::duration>(room_ + (now - last_), kMostLines * kLineTime);
  last_ = now;
}

bool ChangeLog::take_room() {
  if (room_ < kLineTime) return false;
  room_ -= kLineTime;
  return true;
}

void ChangeLog::audit(const Key& key, const Entry& entry) const {
  if (audit_ == nullptr) return;
  const auto& [origin, who, place, control] = key;
  audit_->add({.kind = AuditEntry::Kind::change,
               .from = origin,
               .who = who,
               .what = place + ": " + control,
               .before = entry.before,
               .after = entry.after,
               .times = static_cast<std::uint32_t>(entry.changes)});
}

void ChangeLog::tell(const Key& key, const Entry& entry) {
  audit(key, entry);
  if (!take_room()) {
    left_out_ += entry.changes;
    return;
  }
  const auto& [origin, who, place, control] = key;
  const std::string times = entry.changes > 1 ? fmt::format(" ({} changes)", entry.changes) : "";
  sink_(fmt::format("{}: {}: {} {} -> {}{}", origin, place, control, entry.before, entry.after,
                    times));
}

void ChangeLog::tell_left_out() {
  sink_(fmt::format("{} more changes of controls", std::exchange(left_out_, 0)));
}

}  // namespace skerry::server
