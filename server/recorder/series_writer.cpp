#include "server/recorder/series_writer.hpp"

#include <utility>

namespace skerry::server {
namespace {

using recording::Event;
using recording::Item;
using recording::Kind;

constexpr std::size_t kItemHead = 31;  // octets of an MCAP message besides its data

recording::WriterOptions options_of(const RecorderConfig& config) {
  recording::WriterOptions options;
  options.compression = config.compression;
  options.compact = config.compact;
  // Chunks are ended here, so that it is known what is in each; the writer's own bounds are beyond.
  options.chunk_bytes = 4 * SeriesWriter::kChunkBytes;
  options.chunk_time = std::chrono::hours(24 * 3650);
  return options;
}

}  // namespace

SeriesWriter::SeriesWriter(const RecorderConfig& config, DiskWriter& disk, Additions additions)
    : config_(config), disk_(disk), additions_(std::move(additions)) {}

void SeriesWriter::begin(const std::string& name, Steady now) {
  now_ = now;
  left_.clear();
  lost_told_ = 0;
  disk_.begin(name);
  open_file();
}

void SeriesWriter::open_file() {
  file_begun_ = now_;
  always_ = true;
  writer_.emplace([this](std::span<const std::uint8_t> bytes) { return take(bytes); },
                  options_of(config_));
  additions_.file_begins();
  flush();
  always_ = false;
}

bool SeriesWriter::take(std::span<const std::uint8_t> bytes) {
  std::uint64_t spokes = 0;
  for (const auto& [view, count] : chunk_spokes_) spokes += count;
  taken_ = always_ ? disk_.take_end(bytes) : disk_.take(bytes, spokes);
  return taken_ == DiskWriter::Taken::yes;
}

void SeriesWriter::prepare_chunk() {
  if (in_chunk_ || preparing_) return;
  preparing_ = in_chunk_ = true;
  chunk_begun_ = now_;
  for (const Kept& kept : kept_) note(kept.item());
  for (const auto& [view, missing] : missing_) {
    Event event;
    event.set_kind(missing.disk_was_full ? Event::DISK_FULL : Event::LOST);
    event.set_radar(view.first);
    event.set_view(view.second);
    event.set_count(missing.spokes);
    event.set_text(missing.disk_was_full ? "the disk was full" : "the disk was too slow");
    note_event(event);
  }
  // The disk does not know which radar they belong to.
  const std::uint64_t lost = disk_.state().spokes_lost;
  if (lost > lost_told_) {
    Event event;
    event.set_kind(Event::DISK_FULL);
    event.set_count(lost - lost_told_);
    event.set_text("the disk was full after they were taken");
    note_event(event);
  }
  lost_in_chunk_ = lost;
  preparing_ = false;
}

void SeriesWriter::note_event(const Event& event) {
  const std::string bytes = event.SerializeAsString();
  note({{Kind::event},
        now_utc_,
        {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}});
}

void SeriesWriter::note(const Item& item) {
  writer_->add(item);
  chunk_bytes_ += item.bytes.size() + kItemHead;
}

void SeriesWriter::add(const Item& item) {
  prepare_chunk();
  note(item);
  if (chunk_bytes_ >= kChunkBytes) flush();
}

void SeriesWriter::keep(const Item& item, std::size_t most) {
  prepare_chunk();
  if (kept_.size() < most) {
    kept_.push_back({item.topic, item.time, Bytes(item.bytes.begin(), item.bytes.end())});
  }
  add(item);
}

void SeriesWriter::add_spoke(const recording::Topic& topic, UtcTime time,
                             std::span<const std::uint8_t> bytes) {
  prepare_chunk();
  ++spokes_;
  ++chunk_spokes_[{topic.radar, topic.view}];
  now_utc_ = time;
  add({topic, time, bytes});
}

void SeriesWriter::attach(const recording::Attachment& attachment) { writer_->attach(attachment); }

bool SeriesWriter::flush() {
  if (!in_chunk_ || ending_) return true;
  ending_ = true;
  additions_.chunk_ends();
  const bool taken = writer_->flush();
  if (taken) {
    kept_.clear();
    missing_.clear();
    lost_told_ = lost_in_chunk_;
  } else {
    const bool disk_was_full = taken_ == DiskWriter::Taken::no_room;
    for (const auto& [view, count] : chunk_spokes_) {
      Missing& missing = missing_[view];
      missing.spokes += count;
      missing.disk_was_full = missing.disk_was_full || disk_was_full;
      dropped_ += count;
    }
  }
  chunk_spokes_.clear();
  chunk_bytes_ = 0;
  in_chunk_ = ending_ = false;
  if (!taken) additions_.chunk_lost();
  return taken;
}

void SeriesWriter::look_at_clock(Steady now, UtcTime now_utc) {
  now_ = now;
  now_utc_ = now_utc;
  if (in_chunk_ && now - chunk_begun_ >= kChunkTime) flush();
  if (!in_chunk_ && now - chunk_begun_ >= kQuietTime) {
    prepare_chunk();
    additions_.quiet();
    flush();
  }
  const bool large = config_.roll_bytes > 0 && writer_->counts().bytes >= config_.roll_bytes;
  const bool long_enough = config_.roll_time.count() > 0 && now - file_begun_ >= config_.roll_time;
  const DiskState disk = disk_.state();
  if (disk.file == left_) return;  // not opened yet: files do not queue up
  const bool is_gone = now - file_begun_ >= kGoneAfter && disk.file_is_gone;
  // A chunk that finds no room here finds none in the next file either, unless a removed file makes
  // room.
  if (!is_gone && ((!large && !long_enough) || disk.is_full || !flush())) return;
  if (is_gone) flush();
  left_ = disk.file;
  always_ = true;
  writer_->finish();
  always_ = false;
  disk_.next_file();
  open_file();
}

void SeriesWriter::end(UtcTime now_utc) {
  now_utc_ = now_utc;
  const bool flushed = flush();
  always_ = true;
  if (!flushed) {
    prepare_chunk();  // marks, and what is missing
    flush();
  }
  writer_->finish();
  always_ = false;
  disk_.end();
}

}  // namespace skerry::server
