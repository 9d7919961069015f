#include "server/recorder/disk_queue.hpp"

#include <algorithm>
#include <utility>

namespace skerry::server {

void DiskQueue::order(DiskJob job) {
  queued_bytes_ += job.bytes.size();
  begins_queued_ += job.kind == DiskJob::Kind::begin;
  ends_queued_ += job.kind == DiskJob::Kind::end;
  jobs_.push_back(std::move(job));
}

void DiskQueue::begin(const std::string& name) {
  forget();
  order({.kind = DiskJob::Kind::begin, .name = name});
}

void DiskQueue::next_file() {
  order({.kind = DiskJob::Kind::close});
  order({.kind = DiskJob::Kind::next});
}

void DiskQueue::end() {
  order({.kind = DiskJob::Kind::close});
  order({.kind = DiskJob::Kind::end});
}

// The state of an earlier recording.
void DiskQueue::forget() {
  DiskState state;
  state.version = state_.version + 1;
  state.free_bytes = state_.free_bytes;
  state_ = std::move(state);
  free_.reset();
}

Taken DiskQueue::take(std::span<const std::uint8_t> bytes, std::uint64_t spokes) {
  if (state_.failed) return Taken::failed;
  const std::size_t waits = queued_bytes_ + bytes.size();
  const bool has_room = !stuck_ && (!free_ || *free_ >= reserve_bytes_ + kMargin + waits);
  if (state_.is_full == has_room) {
    state_.is_full = !has_room;
    ++state_.version;
  }
  if (!has_room) return Taken::no_room;
  if (waits > max_queue_) return Taken::too_slow;
  order({.bytes = Bytes(bytes.begin(), bytes.end()), .spokes = spokes});
  return Taken::yes;
}

Taken DiskQueue::take_end(std::span<const std::uint8_t> bytes) {
  if (state_.failed) return Taken::failed;
  order({.bytes = Bytes(bytes.begin(), bytes.end())});
  return Taken::yes;
}

DiskState DiskQueue::state() const {
  DiskState state = state_;
  state.is_busy = is_working_ || !jobs_.empty();
  return state;
}

std::optional<DiskJob> DiskQueue::start() {
  if (jobs_.empty()) return std::nullopt;
  DiskJob job = std::move(jobs_.front());
  jobs_.pop_front();
  is_working_ = true;
  if (job.kind == DiskJob::Kind::begin && !job.waited) {
    --begins_queued_;
    forget();
  }
  return job;
}

DiskQueue::After DiskQueue::finish(DiskJob job, Outcome outcome, bool file_removed) {
  is_working_ = false;
  const bool is_write = job.kind == DiskJob::Kind::write;
  if (outcome == Outcome::no_room && !gives_up() && !(is_write && file_removed)) {
    job.waited = true;
    if (!stuck_ || !state_.is_full) ++state_.version;
    stuck_ = state_.is_full = true;
    jobs_.push_front(std::move(job));
    return After::go_on;
  }
  stuck_ = false;
  queued_bytes_ -= job.bytes.size();
  ends_queued_ -= job.kind == DiskJob::Kind::end;
  if (outcome != Outcome::done) state_.spokes_lost += job.spokes;
  if (outcome != Outcome::no_room) return After::go_on;
  return is_write ? After::cut_file : After::no_file;
}

void DiskQueue::opened(const std::string& file) {
  state_.file = file;
  state_.file_bytes = 0;
  state_.file_is_gone = false;
  ++state_.version;
}

void DiskQueue::wrote(std::size_t bytes) {
  state_.file_bytes += bytes;
  state_.total_bytes += bytes;
  if (free_) *free_ -= std::min<std::uint64_t>(*free_, bytes);
}

void DiskQueue::found_free(std::optional<std::uint64_t> bytes) {
  free_ = bytes;
  state_.free_bytes = bytes.value_or(0);
}

void DiskQueue::problem(const std::string& text, bool failed) {
  if (begins_queued_ > 0) return;
  state_.problem = text;
  state_.failed = failed;
  ++state_.version;
}

}  // namespace skerry::server
