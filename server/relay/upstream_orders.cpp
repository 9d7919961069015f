#include "server/relay/upstream_orders.hpp"

namespace skerry::server {

bool UpstreamOrders::add(UpstreamOrder order) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return false;
    if (orders_.size() >= kMost && !std::holds_alternative<CloseUp>(order)) return false;
    orders_.push_back(std::move(order));
  }
  if (wake_) wake_();
  return true;
}

std::vector<UpstreamOrder> UpstreamOrders::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(orders_, {});
}

void UpstreamOrders::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
}

}  // namespace skerry::server
