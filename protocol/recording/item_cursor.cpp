#include "protocol/recording/item_cursor.hpp"

#include <algorithm>
#include <tuple>

namespace skerry::recording {
namespace {

UtcTime utc_of(std::int64_t ns) { return UtcTime(Duration(ns)); }

}  // namespace

ItemCursor::Impl::Impl(std::shared_ptr<const OpenRecording> recording, std::set<Topic> topics)
    : recording_(std::move(recording)), topics_(std::move(topics)) {}

void ItemCursor::Impl::seek(std::int64_t time) {
  heap_.clear();
  given_ = {};
  open_bytes_ = 0;
  not_before_ = time;
  next_chunk_ = recording_->first_reaching(time);
}

// The one whose item comes last of all stands at the heap's bottom.
bool ItemCursor::Impl::later(const Source& a, const Source& b) {
  return std::tie(a.time, a.chunk->number, a.offset) > std::tie(b.time, b.chunk->number, b.offset);
}

void ItemCursor::Impl::push(Source source) {
  heap_.push_back(std::move(source));
  std::push_heap(heap_.begin(), heap_.end(), later);
}

void ItemCursor::Impl::release(const std::shared_ptr<OpenChunk>& chunk) {
  if (--chunk->sources == 0) open_bytes_ -= chunk->data->memory();
}

void ItemCursor::Impl::open_next_chunk() {
  const std::uint32_t number = recording_->by_start[next_chunk_++];
  if (recording_->reach(number) < not_before_ || !recording_->has(number, topics_)) return;
  auto data = recording_->chunk(number, topics_);
  if (!data) {
    ++damaged_;
    damage_ = data.error();
    return;
  }
  if ((*data)->entries().empty()) return;
  auto chunk = std::make_shared<OpenChunk>();
  chunk->data = *std::move(data);
  chunk->number = number;
  open_bytes_ += chunk->data->memory();
  const auto entries = chunk->data->entries();
  // Packed spokes may be later than their message.
  const std::int64_t from = not_before_ - std::min(not_before_, recording_->packed_span);
  const auto first = std::lower_bound(
      entries.begin(), entries.end(), from,
      [](const ChunkData::Entry& entry, std::int64_t time) { return entry.time < time; });
  chunk->sources = 1;
  continue_chunk(chunk, static_cast<std::size_t>(first - entries.begin()));
}

void ItemCursor::Impl::continue_chunk(const std::shared_ptr<OpenChunk>& chunk, std::size_t entry) {
  const auto entries = chunk->data->entries();
  if (entry >= entries.size()) return release(chunk);
  push({entries[entry].time, entries[entry].offset, entry, chunk});
}

// Opens the chunks that may hold what comes next.
void ItemCursor::Impl::open_chunks() {
  const auto& by_start = recording_->by_start;
  while (next_chunk_ < by_start.size()) {
    const ChunkPlace& place = recording_->index.chunks[by_start[next_chunk_]];
    if (!heap_.empty() &&
        (heap_.front().time < place.start || open_bytes_ + place.uncompressed > kMaxOpenBytes)) {
      return;
    }
    open_next_chunk();
  }
}

std::optional<Item> ItemCursor::Impl::next() {
  if (given_) {
    const Source source = *std::exchange(given_, std::nullopt);
    continue_chunk(source.chunk, source.entry + 1);
  }
  while (true) {
    open_chunks();
    if (heap_.empty()) return std::nullopt;
    std::pop_heap(heap_.begin(), heap_.end(), later);
    Source source = std::move(heap_.back());
    heap_.pop_back();
    const ChunkData& data = *source.chunk->data;
    const ChunkData::Entry& entry = data.entries()[source.entry];
    const ChannelKind& kind = data.kind_of(entry);
    if (kind.packed || source.time < not_before_) {
      continue_chunk(source.chunk, source.entry + 1);
      continue;
    }
    const Item item{kind.topic, utc_of(entry.time), data.bytes_of(entry)};
    given_ = std::move(source);
    return item;
  }
}

ItemCursor::ItemCursor(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ItemCursor::ItemCursor(ItemCursor&&) noexcept = default;
ItemCursor& ItemCursor::operator=(ItemCursor&&) noexcept = default;
ItemCursor::~ItemCursor() = default;

std::optional<Item> ItemCursor::next() { return impl_->next(); }
void ItemCursor::seek(UtcTime time) { impl_->seek(time.time_since_epoch().count()); }
std::uint64_t ItemCursor::chunks_damaged() const { return impl_->chunks_damaged(); }
std::optional<RecordingError> ItemCursor::damage() const { return impl_->damage(); }

}  // namespace skerry::recording
