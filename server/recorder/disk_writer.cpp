#include "server/recorder/disk_writer.hpp"

#include <fcntl.h>
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

constexpr std::chrono::milliseconds kRetry{200};        // on a full disk
constexpr std::chrono::milliseconds kLookAround{1000};  // at free space while nothing is written
constexpr std::chrono::seconds kRemoveEvery{10};

// The file has no name any more; its space is free once it is closed.
bool is_removed(const FileDescriptor& file) {
  struct stat status {};
  return file.is_open() && ::fstat(file.get(), &status) == 0 && status.st_nlink == 0;
}

}  // namespace

DiskWriter::DiskWriter(const RecorderConfig& config)
    : config_(config), queue_(config.max_queue, config.reserve_bytes) {
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "recorder-disk");
    run();
  });
}

DiskWriter::~DiskWriter() { stop(); }

void DiskWriter::stop() {
  change(&DiskQueue::stop);
  if (thread_.joinable()) thread_.join();
}

DiskState DiskWriter::state() const {
  const std::lock_guard lock(mutex_);
  return queue_.state();
}

void DiskWriter::set_problem(const std::string& text, bool failed) {
  spdlog::log(failed ? spdlog::level::err : spdlog::level::warn, "recorder: {}", text);
  tell([&](DiskQueue& queue) { queue.problem(text, failed); });
}

void DiskWriter::run() {
  look_around();
  auto looked = std::chrono::steady_clock::now();
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      if (!queue_.can_work()) {
        if (queue_.is_over()) return;
        wake_.wait_for(lock, queue_.is_stuck() ? kRetry : kLookAround);
      }
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - looked >= (folder_ ? kRetry : kLookAround)) {
      looked = now;
      look_around();
    }
    std::optional<DiskJob> job = tell(&DiskQueue::start);
    if (!job) continue;
    const Outcome outcome = carry_out(*job);
    const bool removed = outcome == Outcome::no_room && is_removed(file_);
    const DiskQueue::After after =
        tell([&](DiskQueue& queue) { return queue.finish(std::move(*job), outcome, removed); });
    if (after == DiskQueue::After::no_file) {
      set_problem(config_.folder + ": the disk is full, so no file was made", false);
    } else if (after == DiskQueue::After::cut_file) {
      if (file_.is_open() && !removed) {
        set_problem(file_path() +
                        ": the disk is full, so the file has no end; `skerry recording repair` "
                        "makes one",
                    false);
      }
      file_.close();
    }
  }
}

DiskWriter::Outcome DiskWriter::carry_out(const DiskJob& job) {
  try {
    switch (job.kind) {
      case DiskJob::Kind::begin:
        folder_.reset();
        folder_ = std::make_unique<RecordingFolder>(config_.folder);
        number_ = 1;
        name_ = job.name;
        open_file(name_.empty());
        return Outcome::done;
      case DiskJob::Kind::next:
        if (!folder_) return Outcome::done;
        if (!job.waited) ++number_;
        open_file(true);
        return Outcome::done;
      case DiskJob::Kind::write:
        return file_.is_open() ? write(job.bytes) : Outcome::failed;
      case DiskJob::Kind::close:
        close_file();
        return Outcome::done;
      case DiskJob::Kind::end:
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
  tell([&](DiskQueue& queue) { queue.opened(made.name); });
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
      set_problem(file_path() + ": cannot be written: " + std::strerror(error), true);
      file_.close();
      return Outcome::failed;
    }
    done += static_cast<std::size_t>(size);
  }
  written_ += bytes.size();
  const bool more_waits = tell([&](DiskQueue& queue) {
    queue.wrote(bytes.size());
    return queue.write_follows();
  });
  return config_.sync == Sync::chunk && !more_waits ? sync_file() : Outcome::done;
}

DiskWriter::Outcome DiskWriter::sync_file() {
  if (!file_.is_open() || ::fdatasync(file_.get()) == 0) return Outcome::done;
  set_problem(file_path() + ": is not known to be on the disk: " + std::strerror(errno), true);
  file_.close();
  return Outcome::failed;
}

void DiskWriter::close_file() {
  if (config_.sync != Sync::none) sync_file();
  file_.close();
}

void DiskWriter::look_around() {
  if (folder_) return look_at_folder();
  const std::uint64_t free = free_bytes_at(config_.folder).value_or(0);
  tell([&](DiskQueue& queue) { queue.found_idle(free); });
}

void DiskWriter::look_at_folder() {
  const auto free = folder_->free_bytes();
  const DiskState state = this->state();
  if (file_.is_open() && !state.file_is_gone && !folder_->has(file_, state.file)) {
    set_problem(file_path() + ": was removed, renamed or replaced while it was being written",
                false);
    tell(&DiskQueue::file_gone);
  }
  tell([&](DiskQueue& queue) { queue.found_free(free); });
  const auto now = std::chrono::steady_clock::now();
  if (removed_ && now - *removed_ < kRemoveEvery) return;
  removed_ = now;
  for (const std::string& name :
       folder_->remove_old(config_.keep_bytes, config_.keep_time, state.file)) {
    spdlog::info("recorder: removed {}/{}, as older files are not kept", config_.folder, name);
  }
}

}  // namespace skerry::server
