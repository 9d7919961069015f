// LossCounter: what a receiver missed, read off the sequence numbers it got.
#pragma once

#include <bitset>
#include <cstdint>

namespace skerry {

// Fed every sequence number received from one view, in order of arrival.  Since its first number,
// received + lost = newest - first + 1.  A number that comes late but for the first time is taken
// back from the lost; one that is more than kWindow behind the newest means that the sender has
// started again, and a new run begins.
// Thread: one at a time.
class LossCounter {
 public:
  static constexpr std::size_t kWindow = 1024;

  // Whether the spoke is new to the receiver (not a duplicate, not from before the first).
  bool take(std::uint64_t sequence);

  std::uint64_t received() const { return received_; }      // distinct
  std::uint64_t lost() const { return lost_; }              // not (yet) received
  std::uint64_t late() const { return late_; }              // came after a newer one
  std::uint64_t duplicates() const { return duplicates_; }  // came again
  std::uint64_t restarts() const { return restarts_; }      // new runs after the first

 private:
  void begin(std::uint64_t sequence);

  bool begun_ = false;
  std::uint64_t first_ = 0, newest_ = 0;
  std::bitset<kWindow + 1> seen_;  // bit n: newest_ - n was received
  std::uint64_t received_ = 0, lost_ = 0, late_ = 0, duplicates_ = 0, restarts_ = 0;
};

}  // namespace skerry
