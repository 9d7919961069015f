#include "protocol/board/sweep_ring.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "protocol/board/ring_memory.hpp"
#include "tests/unit/board/ring_records.hpp"
#include "tests/unit/board/shared_pages.hpp"

namespace skerry::board {
namespace {

using std::chrono::milliseconds;

void write_one(SweepRingWriter& writer, std::uint64_t sequence, std::size_t size) {
  writer.write(ring_record(sequence, size), sequence, 1);
}

TEST(SweepRing, IsOfAtLeastTheCapacityAskedForInSteps) {
  EXPECT_EQ(ring_bytes(0), 4096u + 524'288);
  EXPECT_EQ(ring_bytes(524'288), 4096u + 524'288);
  EXPECT_EQ(ring_bytes(524'289), 4096u + 589'824);
  EXPECT_EQ(ring_bytes(64u << 20), 4096u + (64u << 20));
}

TEST(SweepRing, GivesEveryRecordInOrderToAReaderThatKeepsUp) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(reader.has_value());
  Bytes record;
  EXPECT_EQ(reader->take(record), RingState::empty);
  EXPECT_TRUE(record.empty());
  // Several times round, so that fillers of many sizes come.
  for (std::uint64_t sequence = 100; sequence < 1100; ++sequence) {
    const std::size_t size = ring_record_size(sequence);
    write_one(writer, sequence, size);
    ASSERT_EQ(reader->take(record), RingState::record) << sequence;
    ASSERT_TRUE(is_ring_record(record, size)) << sequence;
    ASSERT_EQ(record_prefix(record)->sequence, sequence);
    ASSERT_EQ(reader->take(record), RingState::empty);
  }
  EXPECT_EQ(reader->records_lost(), 0u);
  writer.close();
  EXPECT_EQ(reader->take(record), RingState::closed);
}

TEST(SweepRing, TakesManyRecordsInOneWriteHoweverManyTheyAre) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(reader.has_value());
  std::uint64_t sequence = 0, taken = 0;
  Bytes record;
  // Up to the whole ring in one call, less the filler that may come with it.
  for (const std::size_t most : {1000u, 100'000u, 300'000u, 131'072u, 420'000u, 64u}) {
    Bytes batch;
    const std::uint64_t first = sequence;
    while (batch.size() < most) {
      const Bytes one = ring_record(sequence, ring_record_size(sequence) % 8192 + 64);
      batch.insert(batch.end(), one.begin(), one.end());
      ++sequence;
    }
    writer.write(batch, first, static_cast<std::uint32_t>(sequence - first));
    while (reader->take(record) == RingState::record) {
      ASSERT_TRUE(is_ring_record(record, ring_record_size(taken) % 8192 + 64)) << taken;
      ++taken;
    }
  }
  EXPECT_EQ(taken, sequence);
  EXPECT_EQ(reader->records_lost(), 0u);
}

TEST(SweepRing, BeginsBehindTheNewestRecordForWhoOpensItLater) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  for (std::uint64_t sequence = 0; sequence < 77; ++sequence) {
    write_one(writer, sequence, ring_record_size(sequence));
  }
  auto reader = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(reader.has_value());
  Bytes record;
  EXPECT_EQ(reader->take(record), RingState::empty);
  write_one(writer, 77, 128);
  ASSERT_EQ(reader->take(record), RingState::record);
  EXPECT_EQ(record_prefix(record)->sequence, 77u);
  EXPECT_EQ(reader->records_lost(), 0u);
}

TEST(SweepRing, CountsExactlyWhatAReaderMissedAndGoesOnWithTheNewest) {
  std::mt19937 random(3);
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(reader.has_value());
  std::uint64_t sequence = 5, taken = 0;
  Bytes record;
  std::size_t overtaken = 0;
  for (int round = 0; round < 400; ++round) {
    for (std::uint64_t n = random() % 40; n > 0; --n, ++sequence) {
      write_one(writer, sequence, ring_record_size(sequence));
    }
    const std::uint64_t lost = reader->records_lost();
    for (std::uint64_t n = random() % 40; n > 0 && reader->take(record) == RingState::record; --n) {
      const std::uint64_t here = record_prefix(record)->sequence;
      ASSERT_TRUE(is_ring_record(record, ring_record_size(here)));
      ++taken;
      ASSERT_EQ(5 + taken + reader->records_lost(), here + 1);
    }
    overtaken += reader->records_lost() != lost;
  }
  while (reader->take(record) == RingState::record) ++taken;
  EXPECT_EQ(taken + reader->records_lost(), sequence - 5);
  EXPECT_GT(overtaken, 20u);
  EXPECT_GT(taken, 1000u);
}

TEST(SweepRing, JumpsToTheNewestRecordNotBeyondIt) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  for (std::uint64_t sequence = 0; sequence < 100; ++sequence) write_one(writer, sequence, 65'536);
  Bytes record;
  ASSERT_EQ(reader->take(record), RingState::record);
  EXPECT_EQ(record_prefix(record)->sequence, 99u);
  EXPECT_EQ(reader->records_lost(), 99u);
  EXPECT_EQ(reader->take(record), RingState::empty);
}

TEST(SweepRing, CountsGapsThatTheWriterHasAndNoneWhereTheBoardBeganAnew) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  Bytes record;
  for (const std::uint64_t sequence : {10u, 11u, 15u, 16u, 0u, 1u}) {
    write_one(writer, sequence, 64);
    ASSERT_EQ(reader->take(record), RingState::record);
  }
  EXPECT_EQ(reader->records_lost(), 3u);
}

TEST(SweepRing, RefusesWhatAreNoWholeRecordsAndStaysAsItWas) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  Bytes two = ring_record(0, 128);
  const Bytes other = ring_record(1, 256);
  two.insert(two.end(), other.begin(), other.end());
  EXPECT_THROW(writer.write(std::span(two).first(383), 0, 2), std::invalid_argument);
  EXPECT_THROW(writer.write(std::span(two).first(320), 0, 2), std::invalid_argument);
  EXPECT_THROW(writer.write(two, 0, 1), std::invalid_argument);
  EXPECT_THROW(writer.write(Bytes(64, 0), 0, 1), std::invalid_argument);
  EXPECT_THROW(writer.write(Bytes(64, 0xFF), 0, 1), std::invalid_argument);
  Bytes record;
  EXPECT_EQ(reader->take(record), RingState::empty);
  writer.write({}, 0, 0);
  EXPECT_EQ(reader->take(record), RingState::empty);
  writer.write(two, 0, 2);
  EXPECT_EQ(reader->take(record), RingState::record);
}

