#include "server/fleet/log_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "server/fleet/log_messages.pb.h"

namespace skerry::fleet {
namespace {

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '-';
}

// A key that is no name of ours may hold anything: it is not repeated.
StoreError broken_key(const KeyValue& key, std::string_view what) {
  const bool ours = !key.key.empty() && is_holding_name(std::string_view(key.key).substr(1));
  return {Trouble::broken,
          fmt::format("the store's key {} {}; something else than Skerry has written to it: start "
                      "the exercise under another name",
                      ours ? key.key : fmt::format("(of {} bytes)", key.key.size()), what),
          false};
}

}  // namespace

bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= kMostName &&
         std::all_of(name.begin(), name.end(), is_name_letter);
}

bool is_holding_name(std::string_view name) {
  return !name.empty() && name.size() <= kMostName && name.front() != '/' && name.back() != '/' &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return is_name_letter(c) || c == '/'; });
}

LogKeys::LogKeys(std::string_view exercise) : all_("/skerry/" + std::string(exercise) + "/") {}

StoreResult<std::optional<LogEvent>> LogKeys::event_of(const KeyEvent& event) const {
  const std::string_view key = event.key.key;
  if (key.starts_with(names())) {
    HolderSeen seen{event.key.modified, std::string(key.substr(names().size())), {}, 0};
    if (!is_holding_name(seen.name)) return Failure{broken_key(event.key, "is no name to hold")};
    if (!event.deleted) {
      if (!is_name(event.key.value)) return Failure{broken_key(event.key, "names no host")};
      seen.host = event.key.value;
      seen.epoch = event.key.created;
    }
    return std::optional<LogEvent>(std::move(seen));
  }
  if (key.starts_with(notes())) {
    NoteSeen seen{event.key.modified, std::string(key.substr(notes().size())), event.key.value};
    if (event.deleted || !is_name(seen.host) || seen.note.size() > kMostNote)
      return std::optional<LogEvent>();
    return std::optional<LogEvent>(std::move(seen));
  }
  const bool order = key.starts_with(orders());
  if (!order && key != grant() && key != born()) return std::optional<LogEvent>();
  if (event.deleted) return Failure{broken_key(event.key, "was deleted")};
  if (order) {
    auto seen = order_of(event.key, key.substr(orders().size()));
    if (!seen) return Failure{seen.error()};
    return std::optional<LogEvent>(std::move(*seen));
  }
  if (key == born()) return std::optional<LogEvent>();
  auto seen = grant_of(event.key);
  if (!seen) return Failure{seen.error()};
  return std::optional<LogEvent>(std::move(*seen));
}

StoreResult<OrderSeen> order_of(const KeyValue& key, std::string_view id) {
  if (key.created != key.modified) return Failure{broken_key(key, "was changed")};
  LogOrder message;
  if (!is_name(id)) return Failure{broken_key(key, "is no order's id")};
  if (!message.ParseFromString(key.value) || !is_name(message.by()) ||
      message.order().size() > kMostOrder)
    return Failure{broken_key(key, "is no order")};
  return OrderSeen{key.created,     message.epoch(), message.tick(),
                   std::string(id), message.by(),    std::move(*message.mutable_order())};
}

StoreResult<GrantSeen> grant_of(const KeyValue& key) {
  LogGrant message;
  if (!message.ParseFromString(key.value)) return Failure{broken_key(key, "is no grant")};
  return GrantSeen{key.modified, message.epoch(), message.to(), Duration(message.sent_ns())};
}

std::string order_value(Epoch epoch, Tick tick, const std::string& by, const std::string& order) {
  LogOrder message;
  message.set_epoch(epoch);
  message.set_tick(tick);
  message.set_by(by);
  message.set_order(order);
  return message.SerializeAsString();
}

std::string grant_value(Epoch epoch, Tick to, Duration sent) {
  LogGrant message;
  message.set_epoch(epoch);
  message.set_to(to);
  message.set_sent_ns(sent.count());
  return message.SerializeAsString();
}

}  // namespace skerry::fleet
