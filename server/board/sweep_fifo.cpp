#include "server/board/sweep_fifo.hpp"

namespace skerry::server {

bool SweepFifo::has_room(std::uint64_t samples) const {
  const std::lock_guard lock(mutex_);
  return has_room_locked(samples);
}

std::uint64_t SweepFifo::epoch() const {
  const std::lock_guard lock(mutex_);
  return epoch_;
}

bool SweepFifo::refuses(const board::SweepMeta& meta, std::uint64_t epoch) {
  const std::lock_guard lock(mutex_);
  return epoch == epoch_ && refuses_locked(meta);
}

bool SweepFifo::refuses_locked(const board::SweepMeta& meta) {
  if (has_room_locked(samples_of(meta))) return false;
  ++sequence_;
  for (std::size_t c = 0; c < 2; ++c) {
    if (meta.channels[c].samples != 0) ++counters_.overruns[c];
  }
  return true;
}

bool SweepFifo::put(const board::Sweep& sweep, std::uint64_t epoch) {
  const std::lock_guard lock(mutex_);
  if (epoch != epoch_) return true;
  if (refuses_locked(sweep.meta)) return false;
  const std::uint64_t sequence = sequence_++;
  Held held{{}, sequence, samples_of(sweep.meta)};
  if (!spare_.empty()) {
    held.record = std::move(spare_.back());
    spare_.pop_back();
    held.record.clear();
  }
  board::append_record(held.record, sequence, sweep);
  held_.push_back(std::move(held));
  samples_ += held_.back().samples;
  return true;
}

std::uint32_t SweepFifo::take(std::uint32_t count, std::size_t max_bytes, Bytes& out,
                              std::uint64_t& first_sequence) {
  std::uint32_t taken = 0;
  std::size_t bytes = 0;
  for (; taken < count; ++taken) {
    const std::lock_guard lock(mutex_);
    if (held_.empty()) {
      for (std::size_t c = 0; c < 2; ++c) {
        if (channels_[c]) counters_.underruns[c] += count - taken;
      }
      break;
    }
    Held& first = held_.front();
    bytes += first.record.size();
    if (bytes > max_bytes) break;
    if (taken == 0) first_sequence = first.sequence;
    out.insert(out.end(), first.record.begin(), first.record.end());
    samples_ -= first.samples;
    spare_.push_back(std::move(first.record));
    held_.pop_front();
  }
  return taken;
}

void SweepFifo::set_depth(std::uint32_t samples) {
  const std::lock_guard lock(mutex_);
  depth_ = samples;
}

void SweepFifo::set_channels(bool a, bool b) {
  const std::lock_guard lock(mutex_);
  channels_ = {a, b};
}

void SweepFifo::reset() {
  const std::lock_guard lock(mutex_);
  held_.clear();
  spare_.clear();
  samples_ = 0;
  counters_ = {};
  ++epoch_;
}

SweepFifo::Counters SweepFifo::counters() const {
  const std::lock_guard lock(mutex_);
  Counters counters = counters_;
  counters.level = static_cast<std::uint32_t>(held_.size());
  return counters;
}

}  // namespace skerry::server
