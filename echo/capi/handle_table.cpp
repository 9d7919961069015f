#include "echo/capi/handle_table.hpp"

#include <fmt/format.h>

#include <array>
#include <mutex>
#include <new>

#include "echo/capi/call.hpp"

namespace skerry::echo::capi {

HandleTable& HandleTable::global() {
  static auto* const table = new HandleTable;
  return *table;
}

void* HandleTable::add(Object object) {
  const std::unique_lock lock(mutex_);
  if (next_ + 2 < next_) throw std::bad_alloc();
  objects_.emplace(next_, std::move(object));
  void* const ticket = reinterpret_cast<void*>(next_);  // NOLINT(performance-no-int-to-ptr)
  next_ += 2;
  return ticket;
}

void HandleTable::remove(const void* ticket) {
  Object object;  // let go outside the lock
  const std::unique_lock lock(mutex_);
  const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(ticket));
  if (found == objects_.end()) return;
  object = std::move(found->second);
  objects_.erase(found);
}

HandleTable::Object HandleTable::look_up(const char* name, const void* ticket) const {
  if (!ticket) throw CallError(SKERRY_ECHO_ERROR_HANDLE, fmt::format("{} is NULL", name));
  const std::shared_lock lock(mutex_);
  const auto found = objects_.find(reinterpret_cast<std::uintptr_t>(ticket));
  if (found == objects_.end()) {
    throw CallError(
        SKERRY_ECHO_ERROR_HANDLE,
        fmt::format("{} is no handle: destroyed, or never one of this library's", name));
  }
  return found->second;
}

void HandleTable::refuse_kind(const char* name, const Object& object) {
  constexpr std::array<const char*, 3> kKinds = {"chart", "coast", "radar"};
  throw CallError(SKERRY_ECHO_ERROR_HANDLE,
                  fmt::format("{} is the handle of a {}", name, kKinds[object.index()]));
}

}  // namespace skerry::echo::capi
