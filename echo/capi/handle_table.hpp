// HandleTable: which objects the callers of the C interface hold.
#pragma once

#include <cstdint>
#include <memory>
#include <shared_mutex>
#include <unordered_map>
#include <variant>

namespace skerry::echo::capi {

class SharedChart;
class Coast;
class Radar;

// Hands out tickets for objects and finds them again.  A ticket has the type of a pointer and is
// never followed as one: it is odd, so no object's address is a ticket, and it is never used twice,
// so a handle destroyed stays unknown.  (With 32-bit pointers tickets run out after 2^29 objects.)
// Thread: any.
class HandleTable {
 public:
  using Object =
      std::variant<std::shared_ptr<SharedChart>, std::shared_ptr<Coast>, std::shared_ptr<Radar>>;

  // The one of this process.  Never destroyed: threads may call while the process ends.
  static HandleTable& global();

  void* add(Object object);

  // Error: CallError HANDLE for what is no live handle, or one of another kind.  `name` is the
  // parameter's.
  template <typename T>
  std::shared_ptr<T> find(const char* name, const void* ticket) const {
    Object object = look_up(name, ticket);
    auto* found = std::get_if<std::shared_ptr<T>>(&object);
    if (!found) refuse_kind(name, object);
    return std::move(*found);
  }
  // Forgets the ticket; without it nothing happens.
  void remove(const void* ticket);

 private:
  Object look_up(const char* name, const void* ticket) const;
  [[noreturn]] static void refuse_kind(const char* name, const Object& object);

  mutable std::shared_mutex mutex_;
  std::unordered_map<std::uintptr_t, Object> objects_;
  std::uintptr_t next_ = 1;
};

}  // namespace skerry::echo::capi
