// Files made to do harm, and files of others: clear errors, bounded memory and time.
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <zstd.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <optional>

#include "protocol/recording/checksum.hpp"
#include "protocol/recording/compression.hpp"
#include "protocol/recording/file_builder.hpp"
#include "protocol/recording/mcap_records.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/recording/summary_builder.hpp"
#include "protocol/recording/topics.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/unit/recording/recording_kit.hpp"

namespace skerry::recording {
namespace {

constexpr ChannelKind kSpokes{{Kind::spoke, 0, 0}};

// Writes files of MCAP by hand, right or wrong.
class Forger {
 public:
  explicit Forger(const std::string& profile = "skerry") {
    for (const std::uint8_t octet : mcap::kMagic) file.push_back(octet);
    mcap::append(file, mcap::Header{profile, "forger"});
  }
  static Bytes channel(std::uint16_t id, const std::string& topic, std::uint16_t schema = 0,
                       const std::string& encoding = "protobuf") {
    Bytes out;
    mcap::append(out, mcap::Channel{id, schema, topic, encoding});
    return out;
  }
  static void add_message(Bytes& records, std::uint16_t channel, std::uint64_t time,
                          const std::string& data) {
    mcap::append_message_head(records, {channel, 0, time, {}}, data.size());
    records.insert(records.end(), data.begin(), data.end());
  }
  // A chunk as it stands; what its head says can be changed before.
  void chunk(mcap::ChunkHead head, const Bytes& compressed) {
    const std::size_t begin = file.size();
    head.compressed = compressed.size();
    mcap::append(file, head);
    file.insert(file.end(), compressed.begin(), compressed.end());
    summary.add_chunk({head.start,
                       head.end,
                       begin,
                       file.size() - begin,
                       {{1, 0}},
                       0,
                       head.compression,
                       head.compressed,
                       head.uncompressed},
                      {{1, 1}});
  }
  void plain_chunk(const Bytes& records, std::uint64_t start, std::uint64_t end) {
    chunk({start, end, records.size(), crc32(records), "", 0}, records);
  }
  Bytes finished() {
    summary.add_channel(1, channel(1, name_of(kSpokes)));
    Bytes out = file;
    const Bytes end = summary.end(file.size(), 0);
    out.insert(out.end(), end.begin(), end.end());
    return out;
  }

