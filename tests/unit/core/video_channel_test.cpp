#include "server/core/video_channel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <thread>

namespace skerry::server {
namespace {

// Publishes sectors of spokes numbered from 0; the "format" is one byte per spoke.
class Publisher {
 public:
  explicit Publisher(std::size_t ring_sectors) : channel(ring_sectors) {
    ring = &channel.add_format("test", [this](const Sector& sector) {
      ++encodes;
      auto encoded = std::make_shared<EncodedSector>();
      encoded->first_sequence = sector.spokes.front()->header.sequence;
      for (const SpokePtr& spoke : sector.spokes) {
        encoded->bytes.push_back(static_cast<std::uint8_t>(spoke->header.sequence));
        encoded->spoke_ends.push_back(static_cast<std::uint32_t>(encoded->bytes.size()));
      }
      return encoded;
    });
  }

  void publish(std::size_t spokes) {
    Sector sector;
    for (std::size_t i = 0; i < spokes; ++i) {
      auto spoke = std::make_shared<Spoke>();
      spoke->header.sequence = published++;
      sector.spokes.push_back(std::move(spoke));
    }
    channel.publish(sector);
  }

  VideoChannel channel;
  FormatRing* ring = nullptr;
  std::uint64_t published = 0;
  int encodes = 0;
};

TEST(FormatRing, GivesEverySectorInOrderToAReaderThatKeepsUp) {
  Publisher publisher(4);
  const auto registration = publisher.ring->on_publish([] {});
  Cursor cursor = publisher.ring->cursor_at_end();
  EXPECT_EQ(publisher.ring->take(cursor), nullptr);
  for (std::uint64_t i = 0; i < 100; ++i) {
    publisher.publish(3);
    const auto sector = publisher.ring->take(cursor);
    ASSERT_NE(sector, nullptr);
    EXPECT_EQ(sector->first_sequence, 3 * i);
    EXPECT_EQ(publisher.ring->take(cursor), nullptr);
  }
  EXPECT_EQ(cursor.spokes_lost, 0u);
}

TEST(FormatRing, HoldsAsManySectorsAsItsCapacity) {
  Publisher publisher(4);
  const auto registration = publisher.ring->on_publish([] {});
  Cursor cursor = publisher.ring->cursor_at_end();
  for (int i = 0; i < 4; ++i) publisher.publish(2);
  for (std::uint64_t i = 0; i < 4; ++i) {
    EXPECT_EQ(publisher.ring->take(cursor)->first_sequence, 2 * i);
  }
  EXPECT_EQ(cursor.spokes_lost, 0u);
}

TEST(FormatRing, AnOvertakenReaderJumpsToTheNewestSector) {
  Publisher publisher(4);
  const auto registration = publisher.ring->on_publish([] {});
  Cursor cursor = publisher.ring->cursor_at_end();
  for (int i = 0; i < 5; ++i) publisher.publish(2);
  EXPECT_EQ(publisher.ring->take(cursor)->first_sequence, 8u);
  EXPECT_EQ(cursor.spokes_lost, 8u);
  EXPECT_EQ(publisher.ring->take(cursor), nullptr);
}

TEST(FormatRing, AnOvertakenRecorderJumpsToTheOldestSectorThatIsHeld) {
  Publisher publisher(4);
  Cursor cursor = publisher.ring->cursor_at_end();
  publisher.publish(2);  // before it registered: not encoded
  const auto registration = publisher.ring->on_publish([] {});
  for (int i = 0; i < 3; ++i) publisher.publish(2);
  const auto take = [&] { return publisher.ring->take(cursor, FormatRing::Overtaken::to_oldest); };
  EXPECT_EQ(take()->first_sequence, 2u);
  EXPECT_EQ(cursor.spokes_lost, 2u);
  for (int i = 0; i < 10; ++i) publisher.publish(2);
  EXPECT_EQ(take()->first_sequence, 20u);
  EXPECT_EQ(cursor.spokes_lost, 2u + 16u);
  for (std::uint64_t next : {22u, 24u, 26u}) EXPECT_EQ(take()->first_sequence, next);
  EXPECT_EQ(take(), nullptr);
  EXPECT_EQ(cursor.spokes_lost, 18u);
}

// Sectors of any size, a reader of any rhythm: after it has caught up, what it received and what it
// was told it lost add up to what was published.
// While a recorder reads, a display is overtaken as ever.
TEST(FormatRing, HoldsForARecorderWhatItHoldsForDisplaysAndMore) {
  constexpr std::size_t kCapacity = 4, kHeld = kCapacity * FormatRing::kRecorderHolds;
  Publisher publisher(kCapacity);
  const auto looks = publisher.ring->on_publish([] {});
  auto records = publisher.ring->on_publish([] {}, FormatRing::Reader::recorder);
  Cursor recorder = publisher.ring->cursor_at_end();
  Cursor display = recorder;
  for (std::size_t i = 0; i < kHeld; ++i) publisher.publish(3);
  EXPECT_EQ(publisher.ring->take(display)->first_sequence, 3 * (kHeld - 1));
  EXPECT_EQ(display.spokes_lost, 3 * (kHeld - 1));
  for (std::size_t i = 0; i < kHeld; ++i) {
    const auto sector = publisher.ring->take(recorder, FormatRing::Overtaken::to_oldest);
    ASSERT_NE(sector, nullptr);
    EXPECT_EQ(sector->first_sequence, 3 * i);
  }
  EXPECT_EQ(recorder.spokes_lost, 0u);
  // One that comes when the last recorder has gone finds what displays need.
  for (std::size_t i = 0; i < kHeld; ++i) publisher.publish(3);
  records.reset();
  publisher.publish(3);
  const auto oldest = publisher.ring->take(recorder, FormatRing::Overtaken::to_oldest);
  ASSERT_NE(oldest, nullptr);
  EXPECT_EQ(oldest->first_sequence, 3 * (2 * kHeld + 1 - kCapacity));
  EXPECT_EQ(recorder.spokes_lost, 3 * (kHeld + 1 - kCapacity));
}

TEST(FormatRing, CountsExactlyWhatASlowReaderLost) {
  std::mt19937 random(20261121);
  for (std::size_t capacity : {1u, 2u, 3u, 7u, 64u}) {
    Publisher publisher(capacity);
    const auto registration = publisher.ring->on_publish([] {});
    for (int i = 0; i < 10; ++i) publisher.publish(1 + random() % 64);
    const std::uint64_t before = publisher.published;
    Cursor cursor = publisher.ring->cursor_at_end();
    std::uint64_t received = 0;
    std::uint64_t expected_next = before;
    std::uint64_t lost_by_gaps = 0;
    const auto take_one = [&] {
      const auto sector = publisher.ring->take(cursor);
      if (sector == nullptr) return false;
      lost_by_gaps += sector->first_sequence - expected_next;
      expected_next = sector->first_sequence + sector->spoke_count();
      received += sector->spoke_count();
      EXPECT_EQ(cursor.spokes_lost, lost_by_gaps);
      return true;
    };
    for (int step = 0; step < 2000; ++step) {
      publisher.publish(1 + random() % 64);
      for (auto takes = random() % 3; takes > 0; --takes) take_one();
    }
    while (take_one()) continue;
    EXPECT_EQ(received + cursor.spokes_lost, publisher.published - before);
    if (capacity < 64) {
      EXPECT_GT(cursor.spokes_lost, 0u);
    }
  }
}

TEST(FormatRing, EncodesOnceWhateverTheNumberOfReaders) {
  Publisher publisher(8);
  std::vector<FormatRing::Registration> registrations;
  std::vector<Cursor> cursors;
  for (int i = 0; i < 16; ++i) {
    registrations.push_back(publisher.ring->on_publish([] {}));
    cursors.push_back(publisher.ring->cursor_at_end());
  }
  publisher.publish(16);
  const EncodedSector* only = nullptr;
  for (Cursor& cursor : cursors) {
    const auto sector = publisher.ring->take(cursor);
    if (only == nullptr) only = sector.get();
    EXPECT_EQ(sector.get(), only);
  }
  EXPECT_EQ(publisher.encodes, 1);
  EXPECT_EQ(publisher.channel.spokes_encoded().at("test"), 16u);
}

TEST(FormatRing, HoldsNoMoreBytesThanItMayButAlwaysTheNewestSector) {
  FormatRing ring(100, 1000);
  EXPECT_FALSE(ring.has_readers());
  const auto registration = ring.on_publish([] {});
  EXPECT_TRUE(ring.has_readers());
  Cursor cursor = ring.cursor_at_end();
  std::vector<std::weak_ptr<const EncodedSector>> made;
  const auto publish = [&](std::size_t bytes) {
    ring.publish(2, [&] {
      auto sector = std::make_shared<EncodedSector>();
      sector->first_sequence = 2 * made.size();
      sector->bytes.resize(bytes);
      made.push_back(sector);
      return sector;
    });
  };
  for (int i = 0; i < 250; ++i) publish(300);
  std::size_t held = 0;
  for (const auto& sector : made) held += sector.expired() ? 0 : 1;
  EXPECT_EQ(held, 3u);
  EXPECT_EQ(ring.take(cursor)->first_sequence, 498u) << "overtaken: the newest";
  EXPECT_EQ(cursor.spokes_lost, 498u);
  publish(5000);
  EXPECT_EQ(ring.take(cursor)->bytes.size(), 5000u);
  publish(300);
  publish(300);
  EXPECT_EQ(ring.take(cursor)->first_sequence, 502u);
  EXPECT_EQ(ring.take(cursor)->first_sequence, 504u);
  EXPECT_EQ(cursor.spokes_lost, 498u);
}

TEST(FormatRing, IsNotEncodedWhileNobodyReads) {
  Publisher publisher(8);
  publisher.publish(16);
  EXPECT_EQ(publisher.encodes, 0);
  Cursor early = publisher.ring->cursor_at_end();
  publisher.publish(16);
  {
    const auto registration = publisher.ring->on_publish([] {});
    publisher.publish(16);
    EXPECT_EQ(publisher.encodes, 1);
    EXPECT_EQ(publisher.ring->take(early)->first_sequence, 32u);
    EXPECT_EQ(early.spokes_lost, 16u) << "published before anybody was registered";
  }
  publisher.publish(16);
  EXPECT_EQ(publisher.encodes, 1);
  EXPECT_EQ(publisher.ring->take(early), nullptr);
  EXPECT_EQ(early.spokes_lost, 32u);
}

TEST(FormatRing, WakesOnlyWhileRegistered) {
  Publisher publisher(8);
  int wakes = 0;
  auto registration = publisher.ring->on_publish([&wakes] { ++wakes; });
  publisher.publish(1);
  publisher.publish(1);
  EXPECT_EQ(wakes, 2);
  registration.reset();
  publisher.publish(1);
  EXPECT_EQ(wakes, 2);
}

TEST(FormatRing, AReleasedRegistrationIsNotCalledAgain) {
  Publisher publisher(8);
  std::atomic<bool> stop{false};
  std::atomic<int> published{0};
  std::thread radar([&] {
    while (!stop) {
      publisher.publish(1);
      ++published;
    }
  });
  int late_calls = 0;
  for (int i = 0; i < 200; ++i) {
    std::atomic<int> calls{0};
    auto registration = publisher.ring->on_publish([&calls] { ++calls; });
    registration.reset();
    const int calls_at_release = calls;
    for (const int seen = published; published < seen + 2;) std::this_thread::yield();
    late_calls += calls - calls_at_release;
  }
  stop = true;
  radar.join();
  EXPECT_EQ(late_calls, 0);
}

TEST(FormatRing, ConcurrentReadersAccountForEverySpoke) {
  constexpr int kSectors = 5000;
  Publisher publisher(4);
  struct Reader {
    FormatRing::Registration registration;
    Cursor cursor;
    std::uint64_t received = 0;
  };
  std::vector<Reader> readers(3);
  for (Reader& reader : readers) {
    reader.registration = publisher.ring->on_publish([] {});
    reader.cursor = publisher.ring->cursor_at_end();
  }
  std::atomic<bool> done{false};
  const auto drain = [&](Reader& reader) {
    while (const auto sector = publisher.ring->take(reader.cursor)) {
      reader.received += sector->spoke_count();
    }
  };
  std::vector<std::thread> threads;
  for (Reader& reader : readers) {
    threads.emplace_back([&] {
      while (!done) drain(reader);
      drain(reader);
    });
  }
  for (int i = 0; i < kSectors; ++i) publisher.publish(1 + static_cast<std::size_t>(i) % 5);
  done = true;
  for (std::thread& thread : threads) thread.join();
  for (const Reader& reader : readers) {
    EXPECT_EQ(reader.received + reader.cursor.spokes_lost, publisher.published);
  }
}

TEST(VideoChannel, FormatsOfOneNameAndUnknownFormatsAreErrors) {
  VideoChannel channel;
  channel.add_format("native", [](const Sector&) { return nullptr; });
  EXPECT_THROW(channel.add_format("native", [](const Sector&) { return nullptr; }),
               std::logic_error);
  EXPECT_THROW(channel.format("other"), std::out_of_range);
}

TEST(VideoChannel, ASectorWithoutSpokesIsIgnored) {
  Publisher publisher(4);
  const auto registration = publisher.ring->on_publish([] {});
  publisher.publish(0);
  EXPECT_EQ(publisher.encodes, 0);
}

TEST(VideoChannel, HoldsNoMoreOfAFormatThatIsAddedLater) {
  constexpr std::size_t kSectors = 1000;
  Publisher publisher(kSectors);
  publisher.channel.hold(64);
  FormatRing& later = publisher.channel.add_format("later", [](const Sector& sector) {
    auto encoded = std::make_shared<EncodedSector>();
    encoded->bytes.resize(16);
    encoded->spoke_ends.assign(sector.spokes.size(), 16);
    return encoded;
  });
  const auto reader = later.on_publish([] {}, FormatRing::Reader::recorder);
  Cursor cursor = later.cursor_at_end();
  for (int i = 0; i < 100; ++i) publisher.publish(1);
  ASSERT_NE(later.take(cursor, FormatRing::Overtaken::to_oldest), nullptr);
  EXPECT_EQ(cursor.spokes_lost, 96u);  // four sectors are 64 bytes
}

}  // namespace
}  // namespace skerry::server
