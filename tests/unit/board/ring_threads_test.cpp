// A ring between threads that run at once: under the thread sanitizer, too.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "protocol/board/ring_memory.hpp"
#include "protocol/board/sweep_ring.hpp"
#include "tests/unit/board/ring_records.hpp"
#include "tests/unit/board/shared_pages.hpp"

namespace skerry::board {
namespace {

constexpr std::uint64_t kRecords = 4000;
constexpr std::size_t kSizes = 64;

std::size_t size_of(std::uint64_t sequence) {
  return ring_record_size(sequence % kSizes) / 4 / 64 * 64 + 64;
}

struct Tally {
  std::uint64_t taken = 0, lost = 0, wrong = 0;
  bool closed = false;
};

// Takes what it gets until the ring is closed.  The memory is the very one that is written, so that
// a race would be seen as one.
Tally read_all(SweepRingReader& reader) {
  Tally tally;
  Bytes record;
  while (!tally.closed) {
    switch (reader.take(record)) {
      case RingState::record: {
        const std::uint64_t sequence = record_prefix(record)->sequence;
        tally.wrong += !is_ring_record(record, size_of(sequence));
        ++tally.taken;
        break;
      }
      case RingState::empty:
        (void)reader.wait(std::chrono::seconds(10));
        break;
      case RingState::closed:
        tally.closed = true;
        break;
    }
  }
  tally.lost = reader.records_lost();
  return tally;
}

TEST(RingThreads, EveryRecordIsTakenWholeOrCountedAsLost) {
  SharedPages pages(kRingHeader + kLeastRingCapacity);
  SweepRingWriter writer(pages.writable());
  std::vector<Tally> tallies(3);
  std::vector<std::thread> readers;
  for (Tally& tally : tallies) {
    auto reader = SweepRingReader::open(pages.writable());
    ASSERT_TRUE(reader.has_value());
    readers.emplace_back([&tally, mine = *reader]() mutable { tally = read_all(mine); });
  }
  for (std::uint64_t sequence = 0; sequence < kRecords; ++sequence) {
    writer.write(ring_record(sequence, size_of(sequence)), sequence, 1);
  }
  writer.close();
  for (std::thread& reader : readers) reader.join();
  for (const Tally& tally : tallies) {
    EXPECT_TRUE(tally.closed);
    EXPECT_EQ(tally.wrong, 0u);
    EXPECT_EQ(tally.taken + tally.lost, kRecords);
    EXPECT_GT(tally.taken, 0u);
  }
}

// Records are made first and written flat out, so that readers are overtaken while they copy.
TEST(RingThreads, AReaderThatIsOvertakenWhileItCopiesNeverSeesIt) {
  SharedPages pages(kRingHeader + kLeastRingCapacity);
  SweepRingWriter writer(pages.writable());
  std::vector<Bytes> blocks;
  for (std::uint64_t first = 0; first < 64; first += 16) {
    Bytes block;
    for (std::uint64_t sequence = first; sequence < first + 16; ++sequence) {
      const Bytes one = ring_record(sequence, 4096);
      block.insert(block.end(), one.begin(), one.end());
    }
    blocks.push_back(std::move(block));
  }
  std::atomic<bool> begun = false;
  auto reader = SweepRingReader::open(pages.writable());
  ASSERT_TRUE(reader.has_value());
  std::uint64_t taken = 0, wrong = 0;
  std::thread thread([&] {
    Bytes record;
    for (;;) {
      const RingState state = reader->take(record);
      if (state == RingState::closed) break;
      if (state == RingState::empty) continue;
      begun = true;
      ++taken;
      wrong += !is_ring_record(record, 4096);
    }
  });
  for (std::uint64_t n = 0; n < 1000 || !begun; ++n) {
    writer.write(blocks[n % blocks.size()], 16 * (n % blocks.size()), 16);
  }
  writer.close();
  thread.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(taken, 0u);
}

TEST(RingThreads, ASleeperIsWokenByEveryWriteAndByTheEnd) {
  SharedPages pages(kRingHeader + kLeastRingCapacity);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(reader.has_value());
  std::atomic<std::uint64_t> taken = 0;
  std::thread thread([&] {
    Bytes record;
    for (;;) {
      reader->wait(std::chrono::hours(1));  // only a wake ends it: without one, this test hangs
      const RingState state = reader->take(record);
      if (state == RingState::closed) return;
      if (state == RingState::record) ++taken;
    }
  });
  for (std::uint64_t sequence = 0; sequence < 300; ++sequence) {
    writer.write(ring_record(sequence, 64), sequence, 1);
    while (taken <= sequence) std::this_thread::yield();
  }
  writer.close();
  thread.join();
  EXPECT_EQ(taken, 300u);
}

}  // namespace
}  // namespace skerry::board
