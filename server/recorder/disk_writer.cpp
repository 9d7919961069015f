#include "server/recorder/disk_writer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <utility>

#include "server/recorder/file_names.hpp"

namespace skerry::server {
namespace {

constexpr std::chrono::milliseconds kRetry{200};        // of a full disk
constexpr std::chrono::milliseconds kLookAround{1000};  // at free space while nothing is written
constexpr std::chrono::seconds kRemoveEvery{10};
// Kept free beyond the reserve for what is yet to come of files: index, list, folder.
constexpr std::uint64_t kMargin = 1u << 20;

// It has no name any more, and its room is free once it is closed.
bool is_removed(const FileDescriptor& file) {
  struct stat status {};
  return file.is_open() && ::fstat(file.get(), &status) == 0 && status.st_nlink == 0;
}

}  // namespace

DiskWriter::DiskWriter(const RecorderConfig& config) : config_(config) {
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "recorder-disk");
    run();
  });
}

DiskWriter::~DiskWriter() { stop(); }

void DiskWriter::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void DiskWriter::order(Job job) {
  {
    const std::lock_guard lock(mutex_);
    queued_bytes_ += job.bytes.size();
    if (job.kind == Job::Kind::end) ++ends_queued_;
    if (job.kind == Job::Kind::begin) ++begins_queued_;
    jobs_.push_back(std::move(job));
  }
  wake_.notify_one();
}

void DiskWriter::begin(const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    forget();
  }
  order({Job::Kind::begin, name, {}, 0});
}

void DiskWriter::next_file() {
  order({Job::Kind::close, {}, {}, 0});
  order({Job::Kind::next, {}, {}, 0});
}

void DiskWriter::end() {
  order({Job::Kind::close, {}, {}, 0});
  order({Job::Kind::end, {}, {}, 0});
}

void DiskWriter::forget() {
  DiskState state;
  state.version = state_.version + 1;
  state.free_bytes = state_.free_bytes;
  state_ = std::move(state);
  free_.reset();
}

DiskWriter::Taken DiskWriter::take(std::span<const std::uint8_t> bytes, std::uint64_t spokes) {
  {
    const std::lock_guard lock(mutex_);
    if (state_.failed) return Taken::failed;
    const bool fits = queued_bytes_ + bytes.size() <= config_.max_queue;
    const bool has_room = !stuck_ && (!free_ || *free_ >= config_.reserve_bytes + kMargin +
                                                              queued_bytes_ + bytes.size());
    if (state_.is_full == has_room) {
      state_.is_full = !has_room;
      ++state_.version;
    }
    if (!has_room) return Taken::no_room;
    if (!fits) return Taken::too_slow;
  }
  order({Job::Kind::write, {}, Bytes(bytes.begin(), bytes.end()), spokes});
  return Taken::yes;
}

DiskWriter::Taken DiskWriter::take_end(std::span<const std::uint8_t> bytes) {
  if (state().failed) return Taken::failed;
  order({Job::Kind::write, {}, Bytes(bytes.begin(), bytes.end()), 0});
  return Taken::yes;
}

DiskState DiskWriter::state() const {
  const std::lock_guard lock(mutex_);
  DiskState state = state_;
  state.is_busy = is_working_ || !jobs_.empty();
  return state;
}

void DiskWriter::set_problem(const std::string& text, bool failed) {
  if (failed) {
    spdlog::error("recorder: {}", text);
  } else {
    spdlog::warn("recorder: {}", text);
  }
  const std::lock_guard lock(mutex_);
  if (begins_queued_ > 0) return;  // it was an earlier recording's
  state_.problem = text;
  state_.failed = failed;
  ++state_.version;
}

void DiskWriter::run() {
  look_at_disk();
  auto looked = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  for (;;) {
    const bool can_work = !jobs_.empty() && (!stuck_ || ends_queued_ > 0 || stopping_);
    if (!can_work) {
      if (stopping_ && jobs_.empty()) return;
      wake_.wait_for(lock, stuck_ ? kRetry : kLookAround);
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - looked >= (folder_ ? kRetry : kLookAround)) {
      looked = now;
      lock.unlock();
      if (folder_) {
        look_at_folder();
      } else {
        look_at_disk();
      }
      lock.lock();
    }
    if (jobs_.empty()) continue;
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    is_working_ = true;
    const bool failed = state_.failed && job.kind == Job::Kind::write;
    lock.unlock();
    const Outcome outcome = failed ? Outcome::failed : carry_out(job);
    lock.lock();
    is_working_ = false;
    const bool removed = outcome == Outcome::no_room && is_removed(file_);
    const bool gives_up =
        ends_queued_ > 0 || stopping_ || (job.kind == Job::Kind::write && removed);
    if (outcome == Outcome::no_room && !gives_up) {
      job.waited = true;
      if (!stuck_ || !state_.is_full) ++state_.version;
      stuck_ = state_.is_full = true;
      jobs_.push_front(std::move(job));
      continue;
    }
    stuck_ = false;
    queued_bytes_ -= job.bytes.size();
    if (job.kind == Job::Kind::end) --ends_queued_;
    if (outcome != Outcome::done) state_.spokes_lost += job.spokes;
    if (outcome == Outcome::no_room && job.kind != Job::Kind::write) {
      lock.unlock();
      set_problem(config_.folder + ": the disk is full, so no file was made", false);
      lock.lock();
    } else if (outcome == Outcome::no_room) {
      // Nothing may follow what is missing, as its place in the file would be another.
      lock.unlock();
      if (file_.is_open() && !removed) {
        set_problem(
            fmt::format("{}/{}: the disk is full, so the file has no end; `skerry recording "
                        "repair` makes one",
                        config_.folder, state().file),
            false);
      }
      file_.close();
      lock.lock();
    }
  }
}

