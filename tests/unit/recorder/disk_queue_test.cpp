// What is taken, in which order it is done, and when it waits: without a thread and without a file.
#include "server/recorder/disk_queue.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace skerry::server {
namespace {

using JobKind = DiskJob::Kind;
using Outcome = DiskQueue::Outcome;
using After = DiskQueue::After;

constexpr std::size_t kQueue = 1000;
constexpr std::uint64_t kReserve = 5000;
// Free space of which nothing is left for bytes.
constexpr std::uint64_t kNone = kReserve + DiskQueue::kMargin;

class AQueue : public testing::Test {
 protected:
  Taken take(std::size_t bytes, std::uint64_t spokes = 1) {
    return queue_.take(Bytes(bytes, 1), spokes);
  }
  // Starts the next job, which must be of that kind, and finishes it.
  After do_next(JobKind kind, Outcome outcome = Outcome::done, bool removed = false) {
    auto job = queue_.start();
    EXPECT_TRUE(job && job->kind == kind);
    return job ? queue_.finish(*std::move(job), outcome, removed) : After::go_on;
  }
  void begun() {
    queue_.begin("a");
    do_next(JobKind::begin);
  }

  DiskQueue queue_{kQueue, kReserve};
};

TEST_F(AQueue, IsIdleAtFirst) {
  EXPECT_FALSE(queue_.can_work());
  EXPECT_FALSE(queue_.is_over());
  EXPECT_FALSE(queue_.start());
  EXPECT_FALSE(queue_.state().is_busy);
  queue_.stop();
  EXPECT_TRUE(queue_.is_over());
}

TEST_F(AQueue, GivesJobsInTheOrderOfTheCalls) {
  queue_.begin("a");
  EXPECT_FALSE(queue_.write_follows());
  take(10);
  queue_.next_file();
  EXPECT_EQ(queue_.take_end(Bytes(3, 1)), Taken::yes);
  queue_.end();
  std::vector<JobKind> kinds;
  while (auto job = queue_.start()) {
    EXPECT_TRUE(queue_.state().is_busy);
    if (job->kind == JobKind::begin) {
      EXPECT_EQ(job->name, "a");
      EXPECT_TRUE(queue_.write_follows());
    }
    kinds.push_back(job->kind);
    queue_.finish(*std::move(job), Outcome::done, false);
  }
  EXPECT_EQ(kinds, (std::vector{JobKind::begin, JobKind::write, JobKind::close, JobKind::next,
                                JobKind::write, JobKind::close, JobKind::end}));
  EXPECT_FALSE(queue_.state().is_busy);
}

TEST_F(AQueue, HoldsItsBoundToTheByteWithTheJobAtWork) {
  begun();
  EXPECT_EQ(take(kQueue + 1), Taken::too_slow);
  EXPECT_EQ(take(kQueue - 1), Taken::yes);
  EXPECT_EQ(take(2), Taken::too_slow);
  EXPECT_EQ(take(1), Taken::yes);
  EXPECT_EQ(queue_.take_end(Bytes(kQueue, 1)), Taken::yes) << "the end of a file has no bound";
  auto job = queue_.start();
  EXPECT_EQ(take(0), Taken::too_slow) << "what is at work is counted";
  queue_.finish(*std::move(job), Outcome::done, false);
  do_next(JobKind::write);
  EXPECT_EQ(take(1), Taken::too_slow);
  do_next(JobKind::write);
  EXPECT_EQ(take(kQueue), Taken::yes);
}

TEST_F(AQueue, TakesUpToTheReserveToTheByte) {
  begun();
  queue_.found_free(kNone + 99);
  const std::uint64_t version = queue_.state().version;
  EXPECT_EQ(take(100), Taken::no_room);
  EXPECT_TRUE(queue_.state().is_full);
  EXPECT_EQ(queue_.state().version, version + 1);
  EXPECT_EQ(take(100), Taken::no_room);
  EXPECT_EQ(queue_.state().version, version + 1) << "nothing changed";
  EXPECT_EQ(queue_.take_end(Bytes(100, 1)), Taken::yes) << "the reserve is for the end";
  do_next(JobKind::write);
  EXPECT_EQ(take(99), Taken::yes);
  EXPECT_FALSE(queue_.state().is_full);
  EXPECT_EQ(queue_.state().version, version + 2);
  EXPECT_EQ(take(1), Taken::no_room) << "the rest is needed for what waits";
  do_next(JobKind::write);
  queue_.wrote(99);
  EXPECT_EQ(take(1), Taken::no_room);
  queue_.found_free(kNone + 1);
  EXPECT_EQ(take(1), Taken::yes);
  queue_.found_free(std::nullopt);
  EXPECT_EQ(take(kQueue - 1), Taken::yes) << "a system that does not say what is free";
}

TEST_F(AQueue, KeepsItsOrderWhileTheDiskIsFull) {
  begun();
  take(10, 3);
  take(20, 4);
  const std::uint64_t version = queue_.state().version;
  for (int i = 0; i < 2; ++i) {
    auto job = queue_.start();
    ASSERT_TRUE(job);
    EXPECT_EQ(job->bytes.size(), 10u);
    EXPECT_EQ(job->waited, i > 0);
    EXPECT_EQ(queue_.finish(*std::move(job), Outcome::no_room, false), After::go_on);
    EXPECT_TRUE(queue_.is_stuck());
    EXPECT_FALSE(queue_.can_work()) << "it is tried again after a while";
    EXPECT_TRUE(queue_.state().is_full);
    EXPECT_EQ(queue_.state().version, version + 1);
    EXPECT_EQ(take(1), Taken::no_room);
  }
  do_next(JobKind::write);
  EXPECT_FALSE(queue_.is_stuck());
  EXPECT_TRUE(queue_.can_work());
  EXPECT_TRUE(queue_.state().is_full) << "until bytes are taken again";
  EXPECT_EQ(take(kQueue - 20), Taken::yes);
  EXPECT_FALSE(queue_.state().is_full);
  EXPECT_EQ(queue_.state().spokes_lost, 0u);
}

TEST_F(AQueue, NeitherTheEndNorStopWaitsForSpace) {
  for (const bool ends : {true, false}) {
    DiskQueue queue(kQueue, 0);
    queue.begin("a");
    queue.finish(*queue.start(), Outcome::done, false);
    queue.take(Bytes(10, 1), 7);
    queue.finish(*queue.start(), Outcome::no_room, false);
    EXPECT_FALSE(queue.can_work());
    ends ? queue.end() : queue.stop();
    EXPECT_TRUE(queue.can_work());
    EXPECT_FALSE(queue.is_over());
    EXPECT_EQ(queue.finish(*queue.start(), Outcome::no_room, false), After::cut_file);
    EXPECT_EQ(queue.state().spokes_lost, 7u);
    EXPECT_FALSE(queue.is_stuck());
    while (auto job = queue.start()) queue.finish(*std::move(job), Outcome::done, false);
    EXPECT_FALSE(queue.state().is_busy);
    if (!ends) continue;
    // The next recording waits again.
    queue.begin("b");
    queue.finish(*queue.start(), Outcome::no_room, false);
    EXPECT_FALSE(queue.can_work());
  }
}

TEST_F(AQueue, ARemovedFileDoesNotWaitForSpace) {
  begun();
  take(10, 7);
  EXPECT_EQ(do_next(JobKind::write, Outcome::no_room, true), After::cut_file);
  EXPECT_EQ(queue_.state().spokes_lost, 7u);
  // A file that cannot be made waits, whatever became of the one before.
  queue_.next_file();
  do_next(JobKind::close);
  EXPECT_EQ(do_next(JobKind::next, Outcome::no_room, true), After::go_on);
  EXPECT_TRUE(queue_.is_stuck());
}

TEST_F(AQueue, AFileThatFindsNoSpaceUntilTheEndIsNotMade) {
  queue_.begin("a");
  take(10, 7);
  EXPECT_EQ(do_next(JobKind::begin, Outcome::no_room), After::go_on);
  queue_.end();
  EXPECT_EQ(do_next(JobKind::begin, Outcome::no_room), After::no_file);
  EXPECT_EQ(do_next(JobKind::write, Outcome::failed), After::go_on);
  EXPECT_EQ(queue_.state().spokes_lost, 7u);
}

TEST_F(AQueue, FailsUntilTheNextBegin) {
  begun();
  take(10, 7);
  queue_.problem("the disk is broken", true);
  EXPECT_EQ(take(1), Taken::failed);
  EXPECT_EQ(queue_.take_end(Bytes(1, 1)), Taken::failed);
  do_next(JobKind::write, Outcome::failed);
  EXPECT_EQ(queue_.state().spokes_lost, 7u);
  EXPECT_EQ(queue_.state().problem, "the disk is broken");
  const std::uint64_t version = queue_.state().version;
  queue_.begin("b");
  EXPECT_FALSE(queue_.state().failed);
  EXPECT_GT(queue_.state().version, version);
  EXPECT_EQ(take(1), Taken::yes);
}

TEST_F(AQueue, WhatAnEarlierRecordingFindsDoesNotTouchTheNext) {
  begun();
  take(10, 7);
  queue_.end();
  queue_.begin("b");
  queue_.opened("a.mcap");
  queue_.problem("of a", true);
  EXPECT_FALSE(queue_.state().failed);
  do_next(JobKind::write, Outcome::failed);
  do_next(JobKind::close);
  do_next(JobKind::end);
  do_next(JobKind::begin, Outcome::no_room);
  EXPECT_EQ(queue_.state().file, "") << "what was before the begin is forgotten";
  EXPECT_EQ(queue_.state().spokes_lost, 0u);
  queue_.problem("of b", false);
  do_next(JobKind::begin);
  EXPECT_EQ(queue_.state().problem, "of b") << "a begin that waited forgets nothing";
}

TEST_F(AQueue, CountsWhatWasWritten) {
  begun();
  queue_.opened("a.mcap");
  queue_.wrote(10);
  queue_.file_gone();
  EXPECT_TRUE(queue_.state().file_is_gone);
  const std::uint64_t version = queue_.state().version;
  queue_.opened("a-002.mcap");
  queue_.wrote(5);
  const DiskState state = queue_.state();
  EXPECT_EQ(state.file, "a-002.mcap");
  EXPECT_EQ(state.file_bytes, 5u);
  EXPECT_EQ(state.total_bytes, 15u);
  EXPECT_FALSE(state.file_is_gone);
  EXPECT_EQ(state.version, version + 1);
  queue_.found_idle(77);
  EXPECT_EQ(queue_.state().free_bytes, 77u);
  EXPECT_EQ(take(kQueue), Taken::yes) << "that was for people alone";
}

}  // namespace
}  // namespace skerry::server
