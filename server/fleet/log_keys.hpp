// Keys and values of an exercise in the store.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/fleet/log_event.hpp"

namespace skerry::fleet {

constexpr std::size_t kMostName = 128;         // bytes of an exercise's, a host's name, an id
constexpr std::size_t kMostOrder = 64 * 1024;  // bytes of an order: the largest is a few hundred

constexpr std::size_t kMostNote = 4096;  // bytes of a host's note

// "/skerry/<exercise>/" and what is under it.  Names are of letters, digits and . _ - : so that no
// name reaches into another exercise; those of holdings may have '/' between.
class LogKeys {
 public:
  // Requires is_name(exercise).
  explicit LogKeys(std::string_view exercise);

  const std::string& all() const { return all_; }
  std::string born() const { return all_ + "born"; }
  std::string grant() const { return all_ + "grant"; }
  std::string orders() const { return all_ + "order/"; }
  std::string order(std::string_view id) const { return orders() + std::string(id); }
  // Put once, by the first host: what all hosts of the exercise must agree on.
  std::string charter() const { return all_ + "charter"; }
  std::string notes() const { return all_ + "note/"; }
  std::string note(std::string_view host) const { return notes() + std::string(host); }
  std::string names() const { return all_ + "name/"; }
  std::string name(std::string_view name) const { return names() + std::string(name); }

  // What a change of a key says; nothing: a key that is not read.
  // Error: broken, with the key.
  StoreResult<std::optional<LogEvent>> event_of(const KeyEvent& event) const;

 private:
  std::string all_;
};

bool is_name(std::string_view name);
bool is_holding_name(std::string_view name);

// Error: broken, with the key and what is wrong with its value.
StoreResult<OrderSeen> order_of(const KeyValue& key, std::string_view id);
StoreResult<GrantSeen> grant_of(const KeyValue& key);

std::string order_value(Epoch epoch, Tick tick, const std::string& by, const std::string& order);
std::string grant_value(Epoch epoch, Tick to, Duration sent);

}  // namespace skerry::fleet
