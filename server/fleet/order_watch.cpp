#include "server/fleet/order_watch.hpp"

#include <algorithm>
#include <utility>

namespace skerry::fleet {

OrderWatch::OrderWatch(KeyStore& keys, StoreMark& mark, const std::string& exercise, Revision from,
                       std::set<std::string> held)
    : keys_(keys),
      mark_(mark),
      store_(keys, mark, exercise),
      next_(std::max<Revision>(from, 1)),
      held_(std::move(held)) {}

void OrderWatch::note(const LogEvent& event) {
  if (const auto* order = std::get_if<OrderSeen>(&event))
    mark_.note_order(order->id, order->revision);
  if (const auto* holder = std::get_if<HolderSeen>(&event)) {
    if (holder->host.empty())
      held_.erase(holder->name);
    else
      held_.insert(holder->name);
  }
}

StoreResult<std::vector<LogEvent>> OrderWatch::next(HostTime deadline) {
  if (must_read_) return read_anew(deadline);
  if (stream_ && keys_.now() - heard_ >= kQuiet) {
    stream_.reset();
    keys_.turn();
  }
  if (!stream_) {
    // A watch does not tell that the store is another one: it waits for revisions to come.
    const auto verified = store_.verify(deadline);
    if (!verified) return Failure{verified.error()};
    stream_ = keys_.watch(store_.keys().all(), next_);
    heard_ = keys_.now();
  }
  const auto step = stream_->next(std::min(deadline, heard_ + kQuiet));
  if (!step) {
    stream_.reset();
    must_read_ = step.error().trouble == Trouble::compacted;
    if (!must_read_) keys_.turn();
    return Failure{step.error()};
  }
  if (!step->events.empty()) heard_ = keys_.now();
  return events_of(*step);
}

StoreResult<std::vector<LogEvent>> OrderWatch::events_of(const WatchStep& step) {
  std::vector<LogEvent> events;
  for (const KeyEvent& change : step.events) {
    if (change.key.modified < next_) continue;  // given before the connection was lost
    auto event = store_.keys().event_of(change);
    if (!event) {
      stream_.reset();
      return Failure{event.error()};
    }
    if (!*event) continue;
    note(**event);
    events.push_back(std::move(**event));
  }
  if (!step.events.empty()) next_ = std::max(next_, step.events.back().key.modified + 1);
  return events;
}

StoreResult<std::vector<LogEvent>> OrderWatch::read_anew(HostTime deadline) {
  auto text = store_.read(1, deadline);
  if (!text) return Failure{text.error()};
  std::vector<LogEvent> events;
  std::set<std::string> gone = held_;
  for (HolderSeen& holder : text->holders) {
    gone.erase(holder.name);
    if (holder.revision >= next_) events.emplace_back(std::move(holder));
  }
  for (const std::string& name : gone) events.emplace_back(HolderSeen{text->at, name, {}, 0});
  for (OrderSeen& order : text->orders) {
    if (order.revision >= next_) events.emplace_back(std::move(order));
  }
  if (text->grant && text->grant->revision >= next_) events.emplace_back(*text->grant);
  std::stable_sort(events.begin(), events.end(), [](const LogEvent& a, const LogEvent& b) {
    return revision_of(a) < revision_of(b);
  });
  for (const LogEvent& event : events) note(event);
  next_ = text->at + 1;
  must_read_ = false;
  return events;
}

}  // namespace skerry::fleet
