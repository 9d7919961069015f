// DiskQueue: what waits to be written, and what is known of the disk.  Neither thread nor file.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>

#include "protocol/wire/wire_error.hpp"

namespace skerry::server {

struct DiskState {
  std::string file;               // the present or the last one, without folder; empty: none yet
  std::uint64_t file_bytes = 0;   // written to it
  std::uint64_t total_bytes = 0;  // written to all files since begin()
  std::uint64_t free_bytes = 0;   // on the disk, when last looked at
  bool is_full = false;           // nothing is taken, for want of space
  std::uint64_t spokes_lost = 0;  // taken, but the disk turned out to be full
  std::string problem;            // the last one; if `failed`, the reason
  bool file_is_gone = false;      // it was removed, renamed or replaced: begin the next
  bool is_busy = false;           // a job waits or is at work
  bool failed = false;            // nothing is taken any more until the next begin()
  std::uint64_t version = 0;      // grows when file, is_full, problem or failed change
};

// Whether bytes were taken to be written.
enum class Taken : std::uint8_t { yes, no_room, too_slow, failed };

struct DiskJob {
  enum class Kind : std::uint8_t { begin, write, close, next, end };
  Kind kind = Kind::write;
  std::string name = {};  // begin: of the series
  Bytes bytes = {};       // write
  std::uint64_t spokes = 0;
  bool waited = false;  // it was tried before and found no space
};

// Jobs are done in the order of the calls.  Bytes that are taken are written, so that a writer of
// recordings knows where in the file they are.  While the disk is full they wait; no more are taken
// once max_queue is reached, or while the free space less the reserve is needed for what waits.
// Two things never wait for space: ending a recording, whose file then has no index, and a file
// that was removed, whose space is free once it is closed.
// Thread: one at a time.
class DiskQueue {
 public:
  // Kept free beyond the reserve for index, list and folder.
  static constexpr std::uint64_t kMargin = 1u << 20;

  DiskQueue(std::size_t max_queue, std::uint64_t reserve_bytes)
      : max_queue_(max_queue), reserve_bytes_(reserve_bytes) {}

  // The recorder's calls.
  void begin(const std::string& name);
  void next_file();
  void end();
  // All bytes are written one after the other, or none.  They contain `spokes` spokes.
  Taken take(std::span<const std::uint8_t> bytes, std::uint64_t spokes);
  // The last bytes of a file.  They may use the reserve, and the queue has no bound for them.
  Taken take_end(std::span<const std::uint8_t> bytes);
  void stop() { stopping_ = true; }
  DiskState state() const;

  // The disk's calls.
  bool is_stuck() const { return stuck_; }  // the first job found no space
  bool is_over() const { return stopping_ && jobs_.empty(); }
  // False: wait before start(), for a job, or because the disk is full.
  bool can_work() const { return !jobs_.empty() && (!stuck_ || gives_up()); }
  bool write_follows() const {
    return !jobs_.empty() && jobs_.front().kind == DiskJob::Kind::write;
  }
  // The next job, which is at work until finish().
  std::optional<DiskJob> start();
  enum class Outcome : std::uint8_t { done, no_room, failed };
  enum class After : std::uint8_t {
    go_on,
    no_file,   // the disk is full and the recording ends: a file was not made
    cut_file,  // the same, or the file was removed: bytes are missing, nothing may follow them
  };
  // `file_removed`: the open file has no name any more.
  After finish(DiskJob job, Outcome outcome, bool file_removed);

  // Reports of the disk's thread.
  void opened(const std::string& file);
  void wrote(std::size_t bytes);
  void file_gone() { state_.file_is_gone = true; }
  void found_free(std::optional<std::uint64_t> bytes);  // while a recording goes on
  void found_idle(std::uint64_t free_bytes) { state_.free_bytes = free_bytes; }
  // Ignored while a begin waits, as it concerns an earlier recording.
  void problem(const std::string& text, bool failed);

 private:
  void order(DiskJob job);
  void forget();
  bool gives_up() const { return ends_queued_ > 0 || stopping_; }

  const std::size_t max_queue_;
  const std::uint64_t reserve_bytes_;
  std::deque<DiskJob> jobs_;
  std::size_t queued_bytes_ = 0;                     // the job at work among them
  std::size_t begins_queued_ = 0, ends_queued_ = 0;  // an end at work among them
  DiskState state_;
  std::optional<std::uint64_t> free_;  // nothing: not known
  bool stuck_ = false;
  bool is_working_ = false;
  bool stopping_ = false;
};

}  // namespace skerry::server