TEST(SweepRing, IsNotMadeInMemoryThatDoesNotFit) {
  SharedPages pages(kRingBytes + 4096);
  EXPECT_THROW(SweepRingWriter(pages.writable()), std::invalid_argument);
  EXPECT_THROW(SweepRingWriter(pages.writable().first(4096)), std::invalid_argument);
  EXPECT_THROW(SweepRingWriter(pages.writable().first(0)), std::invalid_argument);
  EXPECT_THROW(SweepRingWriter(pages.writable().subspan(64, kRingBytes)), std::invalid_argument);
  EXPECT_NO_THROW(SweepRingWriter(pages.writable().first(kRingBytes)));
}

TEST(SweepRing, WaitEndsWhenTheTimeIsUpAndAtOnceWhereThereIsSomething) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  EXPECT_FALSE(reader->wait(milliseconds(-5)));
  EXPECT_FALSE(reader->wait(milliseconds(0)));
  EXPECT_FALSE(reader->wait(milliseconds(1)));
  write_one(writer, 0, 64);
  EXPECT_TRUE(reader->wait(std::chrono::hours(1)));
  Bytes record;
  reader->take(record);
  EXPECT_FALSE(reader->wait(milliseconds(1)));
  writer.close();
  EXPECT_TRUE(reader->wait(std::chrono::hours(1)));
  EXPECT_EQ(reader->take(record), RingState::closed);
}

TEST(SweepRing, MadeAnewInTheSameMemoryIsReadOnWithoutAnOldByte) {
  SharedPages pages(kRingBytes);
  std::optional<SweepRingWriter> writer(pages.writable());
  auto reader = SweepRingReader::open(pages.readable());
  for (std::uint64_t sequence = 0; sequence < 30; ++sequence) write_one(*writer, sequence, 4096);
  Bytes record;
  ASSERT_EQ(reader->take(record), RingState::record);
  writer.emplace(pages.writable());
  EXPECT_EQ(reader->take(record), RingState::empty);
  auto later = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(later.has_value());
  for (std::uint64_t sequence = 500; sequence < 503; ++sequence) {
    write_one(*writer, sequence, ring_record_size(sequence));
  }
  for (auto* each : {&reader, &later}) {
    for (std::uint64_t sequence = 500; sequence < 503; ++sequence) {
      ASSERT_EQ((*each)->take(record), RingState::record);
      EXPECT_TRUE(is_ring_record(record, ring_record_size(sequence)));
      EXPECT_EQ(record_prefix(record)->sequence, sequence);
    }
    EXPECT_EQ((*each)->take(record), RingState::empty);
  }
  EXPECT_EQ(reader->records_lost(), 499u);  // 1 .. 499 by their sequence
  EXPECT_EQ(later->records_lost(), 0u);
}

