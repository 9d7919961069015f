// A ring between processes, some of which die.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "protocol/board/ring_memory.hpp"
#include "protocol/board/sweep_ring.hpp"
#include "tests/unit/board/ring_records.hpp"
#include "tests/unit/board/shared_pages.hpp"

namespace skerry::board {
namespace {

// A process that does `what` and says by a byte down a pipe when it got to a place of its own.
class Process {
 public:
  explicit Process(const std::function<void(const std::function<void()>& say)>& what) {
    EXPECT_EQ(pipe(pipe_), 0);
    pid_ = fork();
    if (pid_ == 0) {
      what([&] { (void)!write(pipe_[1], "x", 1); });
      _exit(0);
    }
    close(pipe_[1]);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (pid_ > 0) end(SIGKILL);
    close(pipe_[0]);
  }

  bool heard() {
    char byte = 0;
    return read(pipe_[0], &byte, 1) == 1;
  }
  // Its status once it is gone.
  int end(int signal = 0) {
    if (signal != 0) kill(pid_, signal);
    int status = -1;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return status;
  }

 private:
  int pipe_[2] = {-1, -1};
  pid_t pid_ = -1;
};

TEST(RingProcesses, AReaderThatIsKilledInTheMiddleChangesNothing) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  auto survivor = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(survivor.has_value());
  Bytes record;
  std::uint64_t sequence = 0;
  for (int victim = 0; victim < 20; ++victim) {
    Process dying([&](const std::function<void()>& say) {
      auto reader = SweepRingReader::open(pages.readable());
      say();
      Bytes mine;
      bool said = false;
      for (;;) {
        (void)reader->wait(std::chrono::seconds(10));
        while (reader->take(mine) == RingState::record) {
          if (!said) say();
          said = true;
        }
      }
    });
    ASSERT_TRUE(dying.heard());
    for (int n = 0; n < 40; ++n, ++sequence) {
      writer.write(ring_record(sequence, ring_record_size(sequence)), sequence, 1);
      ASSERT_EQ(survivor->take(record), RingState::record);
      ASSERT_TRUE(is_ring_record(record, ring_record_size(sequence)));
    }
    ASSERT_TRUE(dying.heard());  // it is in the midst of taking
    const int status = dying.end(SIGKILL);
    EXPECT_TRUE(WIFSIGNALED(status));
    writer.write(ring_record(sequence, 4096), sequence, 1);
    ++sequence;
    ASSERT_EQ(survivor->take(record), RingState::record);
  }
  EXPECT_EQ(survivor->records_lost(), 0u);
}

TEST(RingProcesses, AReaderCannotWriteIntoTheRing) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  Process vandal([&](const std::function<void()>& say) {
    say();
    std::signal(SIGSEGV, SIG_DFL);  // without a sanitizer's word about it
    *const_cast<volatile std::uint8_t*>(pages.readable().data()) = 0;
  });
  EXPECT_TRUE(vandal.heard());
  const int status = vandal.end();
  EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_TRUE(SweepRingReader::open(pages.readable()).has_value());
}

TEST(RingProcesses, WhatAWriterLeftBehindIsReadAndNothingElse) {
  SharedPages pages(kRingBytes);
  Process writing([&](const std::function<void()>& say) {
    SweepRingWriter writer(pages.writable());
    std::uint64_t sequence = 0;
    for (; sequence < 50; ++sequence) writer.write(ring_record(sequence, 64), sequence, 1);
    say();
    for (;; ++sequence) {
      writer.write(ring_record(sequence, ring_record_size(sequence)), sequence, 1);
    }
  });
  ASSERT_TRUE(writing.heard());
  auto reader = SweepRingReader::open(pages.readable());
  ASSERT_TRUE(reader.has_value());
  Bytes record;
  std::uint64_t first = 0, last = 0, taken = 0;
  const auto take_all = [&] {
    while (reader->take(record) == RingState::record) {
      last = record_prefix(record)->sequence;
      ASSERT_TRUE(is_ring_record(record, last < 50 ? 64 : ring_record_size(last)));
      if (taken == 0) first = last - reader->records_lost();
      ++taken;
      if (taken == 5000) break;
    }
  };
  while (taken < 20) {
    ASSERT_TRUE(reader->wait(std::chrono::seconds(60)));
    take_all();
  }
  writing.end(SIGKILL);
  take_all();
  EXPECT_EQ(taken + reader->records_lost(), last - first + 1);
  EXPECT_EQ(reader->take(record), RingState::empty);
  EXPECT_FALSE(reader->wait(std::chrono::milliseconds(1)));

  // Its successor, in the same memory.
  SweepRingWriter writer(pages.writable());
  writer.write(ring_record(7, 4096), 7, 1);
  ASSERT_EQ(reader->take(record), RingState::record);
  EXPECT_TRUE(is_ring_record(record, 4096));
  EXPECT_EQ(reader->take(record), RingState::empty);
}

// A write that was begun and never ended: the counters as they stand when its process dies.
TEST(RingProcesses, OfARecordHalfWrittenNothingIsSeen) {
  SharedPages pages(kRingBytes);
  SweepRingWriter writer(pages.writable());
  for (std::uint64_t sequence = 0; sequence < 9; ++sequence) {
    writer.write(ring_record(sequence, 32'768), sequence, 1);
  }
  auto slow = SweepRingReader::open(pages.readable());
  for (std::uint64_t sequence = 9; sequence < 24; ++sequence) {
    writer.write(ring_record(sequence, 32'768), sequence, 1);
  }
  auto* header = reinterpret_cast<RingHeader*>(pages.writable().data());
  // 24 records published of a ring of 16: the slow reader stands at 9.  The next two are reserved,
  // so that 8 and 9 are no longer to be had.
  header->reserved.store(26 * 32'768);
  std::fill_n(pages.writable().begin() + kRingHeader + 8 * 32'768, 40'000, std::uint8_t{0xEE});
  Bytes record;
  ASSERT_EQ(slow->take(record), RingState::record);
  EXPECT_EQ(record_prefix(record)->sequence, 23u);
  EXPECT_TRUE(is_ring_record(record, 32'768));
  EXPECT_EQ(slow->records_lost(), 14u);
  EXPECT_EQ(slow->take(record), RingState::empty);
}

}  // namespace
}  // namespace skerry::board
