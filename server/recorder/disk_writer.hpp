// DiskWriter: a DiskQueue with a thread that writes its jobs to files.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <type_traits>

#include "server/recorder/disk_queue.hpp"
#include "server/recorder/recorder_config.hpp"
#include "server/recorder/recording_folder.hpp"

namespace skerry::server {

// Thread: functions are the recorder's and never wait for the disk, except stop(); state(): any.
class DiskWriter {
 public:
  using Taken = server::Taken;

  // `config` is copied; its folder is absolute.
  explicit DiskWriter(const RecorderConfig& config);
  ~DiskWriter();  // stop()

  // Opens the folder and the first file of a series in it.
  void begin(const std::string& name) {
    change([&](DiskQueue& queue) { queue.begin(name); });
  }
  // Closes the present file and opens the next of the series.
  void next_file() { change(&DiskQueue::next_file); }
  void end() { change(&DiskQueue::end); }
  Taken take(std::span<const std::uint8_t> bytes, std::uint64_t spokes) {
    return change([&](DiskQueue& queue) { return queue.take(bytes, spokes); });
  }
  Taken take_end(std::span<const std::uint8_t> bytes) {
    return change([&](DiskQueue& queue) { return queue.take_end(bytes); });
  }

  DiskState state() const;
  // Does what was ordered, and ends the thread.
  void stop();

 private:
  using Outcome = DiskQueue::Outcome;

  template <typename Change>
  std::invoke_result_t<Change, DiskQueue&> tell(const Change& what) {
    const std::lock_guard lock(mutex_);
    return std::invoke(what, queue_);
  }
  // The same for the recorder, whose changes the thread wakes up for.
  template <typename Change>
  std::invoke_result_t<Change, DiskQueue&> change(const Change& what) {
    struct Wake {
      std::condition_variable& thread;
      ~Wake() { thread.notify_one(); }
    } wake{wake_};
    return tell(what);
  }

  void run();
  // The disk's thread, without the lock.
  Outcome carry_out(const DiskJob& job);
  Outcome write(const Bytes& bytes);
  void open_file(bool series);
  Outcome sync_file();
  void close_file();
  void look_around();     // at free space
  void look_at_folder();  // at free space and the file; removes old files
  void set_problem(const std::string& text, bool failed);
  std::string file_path() const { return config_.folder + "/" + state().file; }

  const RecorderConfig config_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  DiskQueue queue_;

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
