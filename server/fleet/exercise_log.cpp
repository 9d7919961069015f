#include "server/fleet/exercise_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skerry::fleet {

std::string_view name_of(ExerciseLog::Standing standing) {
  switch (standing) {
    case ExerciseLog::Standing::waiting:
      return "waiting";
    case ExerciseLog::Standing::following:
      return "following";
    case ExerciseLog::Standing::free:
      return "free";
    case ExerciseLog::Standing::must_come_back:
      return "must come back";
  }
  return "unknown";
}

ExerciseLog::ExerciseLog(std::string host, const Settings& settings, const Snapshot& from)
    : host_(std::move(host)), settings_(settings), from_(from), tick_(from.tick) {}

StoreError ExerciseLog::broken(Revision revision, std::string_view what) const {
  return {
      Trouble::broken,
      fmt::format("revision {} of the exercise's log {}: something else than Skerry has written "
                  "to it, or hosts run different versions; end the exercise",
                  revision, what),
      false};
}

std::optional<StoreError> ExerciseLog::hear(const LogEvent& event, HostTime now) {
  const Revision revision = revision_of(event);
  if (revision < known_) return std::nullopt;  // heard before
  if (std::holds_alternative<NoteSeen>(event)) return std::nullopt;
  std::optional<StoreError> error;
  if (const auto* holder = std::get_if<HolderSeen>(&event)) {
    // Names on one lease end in one revision.
    if (holder->name == kLeader) leader_ = *holder;
  } else if (revision == known_) {
    return std::nullopt;
  } else if (const auto* order = std::get_if<OrderSeen>(&event)) {
    error = hear_order(*order);
  } else {
    error = hear_grant(std::get<GrantSeen>(event), now);
  }
  known_ = revision;
  return error;
}

std::optional<StoreError> ExerciseLog::hear_order(const OrderSeen& order) {
  if (order.tick < last_order_tick_ || order.tick == 0)
    return broken(order.revision, fmt::format("has an order for tick {} behind one for tick {}",
                                              order.tick, last_order_tick_));
  last_order_tick_ = order.tick;
  if (order.revision <= from_.known && order.tick <= from_.tick) return std::nullopt;
  if (order.tick <= tick_) {
    if (!conflict_) conflict_ = Conflict{order.tick, order};
    return std::nullopt;
  }
  pending_.push_back(order);
  return std::nullopt;
}

std::optional<StoreError> ExerciseLog::hear_grant(const GrantSeen& grant, HostTime now) {
  if (grant_ && grant.to < grant_->to)
    return broken(grant.revision, fmt::format("grants to tick {}, and {} was granted before",
                                              grant.to, grant_->to));
  // An order stands behind the grant in force when it was put.
  if (last_order_tick_ > grant.to + 1)
    return broken(grant.revision, fmt::format("grants to tick {}, behind an order for tick {}",
                                              grant.to, last_order_tick_));
  if (grant.sent < Duration{0} || grant.sent > kLongest)
    return broken(grant.revision,
                  fmt::format("says that the exercise's time is {:.0f} s", in_seconds(grant.sent)));
  const auto most = static_cast<Tick>((grant.sent + kMostLead) / settings_.tick);
  const bool goes_on = grant_ && grant.to == grant_->to;
  if (!goes_on && grant.to > most)
    return broken(grant.revision,
                  fmt::format("grants to tick {}, more than {:.0f} s ahead of "
                              "{:.1f} s",
                              grant.to, in_seconds(kMostLead), in_seconds(grant.sent)));
  if (grant_ && grant.epoch != grant_->epoch) clock_.forget();
  if (!leads()) clock_.hear(grant.sent, now);
  grant_ = grant;
  grant_heard_ = now;
  return std::nullopt;
}

Tick ExerciseLog::tick_at(HostTime now) const {
  const auto time = clock_.at(now);
  if (!time || time->count() < 0) return tick_;
  return std::max(tick_, static_cast<Tick>(*time / settings_.tick));
}

