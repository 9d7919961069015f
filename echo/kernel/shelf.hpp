// Shelf: memory that is only needed for a while, shared by all who need such memory.
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace skerry::echo {

// Things are taken and put back; what was put back last is taken first, for that is what still lies
// in a near cache.  So many radars that make a sector each by turns work in the same few rows, as
// many as are at work at once, whichever thread it is.  What is taken holds what its last user left
// in it.  Thread: any.
template <typename T>
class Shelf {
 public:
  // More than that are not kept.
  static constexpr std::size_t kMost = 64;

  T take() {
    const std::lock_guard lock(mutex_);
    if (things_.empty()) return T{};
    T last = std::move(things_.back());
    things_.pop_back();
    return last;
  }
  void put_back(T thing) {
    const std::lock_guard lock(mutex_);
    if (things_.size() < kMost) things_.push_back(std::move(thing));
  }
  std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return things_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<T> things_;  // put back last at the end
};

}  // namespace skerry::echo
