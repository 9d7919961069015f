#include "server/core/video_channel.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace skerry::server {

FormatRing::FormatRing(SectorEncoder encoder, std::size_t capacity, std::size_t max_bytes)
    : encoder_(std::move(encoder)),
      max_bytes_(max_bytes),
      capacity_(std::max<std::size_t>(capacity, 1)),
      slots_(capacity_ * kRecorderHolds) {}

FormatRing::FormatRing(std::size_t capacity, std::size_t max_bytes)
    : FormatRing(nullptr, capacity, max_bytes) {}

bool FormatRing::is_held(std::uint64_t sector) const {
  return published_ - sector <= slots_.size() && slots_[sector % slots_.size()].sector != nullptr;
}

EncodedSectorPtr FormatRing::take(Cursor& cursor, Overtaken jump) {
  // Most takes are of who has all: the lock is not theirs to wait for.
  if (cursor.next >= published_.load(std::memory_order_acquire)) return nullptr;
  const std::lock_guard lock(mutex_);
  const std::uint64_t held = jump == Overtaken::to_newest ? capacity_ : slots_.size();
  if (published_ - cursor.next > held || !is_held(cursor.next)) {
    const std::uint64_t newest = published_ - 1;
    const std::uint64_t first = published_ > slots_.size() ? published_ - slots_.size() : 0;
    cursor.next = jump == Overtaken::to_newest ? newest : std::max(cursor.next, first);
    while (cursor.next < newest && !is_held(cursor.next)) ++cursor.next;
  }
  const Slot& slot = slots_[cursor.next % slots_.size()];
  cursor.spokes_lost += slot.spokes_before - cursor.spokes_before;
  ++cursor.next;
  const bool newest = cursor.next == published_;
  cursor.spokes_before =
      newest ? published_spokes_ : slots_[cursor.next % slots_.size()].spokes_before;
  if (slot.sector == nullptr) cursor.spokes_lost += cursor.spokes_before - slot.spokes_before;
  return slot.sector;
}

Cursor FormatRing::cursor_at_end() const {
  joins_.fetch_add(1, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  return {.next = published_, .spokes_before = published_spokes_, .spokes_lost = 0};
}

FormatRing::Registration FormatRing::on_publish(std::function<void()> wake, Reader reader) {
  const std::lock_guard lock(wakes_mutex_);
  const auto position = wakes_.insert(wakes_.end(), std::move(wake));
  reader_count_.store(wakes_.size(), std::memory_order_relaxed);
  const bool is_recorder = reader == Reader::recorder;
  if (is_recorder) recorders_.fetch_add(1, std::memory_order_relaxed);
  return {this, [position, is_recorder](FormatRing* ring) {
            const std::lock_guard release_lock(ring->wakes_mutex_);
            ring->wakes_.erase(position);
            if (is_recorder) ring->recorders_.fetch_sub(1, std::memory_order_relaxed);
            ring->reader_count_.store(ring->wakes_.size(), std::memory_order_relaxed);
          }};
}

void FormatRing::publish(const Sector& sector) {
  publish(sector.spokes.size(), [&] { return encoder_(sector); });
}

void FormatRing::publish(std::uint64_t spokes, const std::function<EncodedSectorPtr()>& encode) {
  const std::lock_guard wakes_lock(wakes_mutex_);
  EncodedSectorPtr encoded;
  if (!wakes_.empty()) {
    encoded = encode();
    spokes_encoded_.fetch_add(spokes, std::memory_order_relaxed);
  }
  std::vector<EncodedSectorPtr> let_go;  // what was overwritten is freed outside the lock
  {
    const std::lock_guard lock(mutex_);
    Slot& slot = slots_[published_ % slots_.size()];
    if (slot.sector) held_bytes_ -= slot.sector->bytes.size();
    if (encoded) held_bytes_ += encoded->bytes.size();
    std::swap(slot.sector, encoded);
    slot.spokes_before = published_spokes_;
    ++published_;
    published_spokes_ += spokes;
    let_go = make_room();
  }
  for (const auto& wake : wakes_) wake();
}

std::vector<EncodedSectorPtr> FormatRing::make_room() {
  std::vector<EncodedSectorPtr> let_go;
  const std::size_t most =
      recorders_.load(std::memory_order_relaxed) > 0 ? slots_.size() : capacity_;
  const std::size_t most_bytes = max_bytes_.load(std::memory_order_relaxed);
  const std::uint64_t overwritten = published_ > slots_.size() ? published_ - slots_.size() : 0;
  oldest_ = std::max(oldest_, overwritten);
  for (; oldest_ + 1 < published_; ++oldest_) {
    if (published_ - oldest_ <= most && held_bytes_ <= most_bytes) break;
    EncodedSectorPtr& sector = slots_[oldest_ % slots_.size()].sector;
    if (!sector) continue;
    held_bytes_ -= sector->bytes.size();
    let_go.push_back(std::move(sector));
    sector = nullptr;
  }
  return let_go;
}

FormatRing& VideoChannel::add_format(const std::string& name, SectorEncoder encoder) {
  const auto [position, added] = formats_.try_emplace(name);
  if (!added) throw std::logic_error("the video channel already has a format '" + name + "'");
  position->second = std::make_unique<FormatRing>(std::move(encoder), ring_sectors_, max_bytes_);
  return *position->second;
}

FormatRing* VideoChannel::find_format(const std::string& name) {
  const auto found = formats_.find(name);
  return found == formats_.end() ? nullptr : found->second.get();
}

void VideoChannel::publish(const Sector& sector) {
  if (sector.spokes.empty()) return;
  for (const auto& [name, ring] : formats_) ring->publish(sector);
}

void VideoChannel::publish(const Sector& sector, const std::string& format,
                           const EncodedSectorPtr& encoded) {
  if (sector.spokes.empty()) return;
  for (const auto& [name, ring] : formats_) {
    if (name == format) {
      ring->publish(sector.spokes.size(), [&] { return encoded; });
    } else {
      ring->publish(sector);
    }
  }
}

std::map<std::string, std::uint64_t> VideoChannel::spokes_encoded() const {
  std::map<std::string, std::uint64_t> encoded;
  for (const auto& [name, ring] : formats_) encoded[name] = ring->spokes_encoded();
  return encoded;
}

void VideoChannel::hold(std::size_t max_bytes) {
  max_bytes_ = max_bytes;
  for (const auto& [name, ring] : formats_) ring->hold(max_bytes);
}

std::uint64_t VideoChannel::joins() const {
  std::uint64_t joins = 0;
  for (const auto& [name, ring] : formats_) joins += ring->joins();
  return joins;
}

}  // namespace skerry::server
