// Files that were cut, overwritten or made up: what is right in them is read, nothing that is
// wrong.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <set>

#include "protocol/recording/mcap_records.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/recording/repair.hpp"
#include "protocol/recording/writer.hpp"
#include "tests/unit/recording/recording_kit.hpp"

namespace skerry::recording {
namespace {

using kit::Kept;

WriterOptions options_of(Compression compression, bool compact) {
  WriterOptions options;
  options.compression = compression;
  options.compact = compact;
  options.chunk_bytes = 64 << 10;
  return options;
}

bool less(const Kept& a, const Kept& b) {
  return std::tie(a.time, a.topic, a.bytes) < std::tie(b.time, b.topic, b.bytes);
}

// Every item of a file that was never written.
bool all_of(const std::vector<Kept>& read, std::vector<Kept> written) {
  std::sort(written.begin(), written.end(), less);
  return std::all_of(read.begin(), read.end(), [&](const Kept& item) {
    return std::binary_search(written.begin(), written.end(), item, less);
  });
}

// Ends of the chunks of a whole file.
std::vector<std::size_t> chunk_ends(const Bytes& file) {
  std::vector<std::size_t> ends;
  for (std::size_t offset = 8; offset + 9 <= file.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, file.data() + offset + 1, 8);
    const auto op = static_cast<mcap::Op>(file[offset]);
    offset += 9 + length;
    if (op == mcap::Op::chunk) ends.push_back(offset);
    if (op == mcap::Op::footer) break;
  }
  return ends;
}

class CutFile : public testing::TestWithParam<std::pair<Compression, bool>> {};

// Few topics: what is tried at every octet is a file of some.
std::vector<Kept> few_items() {
  std::vector<Kept> items{kit::hello_item()};
  for (std::uint32_t number = 0; number < 12; ++number) {
    items.push_back(kit::spoke_item(number, 0, 0, 128));
    if (number % 4 == 3) items.push_back(kit::event_item(number * 0.005 + 0.001, "mark"));
  }
  return items;
}

Bytes few_items_recorded(const std::pair<Compression, bool>& how) {
  auto options = options_of(how.first, how.second);
  options.chunk_time = std::chrono::milliseconds(21);
  return kit::recording_of(few_items(), options);
}

TEST_P(CutFile, ReadsUpToItsLastWholeChunkWhereverItIsCut) {
  const kit::Folder folder;
  const auto items = few_items();
  const Bytes file = few_items_recorded(GetParam());
  const auto ends = chunk_ends(file);
  ASSERT_EQ(ends.size(), 3U);
  const std::string path = folder.put("a.mcap", file);
  std::size_t after = items.size();
  for (std::size_t cut = file.size(); cut-- > 0;) {
    std::filesystem::resize_file(path, cut);
    const auto reader = RecordingReader::open(path);
    if (cut < 8) {
      ASSERT_FALSE(reader.ok());
      continue;
    }
    ASSERT_TRUE(reader.ok()) << cut << ": " << reader.error().to_string();
    ASSERT_TRUE(reader->summary().damage) << cut;
    const auto read = kit::read_all(reader->items());
    ASSERT_TRUE(std::equal(read.begin(), read.end(), items.begin())) << cut;
    ASSERT_LE(read.size(), after) << cut;
    after = read.size();
    std::uint64_t counted = 0;
    for (const auto& [topic, number] : reader->summary().items) counted += number;
    ASSERT_EQ(counted, read.size()) << cut;
    ASSERT_TRUE(cut < ends.back() || read.size() == items.size()) << cut;
    if (read.empty()) continue;
    ASSERT_EQ(reader->summary().end, read.back().time) << cut;
  }
  EXPECT_EQ(after, 0U);
}

TEST_P(CutFile, AnyOctetChangedNeverReadsAsRight) {
  const kit::Folder folder;
  const auto items = few_items();
  const Bytes file = few_items_recorded(GetParam());
  const std::string path = folder.put("a.mcap", file);
  const int written = ::open(path.c_str(), O_WRONLY);
  std::mt19937 random(3);
  std::size_t fewest = items.size();
  for (std::size_t at = 0; at < file.size(); ++at) {
    const auto wrong = static_cast<std::uint8_t>(file[at] ^ (1 + random() % 255));
    ASSERT_EQ(::pwrite(written, &wrong, 1, static_cast<off_t>(at)), 1);
    const auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader.ok() || at < 8) << reader.error().to_string();
    if (reader) {
      const auto read = kit::read_all(reader->items());
      ASSERT_TRUE(all_of(read, items)) << at;
      fewest = std::min(fewest, read.size());
    }
    ASSERT_EQ(::pwrite(written, &file[at], 1, static_cast<off_t>(at)), 1);
  }
  ::close(written);
  // At most one of three chunks is lost.
  EXPECT_GE(fewest, items.size() - 7);
}