  Bytes file;
  SummaryBuilder summary;
};

Bytes one_spoke(std::uint64_t time) {
  Bytes records = Forger::channel(1, name_of(kSpokes));
  Forger::add_message(records, 1, time, "spoke");
  return records;
}

// The most memory that the process has held.  Under a sanitizer it means little: 0.
// The address sanitizer keeps freed memory for a while.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kPeakIsOurs = false;
#elif defined(__has_feature)
constexpr bool kPeakIsOurs = !__has_feature(address_sanitizer);
#else
constexpr bool kPeakIsOurs = true;
#endif

long peak_kib() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0;
#endif
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// The items read of it; a damaged chunk must be reported.
std::vector<kit::Kept> read(const kit::Folder& folder, const Bytes& file, std::uint64_t damaged) {
  const auto reader = RecordingReader::open(folder.put("a.mcap", file));
  EXPECT_TRUE(reader.ok()) << reader.error().to_string();
  auto cursor = reader->items();
  std::vector<kit::Kept> items;
  while (const auto item = cursor.next()) {
    items.push_back({item->topic, item->time, {item->bytes.begin(), item->bytes.end()}});
  }
  EXPECT_EQ(cursor.chunks_damaged(), damaged);
  EXPECT_EQ(cursor.damage().has_value(), damaged > 0);
  return items;
}

TEST(HostileFile, OfNoRecordingIsRefusedWithPlaceAndReason) {
  const kit::Folder folder;
  const auto error = [&](const Bytes& bytes) {
    const auto reader = RecordingReader::open(folder.put("a.mcap", bytes));
    return reader.ok() ? std::string() : reader.error().to_string();
  };
  EXPECT_NE(error({}).find("a.mcap: byte 0: is empty"), std::string::npos) << error({});
  EXPECT_NE(error(Bytes(5000, 6)).find("byte 0: does not begin as"), std::string::npos);
  EXPECT_NE(RecordingReader::open(folder.path("none")).error().text.find("No such file"),
            std::string::npos);
  EXPECT_NE(RecordingReader::open(folder.path("")).error().text.find("no regular file"),
            std::string::npos);
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(RecordingReader::open(folder.path("pipe")).ok());
}

TEST(HostileFile, ThatSaysItsChunksAreHugeTakesNoMemory) {
  const kit::Folder folder;
  const long before = peak_kib();
  for (const std::string compression : {"", "lz4", "zstd"}) {
    for (const std::uint64_t size :
         {std::uint64_t{65} << 20, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
      Forger forger;
      forger.chunk({1, 2, size, 1, compression, 0}, Bytes(1000, 7));
      forger.plain_chunk(one_spoke(5), 5, 5);
      EXPECT_EQ(read(folder, forger.finished(), 1).size(), 1U);
      EXPECT_EQ(read(folder, forger.file, 0).size(), 1U);
    }
  }
  if (kPeakIsOurs) {
    EXPECT_LT(peak_kib() - before, 64 << 10);
  }
}

// 64 MiB of nothing in a few kB: taken for what it is; more than it says is not unpacked.
TEST(HostileFile, ThatIsABombGoesOffNowhere) {
  const kit::Folder folder;
  const Bytes nothing(64 << 20, 0);
  Bytes bomb(ZSTD_compressBound(nothing.size()));
  bomb.resize(ZSTD_compress(bomb.data(), bomb.size(), nothing.data(), nothing.size(), 1));
  ASSERT_LT(bomb.size(), 20'000U);
  const long before = peak_kib();
  Forger forger;
  for (std::uint64_t i = 0; i < 50; ++i) {
    forger.chunk({1, 2, i % 2 == 0 ? nothing.size() : 1000, 1, "zstd", 0}, bomb);
  }
  forger.plain_chunk(one_spoke(5), 5, 5);
  EXPECT_EQ(read(folder, forger.finished(), 50).size(), 1U);
  if (kPeakIsOurs) {
    EXPECT_LT(peak_kib() - before, 200 << 10);
  }
}

// Chunks that all lie over each other: no more are open than kMaxOpenBytes.
TEST(HostileFile, OfChunksOfOneTimeStaysWithinItsMemory) {
  const kit::Folder folder;
  const std::size_t size = 16 << 20;
  Bytes records = Forger::channel(1, name_of(kSpokes));
  Forger::add_message(records, 1, 1, "first");
  Forger::add_message(records, 1, 1000, std::string(size, 'x'));
  Bytes small(ZSTD_compressBound(records.size()));
  small.resize(ZSTD_compress(small.data(), small.size(), records.data(), records.size(), 1));
  Forger forger;
  for (int i = 0; i < 40; ++i) {
    forger.chunk({1, 1000, records.size(), crc32(records), "zstd", 0}, small);
  }
  const std::string path = folder.put("a.mcap", forger.finished());
  const long before = peak_kib();
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.ok());
  auto cursor = reader->items();
  int items = 0;
  while (cursor.next()) ++items;
  EXPECT_EQ(items, 80);
  EXPECT_EQ(cursor.chunks_damaged(), 0U);
  if (kPeakIsOurs) {
    EXPECT_LT(peak_kib() - before, static_cast<long>(2 * ItemCursor::kMaxOpenBytes >> 10));
  }
}

// An index that names one chunk again and again, or chunks out of order, is no index.
TEST(HostileFile, WhoseIndexGoesInCirclesIsSearched) {
  const kit::Folder folder;
  Forger forger;
  forger.plain_chunk(one_spoke(5), 5, 5);
  const std::size_t begin = forger.file.size();
  forger.plain_chunk(one_spoke(6), 6, 6);
  for (int i = 0; i < 1000; ++i) {
    forger.summary.add_chunk({6, 6, begin, forger.file.size() - begin, {{1, 0}}, 0, "", 0, 0},
                             {{1, 1}});
  }
  const auto reader = RecordingReader::open(folder.put("a.mcap", forger.finished()));
  ASSERT_TRUE(reader.ok());
  EXPECT_TRUE(reader->summary().damage);
  EXPECT_EQ(reader->summary().chunks, 2U);
  EXPECT_EQ(kit::read_all(reader->items()).size(), 2U);
}

// Bytes that this process has read until now; empty where the system does not tell.
std::optional<std::uint64_t> bytes_read() {
  std::ifstream io("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  if (io >> name >> bytes && name == "rchar:") return bytes;
  return std::nullopt;
}

// Every octet of it may begin a chunk and none does.
TEST(HostileFile, OfNothingButChunkHeadsIsReadOnce) {
  const kit::Folder folder;
  constexpr std::size_t kSize = 16 << 20;
  Forger forger;
  forger.file.resize(forger.file.size() + kSize, static_cast<std::uint8_t>(mcap::Op::chunk));
  forger.plain_chunk(one_spoke(5), 5, 5);
  const std::string path = folder.put("a.mcap", forger.file);
  const auto before = bytes_read();
  int asked = 0;
  const auto reader = RecordingReader::open(path, [&](double) { return ++asked > 0; });
  const auto after = bytes_read();
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  EXPECT_EQ(reader->summary().chunks, 1U);
  EXPECT_GE(asked, 4);
  if (before && after) {
    EXPECT_LT(*after - *before, 2 * kSize);
  }
  EXPECT_FALSE(RecordingReader::open(path, [](double) { return false; }).ok());
}

// Records of 1 MiB that are none, over each other: what is read asks too, not only how far it is.
TEST(HostileFile, ThatHasOnePlaceReadManyTimesCanBeGivenUp) {
  const kit::Folder folder;
  Forger forger;
  for (int i = 0; i < 200; ++i) {
    forger.plain_chunk(one_spoke(5), 5, 5);
    forger.file.push_back(static_cast<std::uint8_t>(mcap::Op::schema));
    append_little_endian(forger.file, 1 << 20, 8);
    forger.file.resize(forger.file.size() + 16, 0xFF);
  }
  forger.file.resize(forger.file.size() + (1 << 20));
  int asked = 0;
  const std::string path = folder.put("a.mcap", forger.file);
  const auto reader = RecordingReader::open(path, [&](double) { return ++asked > 0; });
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  EXPECT_EQ(reader->summary().chunks, 200U);
  EXPECT_GE(asked, 3);
}

// Packed messages by the thousand of few octets each, all of one time.
TEST(HostileFile, OfCrumbsOfPackedSpokesIsBounded) {
  const kit::Folder folder;
  const ChannelKind packed{{Kind::spoke, 0, 0}, true};
  Bytes records = Forger::channel(1, name_of(packed));
  for (int i = 0; i < 200'000; ++i) Forger::add_message(records, 1, 7, "\x08\x01\x12\x04\0\0\1\0");
  for (int i = 0; i < 1000; ++i) Forger::add_message(records, 1, 7, "nonsense");
  Forger forger;
  forger.plain_chunk(records, 7, 7);
  const auto reader = RecordingReader::open(folder.put("a.mcap", forger.finished()));
  ASSERT_TRUE(reader.ok());
  auto cursor = reader->items();
  int items = 0;
  while (cursor.next()) ++items;
  EXPECT_LE(items, 201'000);
}

TEST(HostileFile, OfTimesBeyondAllBoundsIsRead) {
  const kit::Folder folder;
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  Bytes records = one_spoke(kMost);
  Forger::add_message(records, 1, 0, "early");
  Forger forger;
  forger.plain_chunk(records, 0, kMost);
  const auto items = read(folder, forger.finished(), 0);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].bytes, "early");
  const auto reader = RecordingReader::open(folder.path("a.mcap"));
  auto cursor = reader->items();
  cursor.seek(UtcTime::max());
  EXPECT_TRUE(cursor.next());
  cursor.seek(UtcTime::min());
  EXPECT_EQ(cursor.next()->time, UtcTime());
  EXPECT_TRUE(reader->last_before(kSpokes.topic, UtcTime::max()));
  EXPECT_FALSE(reader->last_before(kSpokes.topic, UtcTime::min()));
}

// A recording of somebody else: other topics, other schemas of our names, other records.
TEST(ForeignFile, IsReadAndWhatIsNotOursLeftOut) {
  const kit::Folder folder;
  Forger forger("ros2");
  mcap::append(forger.file, mcap::Schema{1, "foxglove.Log", "protobuf", ""});
  mcap::append(forger.file, mcap::Schema{2, "skerry.recording.Log", "protobuf", ""});
  forger.file.push_back(0x0C);  // metadata
  append_little_endian(forger.file, 8, 8);
  forger.file.resize(forger.file.size() + 8);
  forger.file.push_back(0x99);  // private
  append_little_endian(forger.file, 3, 8);
  forger.file.resize(forger.file.size() + 3);
  Bytes records;
  const auto put = [&](const Bytes& more) {
    records.insert(records.end(), more.begin(), more.end());
  };
  put(Forger::channel(1, "/camera", 1));
  put(Forger::channel(2, "log", 1));
  put(Forger::channel(3, "log", 2));
  put(Forger::channel(4, "log", 2, "json"));
  for (std::uint16_t channel = 1; channel < 7; ++channel) {
    Forger::add_message(records, channel, channel, std::to_string(channel));
  }
  forger.chunk({1, 6, records.size(), 0, "", 0}, records);  // without a checksum
  forger.chunk({1, 6, records.size(), 0, "bz2", 0}, records);
  const auto reader = RecordingReader::open(folder.put("a.mcap", forger.file));
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  const auto items = kit::read_all(reader->items());
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(items[0].bytes, "3");
  EXPECT_EQ(items[0].topic.kind, Kind::log);
}

// A filter by topic reads only the chunks that have it.
TEST(Topic, WithoutAChunkCostsNone) {
  const kit::Folder folder;
  Forger forger;
  forger.chunk({1, 2, 100, 1, "", 0}, Bytes(100, 7));  // cannot be read: would be counted
  const auto reader = RecordingReader::open(folder.put("a.mcap", forger.finished()));
  ASSERT_TRUE(reader.ok());
  auto marks = reader->items({{Kind::event}});
  EXPECT_FALSE(marks.next());
  EXPECT_EQ(marks.chunks_damaged(), 0U);
  auto all = reader->items();
  EXPECT_FALSE(all.next());
  EXPECT_EQ(all.chunks_damaged(), 1U);
}

TEST(Attachment, OfHostileSizeIsLeftOut) {
  const kit::Folder folder;
  Forger forger;
  for (int i = 0; i < 3; ++i) {
    const std::size_t begin = forger.file.size();
    const Bytes data(kMaxAttachment / 2, static_cast<std::uint8_t>(i));
    mcap::append(forger.file, mcap::Attachment{1, std::to_string(i), "", data});
    forger.summary.add_attachment({begin, forger.file.size() - begin, 1, data.size(), "", ""});
  }
  forger.summary.add_attachment({40, 100, 1, 1, "no attachment", ""});
  const auto reader = RecordingReader::open(folder.put("a.mcap", forger.finished()));
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader->summary().attachments.size(), 2U);
  EXPECT_TRUE(reader->summary().damage);
}

// An index that names one attachment again and again is no index.
TEST(Attachment, ThatIsIndexedManyTimesIsReadOnce) {
  const kit::Folder folder;
  Forger forger;
  const std::size_t begin = forger.file.size();
  const Bytes data(1 << 20, 7);
  mcap::append(forger.file, mcap::Attachment{1, "notes", "text/plain", data});
  for (int i = 0; i < 10'000; ++i) {
    forger.summary.add_attachment({begin, forger.file.size() - begin, 1, data.size(), "", ""});
  }
  const std::string path = folder.put("a.mcap", forger.finished());
  const auto before = bytes_read();
  const auto reader = RecordingReader::open(path);
  const auto after = bytes_read();
  ASSERT_TRUE(reader.ok()) << reader.error().to_string();
  EXPECT_TRUE(reader->summary().damage);
  EXPECT_EQ(reader->summary().attachments.size(), 1U);
  if (before && after) {
    EXPECT_LT(*after - *before, 16 * data.size());
  }
}

// Contents of which only the first counts, and none of hostile size.
TEST(Attachment, OfContentsTheFirstCountsAndNoneTooLong) {
  const kit::Folder folder;
  const auto marks = [&](const std::vector<std::size_t>& names) {
    Forger forger;
    for (const std::size_t name : names) {
      Contents contents;
      contents.add_marks()->set_name(std::string(name, 'x'));
      const std::string text = contents.SerializeAsString();
      const std::size_t begin = forger.file.size();
      mcap::append(forger.file, mcap::Attachment{1, kContentsName, kContentsType,
                                                 Bytes(text.begin(), text.end())});
      forger.summary.add_attachment({begin, forger.file.size() - begin, 1, text.size(), "", ""});
    }
    const auto reader = RecordingReader::open(folder.put("a.mcap", forger.finished()));
    EXPECT_TRUE(reader.ok());
    std::vector<std::size_t> lengths;
    for (const Mark& mark : reader->summary().marks) lengths.push_back(mark.name.size());
    return lengths;
  };
  EXPECT_EQ(marks({3, 5}), std::vector<std::size_t>{3});
  EXPECT_EQ(marks({9 << 20}), std::vector<std::size_t>{});
}

// Others cut the file while we hold it.
TEST(OpenFile, ThatIsCutIsDamagedNotACrash) {
  const kit::Folder folder;
  WriterOptions options;
  options.chunk_bytes = 64 << 10;
  options.compression = Compression::none;
  const auto items = kit::exercise(500);
  const std::string path = folder.put("a.mcap", kit::recording_of(items, options));
  const auto reader = RecordingReader::open(path);
  ASSERT_TRUE(reader.ok());
  std::filesystem::resize_file(path, 100'000);
  auto cursor = reader->items();
  std::size_t read = 0;
  while (cursor.next()) ++read;
  EXPECT_GT(read, 0U);
  EXPECT_LT(read, items.size());
  EXPECT_GT(cursor.chunks_damaged(), 0U);
  EXPECT_EQ(cursor.damage()->file, path);
  EXPECT_GT(cursor.damage()->offset, 90'000U);
}

// A file may have a million chunks of a few octets, all open at once.
TEST(HostileFile, OfTinyChunksInLargeBlocksTakesLittleMemory) {
  const Bytes octets(60, 7);
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.blockSizeID = LZ4F_max4MB;
  Bytes packed(LZ4F_compressFrameBound(octets.size(), &preferences));
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), octets.data(), octets.size(), &preferences));
  const auto back = decompress(Compression::lz4, packed, octets.size());
  ASSERT_TRUE(back.ok());
  EXPECT_TRUE(std::equal(octets.begin(), octets.end(), back->octets().begin()));
  EXPECT_EQ(back->memory(), octets.size());
}

}  // namespace
}  // namespace skerry::recording
