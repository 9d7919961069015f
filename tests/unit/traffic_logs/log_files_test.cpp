// Files by what stands in them: logs, tables, captures, packed or not; and how much memory they
// take.
#include "server/traffic_logs/log_files.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "protocol/pcap/pcap_writer.hpp"
#include "tests/unit/traffic_logs/log_kit.hpp"

namespace skerry::server {
namespace {

namespace fs = std::filesystem;

class LogFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string written(const std::string& name, const std::string& text) {
    const std::string file = (folder_ / name).string();
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  static std::string fixes(int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += logged(position_of(219'000'001, 55.0 + 1e-4 * i, 11.0), 10.0 * i)[0] + "\r\n";
    }
    return text;
  }
  LogFileRead read(const std::string& file) {
    const auto result = read_log_file(file, book_);
    EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error());
    return result.ok() ? *result : LogFileRead{};
  }

  fs::path folder_ = fs::path(testing::TempDir()) / "traffic_log_files";
  TrackBook book_{TrackRules{}};
};

TEST_F(LogFiles, ALogIsReadWhateverItsName) {
  const LogFileRead log = read(written("a.bin", fixes(5)));
  EXPECT_EQ(log.form, LogForm::nmea);
  EXPECT_EQ(log.lines, 5u);
  EXPECT_EQ(log.used, 5u);
  EXPECT_EQ(book_.fixes(), 5u);
}

TEST_F(LogFiles, ATableIsKnownByItsHeader) {
  const LogFileRead log = read(written(
      "a.log", "mmsi,time,lat,lon\n219000001,1609811515,55,11\n219000001,1609811525,55,11"));
  EXPECT_EQ(log.form, LogForm::csv);
  EXPECT_EQ(log.used, 2u);
  EXPECT_EQ(book_.fixes(), 2u);
}

TEST_F(LogFiles, ACaptureHasItsOwnTimes) {
  std::string file;
  pcap::PcapWriter writer([&](std::span<const std::uint8_t> bytes) {
    file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
  const auto add = [&](double seconds, const std::string& text) {
    writer.add(log_time(seconds), {ipv4(10, 0, 0, 1), 1}, {ipv4(10, 0, 0, 255), 10110},
               {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  for (int i = 0; i < 3; ++i) {
    std::string text = nmea::encode_ais(position_of(219'000'001, 55.0, 11.0), false, 0, 'A')[0];
    const std::string tags = "s:AI0001";
    if (i == 1) {  // IEC 61162-450
      text =
          std::string("UdPbC\0", 6) + "\\" + tags + "*" + nmea::checksum_text(tags) + "\\" + text;
    }
    add(10.0 * i, text);
  }
  add(40, "\x01\x02 not for us");
  const LogFileRead log = read(written("a.txt", file));
  EXPECT_EQ(log.form, LogForm::capture);
  EXPECT_EQ(log.lines, 3u);
  EXPECT_EQ(log.used, 3u);
  EXPECT_EQ(book_.left_out().all(), 0u);
  const auto ships = book_.finish();
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].pieces[0].fixes.back().utc_ms, 1000 * (kLogBegin_s + 20));
}

TEST_F(LogFiles, LinesOfTenMegabytesAndZerosAreCountedAndPassedOver) {
  std::string text = fixes(3);
  text += std::string(10 << 20, '!') + "\n" + std::string(10 << 20, '\0') + "\n";
  text += std::string(100, '\0') + "\n";
  const std::string good = logged(position_of(219'000'001, 55.001, 11.0), 100)[0];
  text += good + "\n" + std::string(10 << 20, 'x');
  const LogFileRead log = read(written("a.nmea", text));
  EXPECT_EQ(log.used, 4u);
  EXPECT_EQ(book_.left_out().of(LeftOut::too_long), 3u);
  EXPECT_EQ(book_.left_out().of(LeftOut::no_sentence), 1u);
  EXPECT_EQ(book_.left_out().all(), 4u);
}

TEST_F(LogFiles, SaysWhatIsWrongWithAFile) {
  const auto missing = read_log_file((folder_ / "none").string(), book_);
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().find("cannot open it"), std::string::npos) << missing.error();
  const auto table = read_log_file(written("b.csv", "mmsi,time\n1,2\n"), book_);
  ASSERT_FALSE(table.ok());
  EXPECT_NE(table.error().find("no column \"lat\""), std::string::npos) << table.error();
  EXPECT_EQ(read(written("empty", "")).lines, 0u);
}

// A day of a busy place: a million sentences of 500 ships.  The log is 69 MB; memory must not grow
// with it.
// A sanitizer's memory is not ours, and it takes its time.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kMemoryIsOurs = false;
#elif defined(__has_feature)
constexpr bool kMemoryIsOurs =
    !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kMemoryIsOurs = true;
#endif

TEST_F(LogFiles, AMillionSentencesTakeLittleMemory) {
  constexpr int kRounds = kMemoryIsOurs ? 2000 : 40;
  const std::string file = (folder_ / "day.nmea").string();
  {
    std::ofstream out(file, std::ios::binary);
    for (int i = 0; i < kRounds; ++i) {
      for (std::uint32_t ship = 0; ship < 500; ++ship) {
        const double way = 0.0005 * i + 0.002 * std::sin(0.01 * i + ship);
        out << logged(position_of(219'000'000 + ship, 50.0 + 0.01 * ship + 0.1 * way, 5.0 + way),
                      40.0 * i + 0.01 * ship)[0]
            << '\n';
      }
    }
  }
  const auto resident_mb = [] {
    std::ifstream statm("/proc/self/statm");
    double all = 0.0, resident = 0.0;
    statm >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  };
  // What tests before this one gave back would be used again unseen.
  malloc_trim(0);
  const double before_mb = resident_mb();
  double most_mb = before_mb;
  const auto result =
      read_log_file(file, book_, [&](double) { most_mb = std::max(most_mb, resident_mb()); });
  ASSERT_TRUE(result.ok()) << result.error();
  const LogFileRead log = *result;
  most_mb = std::max(most_mb, resident_mb());
  const double grew_mb = most_mb - before_mb;
  EXPECT_EQ(log.used, 500u * kRounds);
  const auto ships = book_.finish();
  EXPECT_EQ(ships.size(), 500u);
  std::size_t kept = 0;
  for (const LoggedShip& ship : ships) {
    for (const LoggedPiece& piece : ship.pieces) kept += piece.fixes.size();
  }
  std::printf("a log of %.0f MB: memory grew by %.1f MB; %zu fixes kept\n",
              static_cast<double>(fs::file_size(file)) / 1e6, grew_mb, kept);
  RecordProperty("grew_mb", std::to_string(grew_mb));
  if (!kMemoryIsOurs) return;
  EXPECT_GT(grew_mb, 0.5) << "it was measured";
  EXPECT_LT(grew_mb, 16.0);
}

}  // namespace
}  // namespace skerry::server