DiskWriter::Outcome DiskWriter::carry_out(Job& job) {
  try {
    switch (job.kind) {
      case Job::Kind::begin: {
        const std::lock_guard lock(mutex_);
        if (!job.waited) {
          --begins_queued_;
          forget();
        }
      }
        folder_.reset();
        folder_ = std::make_unique<RecordingFolder>(config_.folder);
        number_ = 1;
        name_ = job.name;
        open_file(name_.empty());
        return Outcome::done;
      case Job::Kind::next:
        if (!folder_) return Outcome::done;
        if (!job.waited) ++number_;
        open_file(true);
        return Outcome::done;
      case Job::Kind::write:
        return file_.is_open() ? write(job.bytes) : Outcome::failed;
      case Job::Kind::close:
        close_file();
        return Outcome::done;
      case Job::Kind::end:
        folder_.reset();
        return Outcome::done;
    }
  } catch (const FolderError& error) {
    if (error.no_room) return Outcome::no_room;
    file_.close();
    folder_.reset();
    set_problem(error.what(), true);
  }
  return Outcome::failed;
}

void DiskWriter::open_file(bool series) {
  if (name_.empty()) {
    name_ = name_of_time(std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now()));
  }
  RecordingFolder::NewFile made = folder_->create(name_, number_, series);
  file_ = std::move(made.file);
  if (config_.sync != Sync::none) folder_->sync();
  written_ = 0;
  {
    const std::lock_guard lock(mutex_);
    state_.file = made.name;
    state_.file_bytes = 0;
    state_.file_is_gone = false;
    ++state_.version;
  }
  removed_ = {};
  look_at_folder();
}

DiskWriter::Outcome DiskWriter::write(const Bytes& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t size = ::pwrite(file_.get(), bytes.data() + done, bytes.size() - done,
                                  static_cast<off_t>(written_ + done));
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) {
      const int error = size < 0 ? errno : ENOSPC;
      // Only whole records stay.
      const bool cut = ::ftruncate(file_.get(), static_cast<off_t>(written_)) == 0;
      if (is_want_of_room(error) && cut) return Outcome::no_room;
      set_problem(fmt::format("{}/{}: cannot be written: {}", config_.folder, state().file,
                              std::strerror(error)),
                  true);
      file_.close();
      return Outcome::failed;
    }
    done += static_cast<std::size_t>(size);
  }
  written_ += bytes.size();
  bool more_waits = false;
  {
    const std::lock_guard lock(mutex_);
    more_waits = !jobs_.empty() && jobs_.front().kind == Job::Kind::write;
    state_.file_bytes = written_;
    state_.total_bytes += bytes.size();
    if (free_) *free_ -= std::min<std::uint64_t>(*free_, bytes.size());
  }
  return config_.sync == Sync::chunk && !more_waits ? sync_file() : Outcome::done;
}

DiskWriter::Outcome DiskWriter::sync_file() {
  if (!file_.is_open() || ::fdatasync(file_.get()) == 0) return Outcome::done;
  set_problem(fmt::format("{}/{}: is not known to be on the disk: {}", config_.folder, state().file,
                          std::strerror(errno)),
              true);
  file_.close();
  return Outcome::failed;
}

void DiskWriter::close_file() {
  if (config_.sync != Sync::none) sync_file();
  file_.close();
}

void DiskWriter::look_at_disk() {
  const auto free = free_bytes_at(config_.folder);
  const std::lock_guard lock(mutex_);
  state_.free_bytes = free.value_or(0);
}

void DiskWriter::look_at_folder() {
  const auto free = folder_->free_bytes();
  if (file_.is_open() && !state().file_is_gone && !folder_->has(file_, state().file)) {
    set_problem(fmt::format("{}/{}: was removed, renamed or replaced while it was being written",
                            config_.folder, state().file),
                false);
    const std::lock_guard lock(mutex_);
    state_.file_is_gone = true;
  }
  std::string present;
  {
    const std::lock_guard lock(mutex_);
    free_ = free;
    state_.free_bytes = free.value_or(0);
    present = state_.file;
  }
  const auto now = std::chrono::steady_clock::now();
  if (removed_ && now - *removed_ < kRemoveEvery) return;
  removed_ = now;
  for (const std::string& name :
       folder_->remove_old(config_.keep_bytes, config_.keep_time, present)) {
    spdlog::info("recorder: removed {}/{}, as older files are not kept", config_.folder, name);
  }
}

}  // namespace skerry::server
