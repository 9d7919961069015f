#include "protocol/recording/item_cursor.hpp"

#include <fmt/format.h>

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
  return std::tie(a.time, a.chunk_number, a.offset) > std::tie(b.time, b.chunk_number, b.offset);
}

void ItemCursor::Impl::push(Source source) {
  heap_.push_back(std::move(source));
  std::push_heap(heap_.begin(), heap_.end(), later);
}

void ItemCursor::Impl::note(std::uint32_t chunk_number, RecordingError damage) {
  damaged_chunks_.insert(chunk_number);
  damage_ = std::move(damage);
}

void ItemCursor::Impl::note(std::uint32_t chunk_number, std::uint32_t offset,
                            const std::string& text) {
  note(chunk_number,
       recording_->file.error(recording_->index.chunks[chunk_number].offset,
                              fmt::format("{} octets into the chunk: {}", offset, text)));
}

void ItemCursor::Impl::open_next_chunk() {
  const std::uint32_t number = recording_->by_start[next_chunk_++];
  if (recording_->reach(number) < not_before_ || !recording_->has(number, topics_)) return;
  auto data = recording_->chunk(number, topics_);
  if (!data) return note(number, data.error());
  auto chunk = std::make_shared<OpenChunk>();
  chunk->data = *std::move(data);
  chunk->number = number;
  open_bytes_ += chunk->data->memory();
  // Packed spokes may be later than their message.
  const std::int64_t from =
      not_before_ > 0 ? not_before_ - std::min(not_before_, recording_->packed_span) : 0;
  const auto entries = chunk->data->entries();
  const auto first = std::lower_bound(
      entries.begin(), entries.end(), from,
      [](const ChunkData::Entry& entry, std::int64_t time) { return entry.time < time; });
  continue_chunk(chunk, static_cast<std::size_t>(first - entries.begin()));
}

void ItemCursor::Impl::continue_chunk(std::shared_ptr<OpenChunk> chunk, std::size_t entry) {
  const auto entries = chunk->data->entries();
  if (entry >= entries.size()) {
    open_bytes_ -= chunk->data->memory();
    return;
  }
  const std::uint32_t number = chunk->number;
  push({entries[entry].time, number, entries[entry].offset, std::move(chunk), entry, nullptr, {}});
}

void ItemCursor::Impl::open_packed(const Source& message) {
  const ChunkData& data = *message.chunk->data;
  const ChunkData::Entry& entry = data.entries()[message.entry];
  const auto fail = [&](const std::string& text) {
    note(message.chunk_number, entry.offset, text);
  };
  if (open_bytes_ + entry.size > kMaxOpenBytes) return fail("too many packed messages at a time");
  auto unpacker = SpokeUnpacker::open(data.bytes_of(entry));
  if (!unpacker) return fail(unpacker.error());
  Source source{entry.time,
                message.chunk_number,
                entry.offset,
                nullptr,
                0,
                std::move(unpacker.value()),
                data.kind_of(entry).topic};
  open_bytes_ += source.packed->memory();
  continue_packed(std::move(source));
}

void ItemCursor::Impl::continue_packed(Source source) {
  // Those before what is sought are passed over here, not by way of the heap.
  while (source.packed->next()) {
    if (source.packed->time() < std::max(not_before_, source.time)) continue;
    source.time = source.packed->time();
    return push(std::move(source));
  }
  open_bytes_ -= source.packed->memory();
  if (source.packed->broken()) {
    note(source.chunk_number, source.offset, "the packed spokes cannot be read");
  }
}

void ItemCursor::Impl::go_on(Source given) {
  if (given.packed) {
    continue_packed(std::move(given));
  } else {
    continue_chunk(std::move(given.chunk), given.entry + 1);
  }
}

std::uint64_t ItemCursor::Impl::bytes_damaged() const {
  std::uint64_t bytes = 0;
  for (const std::uint32_t number : damaged_chunks_)
    bytes += recording_->index.chunks[number].length;
  return bytes;
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
  if (given_) go_on(*std::exchange(given_, std::nullopt));
  while (true) {
    open_chunks();
    if (heap_.empty()) return std::nullopt;
    std::pop_heap(heap_.begin(), heap_.end(), later);
    given_ = std::move(heap_.back());
    heap_.pop_back();
    if (given_->packed) return Item{given_->topic, utc_of(given_->time), given_->packed->bytes()};
    const ChunkData& data = *given_->chunk->data;
    const ChunkData::Entry& entry = data.entries()[given_->entry];
    const ChannelKind& kind = data.kind_of(entry);
    if (!kind.packed && entry.time >= not_before_) {
      return Item{kind.topic, utc_of(entry.time), data.bytes_of(entry)};
    }
    if (kind.packed) open_packed(*given_);
    go_on(*std::exchange(given_, std::nullopt));
  }
}

ItemCursor::ItemCursor(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ItemCursor::ItemCursor(ItemCursor&&) noexcept = default;
ItemCursor& ItemCursor::operator=(ItemCursor&&) noexcept = default;
ItemCursor::~ItemCursor() = default;

std::optional<Item> ItemCursor::next() {
  auto item = impl_->next();
  if (item) item->time = std::clamp(item->time, UtcTime(), kLatestTime);
  return item;
}
void ItemCursor::seek(UtcTime time) { impl_->seek(time.time_since_epoch().count()); }
std::uint64_t ItemCursor::chunks_damaged() const { return impl_->chunks_damaged(); }
std::optional<RecordingError> ItemCursor::damage() const { return impl_->damage(); }

}  // namespace skerry::recording