INSTANTIATE_TEST_SUITE_P(All, CutFile,
                         testing::Values(std::pair(Compression::none, false),
                                         std::pair(Compression::lz4, false),
                                         std::pair(Compression::lz4, true),
                                         std::pair(Compression::zstd, true)));

constexpr int kCuts = 1000;

TEST(Repair, MakesAWholeFileOfACutOne) {
  const kit::Folder folder;
  const auto items = kit::exercise(250);
  const Bytes file = kit::recording_of(items, options_of(Compression::lz4, false));
  const auto ends = chunk_ends(file);
  std::mt19937_64 random(11);
  for (int i = 0; i < kCuts; ++i) {
    const auto cut = static_cast<std::size_t>(random() % file.size());
    Bytes damaged(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(cut));
    const bool flipped = i % 3 == 0 && cut > 100;
    const std::size_t flip = flipped ? random() % cut : file.size();
    if (flipped) damaged[flip] ^= 0x10;
    const std::string from = folder.put("from.mcap", damaged);
    const std::string to = folder.path("to.mcap");
    std::filesystem::remove(to);
    const auto report = repair(from, to);
    if (!report) {
      // Only one of whose chunks none is whole, or whose first bytes are no recording's.
      ASSERT_TRUE(cut < ends[1] + 5000 || flip < 8) << report.error().to_string();
      ASSERT_FALSE(std::filesystem::exists(to));
      continue;
    }
    const auto reader = RecordingReader::open(to);
    ASSERT_TRUE(reader.ok());
    ASSERT_FALSE(reader->summary().damage) << reader->summary().damage->to_string();
    const auto read = kit::read_all(reader->items());
    ASSERT_EQ(read.size(), report->items);
    ASSERT_TRUE(all_of(read, items));
    const auto whole =
        static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), cut) - ends.begin());
    // A chunk whose own head was hit is not known to be one.
    ASSERT_GE(report->chunks_kept + report->chunks_damaged + (flipped ? 1 : 0), whole) << cut;
  }
}

TEST(Repair, ReplacesNothingAndLeavesNothingBehind) {
  const kit::Folder folder;
  const auto items = kit::exercise(100);
  const Bytes whole = kit::recording_of(items);
  const std::string from = folder.put("from.mcap", whole);
  const std::string to = folder.put("to.mcap", {1, 2, 3});
  EXPECT_FALSE(repair(from, to).ok());
  EXPECT_FALSE(repair(from, from).ok());
  EXPECT_FALSE(repair(from, folder.path("none/to.mcap")).ok());
  EXPECT_FALSE(repair(from, folder.path("new.mcap"), [](double) { return false; }).ok() &&
               std::filesystem::exists(folder.path("new.mcap.part")));
  std::filesystem::remove(folder.path("new.mcap"));
  const auto report = repair(from, folder.path("copy.mcap"));
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->was_whole);
  EXPECT_EQ(report->items, items.size());
  EXPECT_EQ(kit::read_all(folder.path("copy.mcap")), items);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("")))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 3U);
}

// Two chunks of which the first's length is a lie: the second is found.
TEST(Search, GoesOnBehindWhatCannotBeRead) {
  const kit::Folder folder;
  const auto items = kit::exercise(400);
  auto options = options_of(Compression::lz4, false);
  const Bytes file = kit::recording_of(items, options, false);
  Bytes changed = file;
  const std::size_t at = file.size() / 2;
  std::fill(changed.begin() + static_cast<std::ptrdiff_t>(at),
            changed.begin() + static_cast<std::ptrdiff_t>(at) + 3000, 6);
  const auto reader = RecordingReader::open(folder.put("a.mcap", changed));
  ASSERT_TRUE(reader.ok());
  EXPECT_TRUE(reader->summary().damage);
  const auto read = kit::read_all(reader->items());
  EXPECT_TRUE(all_of(read, items));
  EXPECT_EQ(read.back(), items.back());
  EXPECT_GT(read.size(), items.size() / 2);
}

TEST(Search, CanBeGivenUp) {
  const kit::Folder folder;
  WriterOptions options;
  options.compression = Compression::none;
  const Bytes file = kit::recording_of(kit::exercise(16000), options, false);
  ASSERT_GT(file.size(), 8U << 20);
  double last = -1.0;
  const std::string path = folder.put("a.mcap", file);
  const auto reader = RecordingReader::open(path, [&](double share) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
    last = share;
    return false;
  });
  ASSERT_FALSE(reader.ok());
  EXPECT_EQ(reader.error().text, "given up");
  EXPECT_GE(last, 0.0);
}

}  // namespace
}  // namespace skerry::recording
