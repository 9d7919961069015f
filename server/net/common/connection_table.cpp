#include "server/net/common/connection_table.hpp"

#include <algorithm>

namespace skerry::server {

ConnectionSlotPtr ConnectionTable::try_enter() {
  std::erase_if(slots_, [](const auto& slot) { return slot.expired(); });
  if (slots_.size() >= limit_ + kRefusals) return nullptr;
  const auto served = std::count_if(slots_.begin(), slots_.end(), [](const auto& known) {
    const ConnectionSlotPtr slot = known.lock();
    return slot != nullptr && !slot->over_limit;
  });
  auto slot = std::make_shared<ConnectionSlot>();
  slot->over_limit = static_cast<std::size_t>(served) >= limit_;
  slots_.push_back(slot);
  return slot;
}

void ConnectionTable::close_all() {
  for (const auto& known : slots_) {
    const ConnectionSlotPtr slot = known.lock();
    if (slot == nullptr) continue;
    if (const auto owner = slot->owner.lock()) owner->close();
  }
}

}  // namespace skerry::server
