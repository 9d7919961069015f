// Member: what it knows of the fleet, and what it tells.
#include <algorithm>
#include <utility>

#include "server/fleet/log_messages.pb.h"
#include "server/fleet/member/member.hpp"

namespace skerry::fleet {
namespace {

std::string word_of(ExerciseLog::Standing standing) {
  return standing == ExerciseLog::Standing::must_come_back ? "must come back"
                                                           : std::string(name_of(standing));
}

// But for when hosts were heard, their worlds, and for how long orders are refused.
bool is_told_alike(const MemberView& a, const MemberView& b) {
  const auto same_host = [](const HostSeen& one, const HostSeen& other) {
    return one.name == other.name && one.native == other.native && one.web == other.web &&
           one.standing == other.standing && one.ships == other.ships;
  };
  return a.standing == b.standing && a.refusal.empty() == b.refusal.empty() &&
         a.leader == b.leader &&
         std::equal(a.hosts.begin(), a.hosts.end(), b.hosts.begin(), b.hosts.end(), same_host);
}

}  // namespace

ShipSeats::Known Member::known() const {
  const std::lock_guard lock(mutex_);
  ShipSeats::Known known;
  known.takes = runs_ && !ended_ && view_.standing != "must come back";
  known.holders = holders_;
  // Ships are shared by those who take them: one that has just come, or comes back, does not yet.
  known.present = {plan_.host};
  for (const std::string& name : present_) {
    const auto told = notes_.find(name);
    if (told != notes_.end() && told->second.takes) known.present.insert(name);
  }
  HostNote note;
  note.set_native(plan_.native);
  note.set_web(plan_.web);
  note.set_standing(view_.standing);
  note.set_takes(known.takes && seats_.may_take());
  if (digest_tick_ != 0) {
    note.set_tick(digest_tick_);
    note.set_digest(digest_.data(), digest_.size());
  }
  known.note = note.SerializeAsString();
  return known;
}

// mutex_ held.  What has changed of the view.
void Member::look_around(ExerciseLog::Standing standing, HostTime now) {
  MemberView next = view_;
  next.standing = awaits_log_ || !log_->granted() ? "joining" : word_of(standing);
  next.leader = leader_host_;
  next.refusal.clear();
  if (ended_) {
    next.standing = "ended";
    next.refusal = *ended_;
  } else if (const auto place = log_->place_of_order(now);
             const auto* refusal = std::get_if<ExerciseLog::Refusal>(&place)) {
    if (!refusal->soon) next.refusal = refusal->text;
  }
  next.hosts.clear();
  for (const std::string& name : present_) {
    const auto note = notes_.find(name);
    HostSeen host = note == notes_.end() ? HostSeen{} : note->second;
    host.name = name;
    if (name == plan_.host) {
      host.native = plan_.native;
      host.web = plan_.web;
      host.standing = next.standing;
      host.heard = now;
      host.tick = digest_tick_;
      host.digest = digest_;
    }
    for (std::size_t ship = 0; ship < holders_.size(); ++ship) {
      // Who is cut off hears nobody take them.
      const bool is_made = name != plan_.host || made_until_[ship] > now;
      if (holders_[ship] == name && is_made) host.ships.push_back(ship);
    }
    next.hosts.push_back(std::move(host));
  }
  if (!is_told_alike(next, view_)) ++next.version;
  view_ = std::move(next);
}

}  // namespace skerry::fleet
