#include "server/fleet/holding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "server/fleet/until_answered.hpp"

namespace skerry::fleet {

Holding::Holding(KeyStore& keys, StoreMark& mark, Wish wish)
    : keys_(keys),
      mark_(mark),
      wish_(std::move(wish)),
      key_(LogKeys(wish_.exercise).name(wish_.name)) {
  if (!is_name(wish_.exercise) || !is_holding_name(wish_.name) || !is_name(wish_.host))
    throw std::invalid_argument(fmt::format(
        "exercise \"{}\", name \"{}\", host \"{}\": expected 1 to {} letters, digits and . _ -",
        wish_.exercise, wish_.name, wish_.host, kMostName));
}

std::optional<Epoch> Holding::held(HostTime now) const {
  const std::lock_guard lock(mutex_);
  if (epoch_ == 0 || now >= until_) return std::nullopt;
  return epoch_;
}

HostTime Holding::held_until() const {
  const std::lock_guard lock(mutex_);
  return epoch_ == 0 ? HostTime{} : until_;
}

void Holding::set(Epoch epoch, HostTime until) {
  const std::lock_guard lock(mutex_);
  epoch_ = epoch;
  until_ = until;
}

// The lease is there when it returns, or why it is not.
std::optional<StoreError> Holding::keep(HostTime deadline) {
  for (;;) {
    const StoreSeen before = mark_.seen();
    HostTime asked{};
    const auto reply = until_answered(keys_, deadline, [&](HostTime attempt) {
      asked = keys_.now();
      return lease_ ? keys_.keep_lease(lease_, attempt) : keys_.grant_lease(wish_.ttl, attempt);
    });
    if (!reply) return reply.error();
    // Leases are kept by whichever member leads, whose answer may be of an earlier revision.
    if (before.cluster != 0 && reply->header.cluster != before.cluster)
      return mark_.check(before, reply->header);
    if (reply->ttl.count() > 0) {
      lease_ = reply->id;
      lease_until_ = asked + reply->ttl - Duration(reply->ttl) / kMarginShare;
      return std::nullopt;
    }
    lease_ = 0;  // it ran out
    set(0, HostTime{});
  }
}

Holding::Status Holding::take(HostTime deadline) {
  Transaction t;
  const bool had = epoch_ != 0;
  if (!had) {
    t.conditions = {{key_, Condition::Of::created, 0}};
    t.puts = {{key_, wish_.host, lease_}};
  }
  t.reads = {key_};
  const StoreSeen before = mark_.seen();
  const auto reply =
      until_answered(keys_, deadline, [&](HostTime attempt) { return keys_.transact(t, attempt); });
  if (!reply) return {Standing::unknown, {}, reply.error()};
  if (const auto trouble = mark_.check(before, reply->header)) {
    set(0, HostTime{});
    return {Standing::unknown, {}, *trouble};
  }
  const auto& found = reply->found.at(0);
  if (found && found->lease == lease_) {
    set(found->created, lease_until_);
    return {Standing::holds, wish_.host, std::nullopt};
  }
  set(0, HostTime{});
  return {Standing::other_holds, found ? found->value : std::string(), std::nullopt};
}

Holding::Status Holding::step(HostTime deadline) {
  if (const auto trouble = mark_.trouble()) {
    set(0, HostTime{});
    return {Standing::unknown, {}, *trouble};
  }
  if (auto error = keep(deadline)) {
    if (error->trouble == Trouble::went_back) set(0, HostTime{});
    return {Standing::unknown, {}, std::move(error)};
  }
  return take(deadline);
}

void Holding::release(HostTime deadline) {
  set(0, HostTime{});
  if (lease_ == 0) return;
  (void)until_answered(keys_, deadline,
                       [&](HostTime attempt) { return keys_.revoke_lease(lease_, attempt); });
  lease_ = 0;
}

}  // namespace skerry::fleet
