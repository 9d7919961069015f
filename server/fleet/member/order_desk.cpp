#include "server/fleet/member/order_desk.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <utility>

#include "server/fleet/order_store.hpp"

namespace skerry::fleet {
namespace {

constexpr std::chrono::milliseconds kAwaitGrant{5};

}  // namespace

OrderDesk::OrderDesk(const MemberPlan& plan, StoreMark& mark, Place place, Refused refused)
    : plan_(plan), mark_(mark), place_(std::move(place)), refused_(std::move(refused)) {}

void OrderDesk::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "fleet-orders");
    run(stop);
  });
}

void OrderDesk::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
  std::deque<Waiting> left;
  {
    const std::lock_guard lock(mutex_);
    left.swap(waiting_);
  }
  for (const Waiting& order : left) refused_(order.id, "this host ends");
}

bool OrderDesk::add(std::string id, std::string order) {
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() >= kMostWaiting) return false;
    waiting_.push_back({std::move(id), std::move(order), host_now() + kPatience});
  }
  added_.notify_one();
  return true;
}

void OrderDesk::run(const std::stop_token& stop) {
  const auto keys = plan_.store();
  OrderStore store(*keys, mark_, plan_.exercise);
  std::unique_lock lock(mutex_);
  while (added_.wait(lock, stop, [this] { return !waiting_.empty(); }) && !stop.stop_requested()) {
    const Waiting order = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    append(store, *keys, order, stop);
    lock.lock();
  }
}

void OrderDesk::append(OrderStore& store, KeyStore& keys, const Waiting& order,
                       const std::stop_token& stop) {
  std::string why = "this host ends";
  bool maybe_done = false;
  while (!stop.stop_requested()) {
    const auto place = place_();
    if (const auto* refusal = std::get_if<ExerciseLog::Refusal>(&place)) {
      why = refusal->text;
      // What may stand in the log already is asked for until it is known.
      if (host_now() >= order.until || (!refusal->soon && !maybe_done)) break;
      keys.wait_until(keys.now() + kAwaitGrant);
      continue;
    }
    const auto& at = std::get<ExerciseLog::Place>(place);
    const auto done = store.append({order.id, plan_.host, order.order, at.epoch, at.grant, at.tick},
                                   std::min(order.until, keys.now() + std::chrono::seconds(1)));
    if (done) return;
    why = done.error().text;
    maybe_done = maybe_done || done.error().maybe_done;
    const Trouble trouble = done.error().trouble;
    // Nothing of former attempts will be done any more either.
    if (trouble == Trouble::deposed || trouble == Trouble::overtaken) maybe_done = false;
    const bool again =
        may_pass(trouble) || trouble == Trouble::deposed || trouble == Trouble::overtaken;
    if (!again || host_now() >= order.until) break;
    keys.wait_until(keys.now() + kAwaitGrant);
  }
  refused_(order.id, maybe_done ? fmt::format("it is not known whether the order will hold: {}; "
                                              "look before you give it again",
                                              why)
                                : why);
}

}  // namespace skerry::fleet
