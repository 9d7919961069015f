#include "protocol/wire/sequence_gap.hpp"

namespace skerry {

void LossCounter::begin(std::uint64_t sequence) {
  begun_ = true;
  first_ = newest_ = sequence;
  seen_.reset();
  seen_.set(0);
  ++received_;
}

bool LossCounter::take(std::uint64_t sequence) {
  if (!begun_) {
    begin(sequence);
    return true;
  }
  if (sequence > newest_) {
    const std::uint64_t step = sequence - newest_;
    if (step < seen_.size()) {
      seen_ <<= step;
    } else {
      seen_.reset();
    }
    seen_.set(0);
    newest_ = sequence;
    lost_ += step - 1;
    ++received_;
    return true;
  }
  const std::uint64_t behind = newest_ - sequence;
  if (behind > kWindow) {
    ++restarts_;
    begin(sequence);
    return true;
  }
  if (seen_.test(behind)) {
    ++duplicates_;
    return false;
  }
  ++late_;
  if (sequence < first_) return false;
  seen_.set(behind);
  --lost_;
  ++received_;
  return true;
}

}  // namespace skerry