TEST(SweepRing, IsNotOpenedInMemoryThatIsNone) {
  SharedPages pages(kRingBytes);
  EXPECT_FALSE(SweepRingReader::open({}).has_value());
  EXPECT_FALSE(SweepRingReader::open(pages.readable()).has_value());
  SweepRingWriter writer(pages.writable());
  ASSERT_TRUE(SweepRingReader::open(pages.readable()).has_value());
  EXPECT_FALSE(SweepRingReader::open(pages.readable().first(kRingBytes - 1)).has_value());
  EXPECT_FALSE(SweepRingReader::open(pages.readable().first(4096)).has_value());
  EXPECT_FALSE(SweepRingReader::open(pages.readable().subspan(8)).has_value());
  // Magic, version, bytes of the header, and capacity: none at all, odd, and far too much.
  const auto with = [&](std::size_t offset, std::initializer_list<int> bytes) {
    SharedPages other(kRingBytes);
    SweepRingWriter made(other.writable());
    std::size_t at = offset;
    for (const int byte : bytes) other.writable()[at++] = static_cast<std::uint8_t>(byte);
    return SweepRingReader::open(other.readable()).has_value();
  };
  EXPECT_TRUE(with(0, {'S', 'K', 'R', 'Y', 'R', 'I', 'N', 'G', 1, 0, 0, 0, 0, 16}));
  EXPECT_FALSE(with(0, {'s'}));
  EXPECT_FALSE(with(8, {2}));
  EXPECT_FALSE(with(12, {0, 0, 1}));
  EXPECT_FALSE(with(16, {0, 0, 0, 0}));
  EXPECT_FALSE(with(16, {0, 0, 1, 0}));
  EXPECT_FALSE(with(16, {1, 0, 8, 0}));
  EXPECT_FALSE(with(16, {0, 0, 9, 0}));
  EXPECT_FALSE(with(16, {0, 0, 0, 0, 0, 0, 0, 0x80}));
}

// Whatever stands in the memory, a reader ends, stays inside it, and gives nothing but records.
TEST(SweepRing, OfGarbageHarmsNoReader) {
  std::mt19937 random(1);
  Bytes record;
  std::size_t records = 0;
  for (int round = 0; round < 200; ++round) {
    SharedPages pages(kRingBytes);
    SweepRingWriter writer(pages.writable());
    for (std::uint64_t sequence = 0; sequence < 20; ++sequence) {
      write_one(writer, sequence, ring_record_size(sequence) % 4096 + 64);
    }
    auto reader = SweepRingReader::open(pages.readable());
    ASSERT_TRUE(reader.has_value());
    write_one(writer, 20, 256);
    for (int step = 0; step < 60; ++step) {
      // A counter, or something in the records, or the sizes that stand there.
      const std::size_t choice = random() % 4;
      const std::size_t at =
          choice < 2 ? 64 + random() % 72 : kRingHeader + 64 * (random() % 1200) + random() % 16;
      for (std::size_t i = 0; i < 1 + random() % 8; ++i) {
        pages.writable()[at + i] = static_cast<std::uint8_t>(random() % 3 == 0 ? 0xFF : random());
      }
      if (choice == 3) write_one(writer, random(), ring_record_size(random()));
      const RingState state = reader->take(record);
      ASSERT_EQ(state == RingState::record, !record.empty());
      if (state == RingState::record) {
        ++records;
        ASSERT_EQ(record_prefix(record)->size, record.size());
      }
      (void)reader->wait(std::chrono::nanoseconds(1));
      if (auto late = SweepRingReader::open(pages.readable())) (void)late->take(record);
    }
  }
  EXPECT_GT(records, 100u);
}

}  // namespace
}  // namespace skerry::board
