// Latest<T>: the newest immutable value, handed from one thread to many.
#pragma once

#include <memory>
#include <mutex>
#include <utility>

namespace skerry::server {

// Holds a shared_ptr<const T>; a reader keeps the value it got alive for as long as it wants.
// A mutex and not std::atomic<std::shared_ptr>, which in g++ 12 is a spin lock with a race inside.
// Thread: any; the lock is held for one pointer copy.
template <typename T>
class Latest {
 public:
  Latest() = default;  // get() is nullptr until the first set()
  explicit Latest(T value) : value_(std::make_shared<const T>(std::move(value))) {}
  explicit Latest(std::shared_ptr<const T> value) : value_(std::move(value)) {}

  std::shared_ptr<const T> get() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }
  void set(std::shared_ptr<const T> value) {
    const std::lock_guard lock(mutex_);
    value_.swap(value);  // the old value is released after the lock, when `value` ends
  }
  void set(T value) { set(std::make_shared<const T>(std::move(value))); }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
};

}  // namespace skerry::server
