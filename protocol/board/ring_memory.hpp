// The layout of a SweepRing's memory, and how its words are copied.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace skerry::board {

inline constexpr std::uint64_t kRingMagic = 0x474E'4952'5952'4B53;  // "SKRYRING", first lowest
inline constexpr std::uint32_t kRingVersion = 1;
inline constexpr std::size_t kRingGrain = 65'536;           // a capacity is a multiple of it
inline constexpr std::size_t kLeastRingCapacity = 524'288;  // eight records of the longest

inline constexpr std::uint64_t kNoRecord = ~std::uint64_t{0};

// Positions count the bytes of records, fillers included; the byte of a position is at
// kRingHeader + position % capacity.  All in the byte order of the host.
struct RingHeader {
  std::atomic<std::uint64_t> magic;  // last to be set
  std::atomic<std::uint32_t> version;
  std::atomic<std::uint32_t> header_bytes;
  std::atomic<std::uint64_t> capacity;
  std::atomic<std::uint64_t> first_sequence;  // of the first record, once there is one

  // Order of a write: reserved, records, newest, published, wakes.
  alignas(64) std::atomic<std::uint64_t> reserved;  // what is being written ends here
  std::atomic<std::uint64_t> published;             // what is readable ends here
  std::atomic<std::uint64_t> newest;  // where the last readable record begins, or kNoRecord

  alignas(64) std::atomic<std::uint32_t> wakes;  // +1 with every write; readers sleep on it
  std::atomic<std::uint32_t> closed;             // 1: nothing more comes
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
static_assert(sizeof(std::atomic<std::uint64_t>) == 8 && sizeof(std::atomic<std::uint32_t>) == 4);
static_assert(offsetof(RingHeader, reserved) == 64 && offsetof(RingHeader, wakes) == 128);

// Sizes are multiples of 64, shared memory is aligned to 64.  A reader that sees a byte of a write
// must see what came before it, so also `reserved`.  In the language that takes words stored with
// release and loaded with acquire.  The processors of x86 keep stores, and loads, in their order
// whatever their width, so that there the compiler alone has to be held back: three times as fast
// for records that are still in a cache.  The thread sanitizer gets the words.
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__)
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SKERRY_RING_WORDS 1
#endif
#endif
#else
#define SKERRY_RING_WORDS 1
#endif

#if defined(SKERRY_RING_WORDS)
inline void copy_to_shared(std::uint8_t* shared, std::span<const std::uint8_t> bytes) {
  auto* words = reinterpret_cast<std::atomic<std::uint64_t>*>(shared);
  const std::uint8_t* from = bytes.data();
  for (std::size_t left = bytes.size() / 64; left > 0; --left, words += 8, from += 64) {
    std::uint64_t block[8];
    std::memcpy(block, from, sizeof block);
    for (int i = 0; i < 8; ++i) words[i].store(block[i], std::memory_order_release);
  }
}

inline void copy_from_shared(std::span<std::uint8_t> bytes, const std::uint8_t* shared) {
  const auto* words = reinterpret_cast<const std::atomic<std::uint64_t>*>(shared);
  std::uint8_t* to = bytes.data();
  for (std::size_t left = bytes.size() / 64; left > 0; --left, words += 8, to += 64) {
    std::uint64_t block[8];
    for (int i = 0; i < 8; ++i) block[i] = words[i].load(std::memory_order_acquire);
    std::memcpy(to, block, sizeof block);
  }
}
#else
// 64 bytes at a time become loads and stores of registers, not a call whose stores may be of a kind
// that is not kept in order.
inline void copy_in_order(std::uint8_t* to, const std::uint8_t* from, std::size_t size) {
  std::atomic_signal_fence(std::memory_order_seq_cst);
  for (std::size_t left = size / 64; left > 0; --left, to += 64, from += 64) {
    std::memcpy(to, from, 64);
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }
}

inline void copy_to_shared(std::uint8_t* shared, std::span<const std::uint8_t> bytes) {
  copy_in_order(shared, bytes.data(), bytes.size());
}
inline void copy_from_shared(std::span<std::uint8_t> bytes, const std::uint8_t* shared) {
  copy_in_order(bytes.data(), shared, bytes.size());
}
#endif

}  // namespace skerry::board