ExerciseLog::Step ExerciseLog::advance(HostTime now) {
  Step step;
  const Tick by_clock = tick_at(now);
  const bool silent = now - grant_heard_ >= settings_.lead;
  step.run_to = tick_;
  if (!grant_) {
    step.standing = Standing::waiting;
  } else if (by_clock <= grant_->to) {
    step.run_to = by_clock;
    step.standing = Standing::following;
    free_ = false;
  } else if (!silent) {
    step.run_to = std::max(tick_, grant_->to);
    step.standing = Standing::waiting;
    free_ = false;
  } else if (!free_ && tick_ <= grant_->to) {
    // To the grant's end, all of whose orders are known; the next step goes beyond.
    step.run_to = grant_->to;
    step.standing = Standing::free;
    step.keep = !conflict_;
    free_ = true;
  } else {
    step.run_to = by_clock;
    step.standing = Standing::free;
    free_ = true;
  }
  tick_ = step.run_to;
  if (conflict_) {
    step.standing = Standing::must_come_back;
    step.conflict = conflict_;
    return step;
  }
  while (!pending_.empty() && pending_.front().tick <= tick_) {
    const Tick tick = pending_.front().tick;
    step.orders.push_back({tick, std::move(pending_.front())});
    pending_.pop_front();
  }
  return step;
}

void ExerciseLog::lead(std::optional<Epoch> epoch, HostTime now) {
  if (epoch == my_epoch_) return;
  my_epoch_ = epoch;
  grant_sent_.reset();
  if (!epoch) {
    clock_.forget();
    return;
  }
  // The exercise's clock is this host's from now on, and goes on from what it had of it.
  const Duration begin = settings_.tick * static_cast<std::int64_t>(tick_);
  clock_.set(std::max(begin, clock_.at(now).value_or(begin)), now);
}

std::optional<GrantWish> ExerciseLog::grant_due(HostTime now) {
  // Only what was heard of the log counts: also that one leads.  Who must come back has no world
  // for others to agree with.
  if (!leads() || conflict_) return std::nullopt;
  if (grant_sent_ && now - *grant_sent_ < settings_.renew) return std::nullopt;
  grant_sent_ = now;
  const Duration time = clock_.at(now).value_or(Duration{0});
  const Tick to = static_cast<Tick>((time + settings_.lead) / settings_.tick);
  return GrantWish{*my_epoch_, grant_ ? grant_->revision : 0, std::max({to, granted_to(), tick_}),
                   time};
}

std::variant<ExerciseLog::Place, ExerciseLog::Refusal> ExerciseLog::place_of_order(
    HostTime now) const {
  const std::string store =
      store_error_ ? fmt::format("; its store: {}", store_error_->text) : std::string();
  if (conflict_)
    return Refusal{fmt::format("this host takes no orders: it must come back, as order "
                               "{} holds from tick {}, which it ran without it",
                               conflict_->order.id, conflict_->tick),
                   false};
  if (!grant_) return Refusal{"the exercise has no leader yet, which grants it time" + store, true};
  const auto silence = now - grant_heard_;
  if (free_ || silence >= settings_.lead)
    return Refusal{fmt::format("host {} is cut off from the exercise and runs free: no grant for "
                               "{:.1f} s{}",
                               host_, in_seconds(silence), store),
                   false};
  if (leader_.host.empty() || leader_.epoch != grant_->epoch)
    return Refusal{"the exercise changes its leader" + store, true};
  const auto time = clock_.at(now);
  const Duration end = settings_.tick * static_cast<std::int64_t>(grant_->to + 1);
  if (!time || *time + settings_.fresh > end || tick_ > grant_->to)
    return Refusal{"the exercise's next grant is awaited" + store, true};
  return Place{grant_->epoch, grant_->revision, grant_->to + 1};
}

}  // namespace skerry::fleet
