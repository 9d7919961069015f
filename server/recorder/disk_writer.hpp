// DiskWriter: what a recorder writes, on its way to the disk; waits for it on a thread of its own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include "protocol/wire/wire_error.hpp"
#include "server/recorder/recorder_config.hpp"
#include "server/recorder/recording_folder.hpp"

namespace skerry::server {

// As of now.
struct DiskState {
  std::string file;               // of now or the last one, without folder; empty: none yet
  std::uint64_t file_bytes = 0;   // of it, written
  std::uint64_t total_bytes = 0;  // of all since begin()
  std::uint64_t free_bytes = 0;   // on the disk, when last looked at
  bool is_full = false;           // what comes is not taken, for want of room
  std::uint64_t spokes_lost = 0;  // taken, but the disk turned out to be full
  std::string problem;            // the last one; of a failed one, why
  bool file_is_gone = false;      // somebody removed, renamed or replaced it: begin the next
  bool is_busy = false;           // something waits to be done
  bool failed = false;            // nothing is taken any more until the next begin()
  std::uint64_t version = 0;      // grows with file, is_full, problem and failed
};

// Everything is done in the order of the calls.  Bytes that are taken are written, so that a writer
// of recordings knows where in the file they are: while the disk is full they wait, and what comes
// is not taken once the queue is full, or the disk's free space but for the reserve is spoken for.
// What does not wait for room is the end of a recording, whose file then has no index, and a file
// that was removed: the room it takes is free once it is closed.
//
// Thread: functions are the recorder's and never wait for the disk, but for stop(); state(): any.
class DiskWriter {
 public:
  // `config` is copied; its folder is absolute.
  explicit DiskWriter(const RecorderConfig& config);
  ~DiskWriter();  // stop()

  // Opens the folder, and in it the first file of a series.
  void begin(const std::string& name);
  // The next file, after the end of the one before.
  void next_file();
  void end();

  enum class Taken : std::uint8_t { yes, no_room, too_slow, failed };
  // To be written at once after the other, or not at all.  `spokes` are in them.
  Taken take(std::span<const std::uint8_t> bytes, std::uint64_t spokes);
  // The same of the end of a file, for which the reserve is there too.
  Taken take_end(std::span<const std::uint8_t> bytes);

  DiskState state() const;
  // Carries out what was ordered, and ends the thread.
  void stop();

 private:
  struct Job {
    enum class Kind : std::uint8_t { begin, write, close, next, end } kind;
    std::string name;
    Bytes bytes;
    std::uint64_t spokes = 0;
    bool waited = false;  // for room
  };
  enum class Outcome : std::uint8_t { done, no_room, failed };

  void order(Job job);
  void run();
  // The disk's thread, without the lock.
  Outcome carry_out(Job& job);
  Outcome write(const Bytes& bytes);
  void open_file(bool series);
  Outcome sync_file();
  void close_file();
  void forget();          // what was; under the lock
  void look_at_disk();    // free space, while nothing is recorded
  void look_at_folder();  // the same; removes what is old
  void set_problem(const std::string& text, bool failed);

  const RecorderConfig config_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  std::size_t queued_bytes_ = 0;
  std::size_t begins_queued_ = 0, ends_queued_ = 0;  // jobs begin and end among them
  DiskState state_;
  std::optional<std::uint64_t> free_;  // as far as it is known
  bool stuck_ = false;                 // the first job found no room
  bool is_working_ = false;
  bool stopping_ = false;

  // The disk's thread alone.
  std::unique_ptr<RecordingFolder> folder_;
  FileDescriptor file_;
  std::string name_;          // of the series
  std::uint32_t number_ = 1;  // in it
  std::uint64_t written_ = 0;
  std::optional<std::chrono::steady_clock::time_point> removed_;  // when old files were looked for
  std::thread thread_;
};

}  // namespace skerry::server
