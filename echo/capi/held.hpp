// Held: an object of the interface, found by its handle, that no other thread uses meanwhile.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "echo/capi/call.hpp"
#include "echo/capi/handle_table.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo::capi {

template <typename T>
class Held {
 public:
  // Error: CallError HANDLE; BUSY where another thread holds it.
  Held(const char* name, const void* handle)
      : object_(HandleTable::global().find<T>(name, handle)),
        lock_(object_->in_use, std::try_to_lock) {
    if (!lock_) {
      throw CallError(SKERRY_ECHO_ERROR_BUSY,
                      std::string(name) + " is in use by another thread; one at a time may");
    }
  }
  T* operator->() const { return object_.get(); }
  T& operator*() const { return *object_; }

 private:
  std::shared_ptr<T> object_;  // outlives the lock
  std::unique_lock<std::mutex> lock_;
};

// Hands a new object to the caller.
template <typename T, typename Handle>
void give(std::shared_ptr<T> object, Handle** out) {
  *out = static_cast<Handle*>(HandleTable::global().add(std::move(object)));
}

// Error: CallError ARGUMENT.
inline GeoPoint place_of(double latitude_deg, double longitude_deg) {
  require_range("latitude_deg", latitude_deg, -90.0, 90.0);
  require_range("longitude_deg", longitude_deg, -180.0, 180.0);
  return {latitude_deg, wrapped_longitude(longitude_deg)};
}

}  // namespace skerry::echo::capi
