#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <new>
#include <stdexcept>

#include "protocol/board/record_layout.hpp"
#include "protocol/board/ring_memory.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/board/sweep_ring.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::board {
namespace {

constexpr std::size_t kPage = 4096;

RingHeader& header_to_write(std::span<std::uint8_t> memory) {
  return *std::launder(reinterpret_cast<RingHeader*>(memory.data()));
}

std::size_t size_of_first(std::span<const std::uint8_t> records) {
  const auto prefix = record_prefix(records);
  return prefix && prefix->size <= records.size() ? prefix->size : 0;
}

// Bytes of as many whole records, from the first on, as fit into `room`.
std::size_t whole_records_within(std::span<const std::uint8_t> records, std::size_t room) {
  std::size_t bytes = 0;
  while (bytes < records.size()) {
    const std::size_t next = size_of_first(records.subspan(bytes));
    if (bytes + next > room) break;
    bytes += next;
  }
  return bytes;
}

void wake_all(std::atomic<std::uint32_t>& word) {
  word.fetch_add(1, std::memory_order_release);
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAKE, INT_MAX, nullptr, nullptr,
          0);
}

// The first position of a ring: so far beyond those of an earlier ring in the same memory that a
// reader of that one is overtaken.
std::uint64_t start_of(const RingHeader& header, std::uint64_t capacity) {
  const std::uint64_t before = header.reserved.load(std::memory_order_acquire);
  const bool same = header.magic.load(std::memory_order_acquire) == kRingMagic &&
                    header.capacity.load(std::memory_order_relaxed) == capacity;
  return same && before < kNoRecord / 4 ? (before / capacity + 2) * capacity : 0;
}

}  // namespace

std::size_t ring_bytes(std::size_t capacity) {
  const std::size_t at_least = std::max(capacity, kLeastRingCapacity);
  return kRingHeader + (at_least + kRingGrain - 1) / kRingGrain * kRingGrain;
}

SweepRingWriter::SweepRingWriter(std::span<std::uint8_t> memory) : memory_(memory) {
  const bool aligned = reinterpret_cast<std::uintptr_t>(memory.data()) % kPage == 0;
  if (!aligned || memory.size() <= kRingHeader ||
      ring_bytes(memory.size() - kRingHeader) != memory.size()) {
    throw std::invalid_argument(
        "the memory of a sweep ring is not page aligned or not of a size "
        "that ring_bytes() gives");
  }
  // So that no write waits for its pages.
  madvise(memory.data(), memory.size(), MADV_POPULATE_WRITE);
  RingHeader& header = header_to_write(memory);
  start_ = position_ = start_of(header, capacity());
  header.reserved.store(start_, std::memory_order_release);
  header.newest.store(kNoRecord, std::memory_order_release);
  header.published.store(start_, std::memory_order_release);
  header.closed.store(0, std::memory_order_release);
  header.version.store(kRingVersion, std::memory_order_relaxed);
  header.header_bytes.store(kRingHeader, std::memory_order_relaxed);
  header.capacity.store(capacity(), std::memory_order_relaxed);
  header.first_sequence.store(0, std::memory_order_relaxed);
  header.magic.store(kRingMagic, std::memory_order_release);
}

void SweepRingWriter::write(std::span<const std::uint8_t> records, std::uint64_t first_sequence,
                            std::uint32_t count) {
  std::uint32_t found = 0;
  for (std::size_t at = 0; at < records.size(); ++found) {
    const std::size_t size = size_of_first(records.subspan(at));
    if (size == 0) throw std::invalid_argument("a sweep ring takes whole records only");
    at += size;
  }
  if (found != count)
    throw std::invalid_argument("a sweep ring was given another number of records");
  if (count == 0) return;
  if (position_ == start_) {
    header_to_write(memory_).first_sequence.store(first_sequence, std::memory_order_release);
  }
  while (!records.empty()) {
    const std::size_t part = whole_records_within(records, capacity() / 4);
    publish(records.first(part));
    records = records.subspan(part);
  }
}

void SweepRingWriter::publish(std::span<const std::uint8_t> records) {
  RingHeader& header = header_to_write(memory_);
  const std::uint64_t to_end = capacity() - position_ % capacity();
  const std::size_t before_end = whole_records_within(records, to_end);
  const std::uint64_t filler = before_end < records.size() ? to_end - before_end : 0;
  const std::uint64_t end = position_ + records.size() + filler;
  header.reserved.store(end, std::memory_order_release);

  copy_in(records.first(before_end));
  if (filler > 0) {
    std::array<std::uint8_t, kRecordAlignment> prefix = {};
    put_little_endian(prefix, layout::kSize, filler, 4);
    prefix[layout::kKind] = static_cast<std::uint8_t>(RecordKind::filler);
    copy_in(prefix);
    position_ += filler - prefix.size();
  }
  copy_in(records.subspan(before_end));

  std::size_t last = 0;
  for (std::size_t at = 0; at < records.size(); at += size_of_first(records.subspan(at))) last = at;
  header.newest.store(end - (records.size() - last), std::memory_order_release);
  header.published.store(end, std::memory_order_release);
  wake_all(header.wakes);
}

void SweepRingWriter::copy_in(std::span<const std::uint8_t> records) {
  copy_to_shared(memory_.data() + kRingHeader + position_ % capacity(), records);
  position_ += records.size();
}

void SweepRingWriter::close() {
  RingHeader& header = header_to_write(memory_);
  header.closed.store(1, std::memory_order_release);
  wake_all(header.wakes);
}

}  // namespace skerry::board
