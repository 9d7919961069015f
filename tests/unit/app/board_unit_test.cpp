// The ways out of a board: frames of records, memory shared with other processes, the log.
#include "server/board/board_unit.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/wire/frame.hpp"
#include "server/board/record_frames.hpp"

namespace skerry::server {
namespace {

TEST(RecordFrames, HoldEveryRecordOnceAndSayWhereItLies) {
  Bytes bytes(10'000);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  const std::vector<std::uint32_t> ends = {64, 128, 4096, 4160, 9000, 9064, 10'000};
  std::uint64_t next = 77;
  std::size_t at = 0;
  for_each_block(bytes, ends, 77, 1000, [&](const RecordBlock& block) {
    EXPECT_EQ(block.first_sequence, next);
    EXPECT_TRUE(block.bytes.size() <= 1000 || block.count() == 1);
    const EncodedSectorPtr frame = records_frame(5, block);
    wire::ServerMessage message;
    const auto body = frame_body(frame->bytes);
    ASSERT_TRUE(message.ParseFromArray(body.data(), static_cast<int>(body.size())));
    EXPECT_EQ(message.board_records().radar(), 5u);
    EXPECT_EQ(message.board_records().first_sequence(), next);
    EXPECT_EQ(message.board_records().count(), frame->spoke_count());
    std::uint32_t begin = frame->begin;
    for (const std::uint32_t end : frame->spoke_ends) {
      const Bytes record(frame->bytes.begin() + begin, frame->bytes.begin() + end);
      ASSERT_EQ(record, Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                              bytes.begin() + static_cast<std::ptrdiff_t>(ends[next - 77])));
      at = ends[next - 77];
      begin = end;
      ++next;
    }
    EXPECT_EQ(begin, frame->bytes.size());
  });
  EXPECT_EQ(next, 77 + ends.size());
}

std::string ring_name() { return "/skerry-board-test-" + std::to_string(::getpid()); }

TEST(SharedRing, IsNotTakenFromAServerThatLives) {
  auto first = SharedRing::create(ring_name(), SharedRing::kMinBytes);
  ASSERT_TRUE(first) << first.error();
  const auto second = SharedRing::create(ring_name(), SharedRing::kMinBytes);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error(),
            "no shared memory " + ring_name() + ": another server of this host uses it");
}

TEST(SharedRing, ReplacesWhatADeadServerLeftAndEndsWithItsOwner) {
  const int stale = ::shm_open(ring_name().c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
  ASSERT_GE(stale, 0);
  ASSERT_EQ(::ftruncate(stale, 100), 0);
  ::close(stale);
  {
    const auto ring = SharedRing::create(ring_name(), 3u << 20);
    ASSERT_TRUE(ring) << ring.error();
    EXPECT_GE(ring->size(), (3u << 20) + board::kRingHeader);
  }
  EXPECT_LT(::shm_open(ring_name().c_str(), O_RDONLY, 0), 0);
}

TEST(FaultLog, LeavesOutWhatIsTooMuchAndSaysHowMuchItWas) {
  BoardBatch batch;
  const std::uint32_t faults = board::fault::overrun | board::fault::stalled;
  for (int i = 0; i < 25; ++i) {
    batch.fault_changes.push_back({faults, 0});
    batch.fault_changes.push_back({0, faults});
  }
  FaultLog log("X");
  const std::chrono::steady_clock::time_point now(std::chrono::hours(1));
  const auto reason = [] { return std::string(); };
  testing::internal::CaptureStdout();
  log.look_at(batch, reason, now);
  log.look_at(BoardBatch{}, reason, now + FaultLog::kLineTime);
  const std::string text = testing::internal::GetCapturedStdout();
  std::size_t lines = 0;
  std::string line;
  for (std::istringstream in(text); std::getline(in, line);) ++lines;
  EXPECT_EQ(lines, FaultLog::kMostLines + 1u);
  EXPECT_NE(text.find("board of X: fault raised: stalled, overrun"), std::string::npos);
  EXPECT_NE(text.find("board of X: 30 more faults raised or cleared"), std::string::npos);
}

TEST(FaultLog, SaysFewLinesOfAFaultThatComesAndGoesOnAndOn) {
  BoardBatch batch;
  batch.fault_changes = {{board::fault::overrun, 0}, {0, board::fault::overrun}};
  FaultLog log("X");
  std::chrono::steady_clock::time_point now(std::chrono::hours(1));
  testing::internal::CaptureStdout();
  for (const auto end = now + std::chrono::hours(1); now < end; now += std::chrono::seconds(1)) {
    log.look_at(
        batch, [] { return std::string(); }, now);
  }
  const std::string text = testing::internal::GetCapturedStdout();
  const auto lines = std::count(text.begin(), text.end(), '\n');
  EXPECT_GE(lines, 360);
  EXPECT_LE(lines, 360 + FaultLog::kMostLines);
  // After 20 lines and as many left out, a count of those every ten seconds.
  EXPECT_NE(text.find("board of X: 20 more faults raised or cleared"), std::string::npos);
}

}  // namespace
}  // namespace skerry::server
