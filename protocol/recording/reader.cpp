#include "protocol/recording/reader.hpp"

#include <algorithm>

#include "protocol/recording/item_cursor.hpp"
#include "protocol/recording/open_recording.hpp"
#include "protocol/recording/packed_spokes.hpp"

namespace skerry::recording {
namespace {

struct Last {
  std::int64_t time = 0;  // ns since 1970
  std::vector<std::uint8_t> bytes;
};

// The last spoke of the message that is not after `until`.
std::optional<Last> last_of_packed(std::span<const std::uint8_t> message, std::int64_t until) {
  const auto unpacker = SpokeUnpacker::open(message);
  if (!unpacker) return std::nullopt;
  SpokeUnpacker& spokes = **unpacker;
  std::optional<Last> last;
  while (spokes.next() && spokes.time() <= until) {
    last.emplace(Last{spokes.time(), {spokes.bytes().begin(), spokes.bytes().end()}});
  }
  return last;
}

// The last item of the chunk that is not after `until`.
std::optional<Last> last_of(const ChunkData& chunk, std::int64_t until) {
  const auto entries = chunk.entries();
  auto after = std::upper_bound(
      entries.begin(), entries.end(), until,
      [](std::int64_t t, const ChunkData::Entry& entry) { return t < entry.time; });
  for (; after != entries.begin(); --after) {
    const ChunkData::Entry& entry = *std::prev(after);
    const auto bytes = chunk.bytes_of(entry);
    if (!chunk.kind_of(entry).packed) return Last{entry.time, {bytes.begin(), bytes.end()}};
    if (auto last = last_of_packed(bytes, until)) return last;
  }
  return std::nullopt;
}

}  // namespace

class RecordingReader::Impl {
 public:
  explicit Impl(std::shared_ptr<const OpenRecording> opened) : recording(std::move(opened)) {}
  std::shared_ptr<const OpenRecording> recording;
};

RecordingReader::RecordingReader(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader& RecordingReader::operator=(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

Result<RecordingReader, RecordingError> RecordingReader::open(const std::string& path,
                                                              const Progress& progress) {
  auto recording = open_recording(path, progress);
  if (!recording) return Failure{recording.error()};
  return RecordingReader(std::make_shared<const Impl>(std::move(recording.value())));
}

const Summary& RecordingReader::summary() const { return impl_->recording->summary; }

std::optional<wire::Hello> RecordingReader::hello() const {
  ItemCursor cursor = items({{Kind::hello}});
  while (const auto item = cursor.next()) {
    wire::Hello hello;
    if (hello.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      return hello;
    }
  }
  return std::nullopt;
}

ItemCursor RecordingReader::items(const std::vector<Topic>& topics) const {
  return ItemCursor(std::make_unique<ItemCursor::Impl>(
      impl_->recording, std::set<Topic>(topics.begin(), topics.end())));
}

std::optional<LastItem> RecordingReader::last_before(const Topic& topic, UtcTime time) const {
  const OpenRecording& recording = *impl_->recording;
  // Items later than kLatestTime get that time.
  const std::int64_t until =
      (time < kLatestTime ? time : UtcTime::max()).time_since_epoch().count();
  const std::set<Topic> topics{topic};
  std::optional<Last> last;
  const auto& by_start = recording.by_start;
  const auto later = std::upper_bound(by_start.begin(), by_start.end(), until,
                                      [&](std::int64_t t, std::uint32_t number) {
                                        return t < recording.index.chunks[number].start;
                                      });
  for (auto i = static_cast<std::size_t>(later - by_start.begin()); i-- > 0;) {
    // No item before this one is later than the last one known.
    if (last && recording.reaches[i] < last->time) break;
    const std::uint32_t number = by_start[i];
    if ((last && recording.reach(number) < last->time) || !recording.has(number, topics)) continue;
    const auto chunk = recording.chunk(number, topics);
    if (!chunk) continue;
    if (auto found = last_of(**chunk, until); found && (!last || found->time > last->time)) {
      last = std::move(found);
    }
  }
  if (!last) return std::nullopt;
  return LastItem{std::min(UtcTime(Duration(last->time)), kLatestTime), std::move(last->bytes)};
}

}  // namespace skerry::recording
