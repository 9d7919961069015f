#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>

#include "protocol/board/ring_memory.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/board/sweep_ring.hpp"

namespace skerry::board {
namespace {

// Looks at the ring before a reader goes to sleep, a few microseconds: a writer in full flow is
// spared the wake, which costs it as much as a copy of 16 KiB, and the reader the way back.
constexpr int kLooks = 200;

// A reader that is overtaken as often in one take() finds nothing, for now.
constexpr int kAttempts = 64;

const RingHeader& header_of(std::span<const std::uint8_t> memory) {
  return *std::launder(reinterpret_cast<const RingHeader*>(memory.data()));
}

// In memory that holds no ring a position may be anything: records begin at multiples of 64.
constexpr std::uint64_t aligned(std::uint64_t position) {
  return position / kRecordAlignment * kRecordAlignment;
}

void pause_briefly() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

timespec timespec_of(std::chrono::nanoseconds time) {
  const auto whole = std::chrono::duration_cast<std::chrono::seconds>(time);
  return {whole.count(), (time - whole).count()};
}

}  // namespace

std::optional<SweepRingReader> SweepRingReader::open(std::span<const std::uint8_t> memory) {
  const bool page = reinterpret_cast<std::uintptr_t>(memory.data()) % kRecordAlignment == 0;
  if (!page || memory.size() < kRingHeader) return std::nullopt;
  const RingHeader& header = header_of(memory);
  if (header.magic.load(std::memory_order_acquire) != kRingMagic) return std::nullopt;
  if (header.version.load(std::memory_order_relaxed) != kRingVersion) return std::nullopt;
  if (header.header_bytes.load(std::memory_order_relaxed) != kRingHeader) return std::nullopt;
  const std::uint64_t capacity = header.capacity.load(std::memory_order_relaxed);
  if (capacity < kLeastRingCapacity || capacity % kRingGrain != 0) return std::nullopt;
  if (capacity > memory.size() - kRingHeader) return std::nullopt;
  SweepRingReader reader(memory.first(kRingHeader + capacity));
  // So that no record waits for its pages; memory that has none of its own does without.
  madvise(const_cast<std::uint8_t*>(memory.data()), reader.memory_.size(), MADV_POPULATE_READ);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (reader.begin_behind_newest()) return reader;
  }
  reader.position_ = reader.published();
  return reader;
}

std::uint64_t SweepRingReader::published() const {
  return aligned(header_of(memory_).published.load(std::memory_order_acquire));
}

// Whether all from position_ on is still as it was when it was published.
bool SweepRingReader::untouched() const {
  return header_of(memory_).reserved.load(std::memory_order_acquire) - position_ <= capacity();
}

bool SweepRingReader::begin_behind_newest() {
  to_newest();
  const std::uint64_t end = published();
  if (header_of(memory_).newest.load(std::memory_order_acquire) == kNoRecord) {
    from_start_ = true;
    return true;
  }
  if (position_ >= end) return false;
  std::array<std::uint8_t, kRecordAlignment> first;
  copy_from_shared(first, memory_.data() + kRingHeader + position_ % capacity());
  const auto prefix = record_prefix(first);
  if (!prefix || !untouched() || prefix->size > end - position_) return false;
  position_ += prefix->size;
  next_sequence_ = prefix->sequence + 1;
  return true;
}

// The newest record that is readable; behind it, where another is just coming.
void SweepRingReader::to_newest() {
  const std::uint64_t newest = aligned(header_of(memory_).newest.load(std::memory_order_acquire));
  const std::uint64_t end = published();
  position_ = newest < end && end - newest <= capacity() ? newest : end;
}

void SweepRingReader::count(std::uint64_t sequence) {
  if (!next_sequence_ && from_start_) {
    next_sequence_ = header_of(memory_).first_sequence.load(std::memory_order_acquire);
  }
  // A sequence that goes back is a board that began anew.
  if (next_sequence_ && sequence >= *next_sequence_) lost_ += sequence - *next_sequence_;
  next_sequence_ = sequence + 1;
}

SweepRingReader::State SweepRingReader::take(Bytes& out) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const bool closed = header_of(memory_).closed.load(std::memory_order_acquire) != 0;
    const std::uint64_t end = published(), ahead = end - position_;
    if (ahead == 0) {
      out.clear();
      return closed ? State::closed : State::empty;
    }
    if (ahead > capacity()) {
      to_newest();
      continue;
    }
    const std::uint8_t* const record = memory_.data() + kRingHeader + position_ % capacity();
    const std::uint64_t to_end = capacity() - position_ % capacity();
    std::array<std::uint8_t, kRecordAlignment> first;
    copy_from_shared(first, record);
    const auto prefix = record_prefix(first);
    const bool filler = prefix && prefix->kind == static_cast<std::uint8_t>(RecordKind::filler);
    const bool sensible =
        prefix && prefix->size <= std::min(ahead, to_end) && (!filler || prefix->size == to_end);
    if (sensible && !filler) {
      out.resize(prefix->size);
      std::copy(first.begin(), first.end(), out.begin());
      copy_from_shared(std::span(out).subspan(first.size()), record + first.size());
    }
    if (!untouched()) {
      to_newest();
      continue;
    }
    if (!sensible) {
      position_ = end;
      continue;
    }
    position_ += prefix->size;
    if (filler) continue;
    count(prefix->sequence);
    return State::record;
  }
  out.clear();
  return State::empty;
}

bool SweepRingReader::ready() const {
  return published() != position_ || header_of(memory_).closed.load(std::memory_order_acquire) != 0;
}

bool SweepRingReader::wait(std::chrono::nanoseconds timeout) {
  for (int look = 0; look < kLooks; ++look) {
    if (ready()) return true;
    pause_briefly();
  }
  const std::atomic<std::uint32_t>& word = header_of(memory_).wakes;
  const std::uint32_t seen = word.load(std::memory_order_acquire);
  if (ready()) return true;
  if (timeout <= timeout.zero()) return false;
  timespec time = timespec_of(timeout);
  // Sleeping on a word needs no right to write it.
  const long slept = syscall(SYS_futex, reinterpret_cast<const std::uint32_t*>(&word), FUTEX_WAIT,
                             seen, &time, nullptr, 0);
  if (slept != 0 && errno != EAGAIN && errno != ETIMEDOUT && errno != EINTR) {
    // A kind of memory that cannot be slept on (pages private to a process).
    time = timespec_of(std::min<std::chrono::nanoseconds>(timeout, std::chrono::milliseconds(1)));
    nanosleep(&time, nullptr);
  }
  return ready();
}

}  // namespace skerry::board
