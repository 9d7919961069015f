#include "server/core/video_channel.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace skerry::server {

FormatRing::FormatRing(SectorEncoder encoder, std::size_t capacity)
    : encoder_(std::move(encoder)), slots_(std::max<std::size_t>(capacity, 1)) {}

EncodedSectorPtr FormatRing::take(Cursor& cursor) {
  const std::lock_guard lock(mutex_);
  if (cursor.next >= published_) return nullptr;
  const bool overtaken = published_ - cursor.next > slots_.size();
  if (overtaken || slots_[cursor.next % slots_.size()].sector == nullptr) {
    cursor.next = published_ - 1;
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
  const std::lock_guard lock(mutex_);
  return {.next = published_, .spokes_before = published_spokes_, .spokes_lost = 0};
}

FormatRing::Registration FormatRing::on_publish(std::function<void()> wake) {
  const std::lock_guard lock(wakes_mutex_);
  const auto position = wakes_.insert(wakes_.end(), std::move(wake));
  return {this, [position](FormatRing* ring) {
            const std::lock_guard release_lock(ring->wakes_mutex_);
            ring->wakes_.erase(position);
          }};
}

void FormatRing::publish(const Sector& sector) {
  const auto spokes = static_cast<std::uint64_t>(sector.spokes.size());
  const std::lock_guard wakes_lock(wakes_mutex_);
  EncodedSectorPtr encoded;
  if (!wakes_.empty()) {
    encoded = encoder_(sector);
    spokes_encoded_.fetch_add(spokes, std::memory_order_relaxed);
  }
  {
    const std::lock_guard lock(mutex_);
    Slot& slot = slots_[published_ % slots_.size()];
    std::swap(slot.sector, encoded);  // what was overwritten is freed outside the lock
    slot.spokes_before = published_spokes_;
    ++published_;
    published_spokes_ += spokes;
  }
  for (const auto& wake : wakes_) wake();
}

FormatRing& VideoChannel::add_format(const std::string& name, SectorEncoder encoder) {
  const auto [position, added] = formats_.try_emplace(name);
  if (!added) throw std::logic_error("the video channel already has a format '" + name + "'");
  position->second = std::make_unique<FormatRing>(std::move(encoder), ring_sectors_);
  return *position->second;
}

void VideoChannel::publish(const Sector& sector) {
  if (sector.spokes.empty()) return;
  for (const auto& [name, ring] : formats_) ring->publish(sector);
}

std::map<std::string, std::uint64_t> VideoChannel::spokes_encoded() const {
  std::map<std::string, std::uint64_t> encoded;
  for (const auto& [name, ring] : formats_) encoded[name] = ring->spokes_encoded();
  return encoded;
}

}  // namespace skerry::server
