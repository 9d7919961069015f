#include "server/fleet/member/leader_seat.hpp"

#include <pthread.h>

#include <utility>

#include "server/fleet/order_store.hpp"

namespace skerry::fleet {
namespace {

constexpr std::chrono::milliseconds kGrantLook{10};
constexpr auto kSeatStep = std::chrono::milliseconds(Holding::kLease) / 4;

}  // namespace

LeaderSeat::LeaderSeat(const MemberPlan& plan, StoreMark& mark, May may, Due due, Said said)
    : plan_(plan),
      mark_(mark),
      may_(std::move(may)),
      due_(std::move(due)),
      said_(std::move(said)),
      keys_(plan.store()),
      holding_(*keys_, mark, {plan.exercise, kLeader, plan.host}) {}

void LeaderSeat::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "fleet-leader");
    run(stop);
  });
}

void LeaderSeat::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void LeaderSeat::run(const std::stop_token& stop) {
  OrderStore store(*keys_, mark_, plan_.exercise);
  HostTime step_at = keys_->now();
  while (!stop.stop_requested()) {
    if (keys_->now() >= step_at) {
      step_at = keys_->now() + kSeatStep;
      if (may_()) {
        said_(holding_.step(keys_->now() + kStoreCall).error);
      } else {
        holding_.release(keys_->now() + kStoreCall);
      }
    }
    if (const auto wish = due_()) {
      const auto granted = store.grant(*wish, keys_->now() + kStoreCall);
      said_(granted ? std::nullopt : std::optional(granted.error()));
    }
    keys_->wait_until(keys_->now() + kGrantLook);
  }
  holding_.release(keys_->now() + kStoreCall);
}

}  // namespace skerry::fleet
