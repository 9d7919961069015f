// The summary of an open recording.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/recording/file_builder.hpp"
#include "protocol/recording/open_recording.hpp"
#include "protocol/recording/packed_spokes.hpp"
#include "protocol/recording/recording.pb.h"

namespace skerry::recording {
namespace {

// Octets of an event that may be a mark: names have at most 100.
constexpr std::size_t kMaxMarkBytes = 1024;
// Octets of a Contents; where it has more the chunks are counted.
constexpr std::size_t kMaxContents = 8 << 20;

UtcTime clamped_utc(std::uint64_t ns) { return UtcTime(Duration(time_of(ns))); }

void note(Summary& summary, RecordingError damage) {
  if (!summary.damage) summary.damage = std::move(damage);
}

// The attachments that can be read; the Contents is told apart, and only the first one counts.
std::optional<Contents> read_attachments(OpenRecording& recording) {
  std::optional<Contents> contents;
  bool contents_seen = false;
  std::size_t held = 0;
  Bytes bytes;
  for (const RecordPlace& place : recording.index.attachments) {
    if (place.length > kMaxAttachment + kMaxRecord) continue;
    std::optional<mcap::Attachment> read;
    if (recording.file.read_all(place.content, static_cast<std::size_t>(place.length), bytes)) {
      read = mcap::read_attachment(bytes);
    }
    if (!read) {
      note(recording.summary,
           recording.file.error(place.offset, "the attachment's checksum is wrong"));
      continue;
    }
    const auto* data = reinterpret_cast<const char*>(read->data.data());
    if (read->name == kContentsName && read->media_type == kContentsType) {
      if (std::exchange(contents_seen, true) || read->data.size() > kMaxContents) continue;
      Contents message;
      if (message.ParseFromArray(data, static_cast<int>(read->data.size()))) {
        contents = std::move(message);
      }
      continue;
    }
    if (held + read->data.size() > kMaxAttachment) continue;
    held += read->data.size();
    recording.summary.attachments.push_back({read->name, read->media_type, clamped_utc(read->time),
                                             std::string(data, read->data.size())});
  }
  return contents;
}

void take(const Contents& contents, Summary& summary) {
  for (const Contents::Topic& topic : contents.topics()) {
    if (const auto kind = channel_named(topic.name())) summary.items[kind->topic] += topic.items();
  }
  for (const Contents::Mark& mark : contents.marks()) {
    if (summary.marks.size() >= kMaxMarks) break;
    summary.marks.push_back({clamped_utc(mark.utc_ns()), mark.name(), mark.kind()});
  }
  summary.begin = clamped_utc(contents.begin_utc_ns());
  summary.end = std::max(clamped_utc(contents.end_utc_ns()), summary.begin);
}

// Without Contents: numbers from the index, and marks and what is packed from the chunks
// themselves.
class Counting {
 public:
  Counting(OpenRecording& recording, const RecordingReader::Progress& progress)
      : recording_(recording), summary_(recording.summary), progress_(progress) {}

  // Error: given up.
  std::optional<RecordingError> run() {
    const FileIndex& index = recording_.index;
    for (const auto& [id, kind] : index.channels) {
      if (kind.packed || kind.topic.kind == Kind::event) to_read_.insert(kind.topic);
    }
    for (const auto& [id, kind] : index.channels) {
      const auto messages = index.messages.find(id);
      if (messages != index.messages.end() && !to_read_.contains(kind.topic)) {
        summary_.items[kind.topic] += messages->second;
      }
    }
    if (index.chunks.empty()) return std::nullopt;
    summary_.begin = clamped_utc(start_of(recording_.by_start.front()));
    for (const ChunkPlace& chunk : index.chunks) end_ = std::max(end_, chunk.end);
    std::uint64_t read = 0;
    for (std::size_t number = 0; number < index.chunks.size() && !to_read_.empty(); ++number) {
      if (!recording_.has(number, to_read_)) continue;
      take_chunk(number);
      if (progress_ && ++read % 16 == 0 &&
          !progress_(static_cast<double>(number) / static_cast<double>(index.chunks.size()))) {
        return recording_.file.error(index.chunks[number].offset, "given up");
      }
    }
    summary_.end = clamped_utc(static_cast<std::uint64_t>(end_));
    return std::nullopt;
  }

 private:
  std::uint64_t start_of(std::size_t number) const {
    return static_cast<std::uint64_t>(recording_.index.chunks[number].start);
  }

  void take_chunk(std::size_t number) {
    const auto chunk = recording_.chunk(number, to_read_);
    if (!chunk) return note(summary_, chunk.error());
    for (const ChunkData::Entry& entry : (*chunk)->entries()) {
      const ChannelKind& kind = (*chunk)->kind_of(entry);
      const auto bytes = (*chunk)->bytes_of(entry);
      summary_.items[kind.topic] += kind.packed ? packed_count(bytes) : 1;
      // Only the last of them are unpacked: they may reach beyond all other items.
      if (kind.packed && recording_.reach(number) > end_) take_end(bytes);
      if (kind.topic.kind == Kind::event) take_mark(entry.time, bytes);
    }
  }

  void take_end(std::span<const std::uint8_t> packed) {
    const auto unpacker = SpokeUnpacker::open(packed);
    while (unpacker && (*unpacker)->next()) end_ = std::max(end_, (*unpacker)->time());
  }

  void take_mark(std::int64_t time, std::span<const std::uint8_t> bytes) {
    Event event;
    if (summary_.marks.size() < kMaxMarks && bytes.size() <= kMaxMarkBytes &&
        event.ParseFromArray(bytes.data(), static_cast<int>(bytes.size())) &&
        event.kind() == Event::MARK) {
      summary_.marks.push_back(
          {clamped_utc(static_cast<std::uint64_t>(time)), event.text(), event.mark_kind()});
    }
  }

  OpenRecording& recording_;
  Summary& summary_;
  const RecordingReader::Progress& progress_;
  std::set<Topic> to_read_;
  std::int64_t end_ = 0;  // ns since 1970
};

std::string compression_name(const OpenRecording& recording) {
  Bytes bytes;
  const ChunkPlace& first = recording.index.chunks.front();
  const std::size_t size = mcap::kChunkHead + mcap::kMaxCompressionName;
  if (!recording.file.read_all(first.offset, std::min<std::size_t>(size, first.length), bytes)) {
    return "none";
  }
  const auto head =
      mcap::read_chunk_head(std::span<const std::uint8_t>(bytes).subspan(mcap::kRecordHead));
  return head && !head->first.compression.empty() ? head->first.compression : "none";
}

}  // namespace

std::optional<RecordingError> summarise(OpenRecording& recording,
                                        const RecordingReader::Progress& progress) {
  Summary& summary = recording.summary;
  const FileIndex& index = recording.index;
  summary.file = recording.file.path();
  summary.file_bytes = recording.file.size();
  summary.damage = index.damage;
  summary.chunks = index.chunks.size();
  for (const ChunkPlace& chunk : index.chunks) summary.uncompressed_bytes += chunk.uncompressed;
  summary.compact = recording.packed_span > 0;
  summary.compression = index.chunks.empty() ? "none" : compression_name(recording);
  const auto contents = read_attachments(recording);
  if (contents && index.whole) {
    take(*contents, summary);
  } else if (auto error = Counting(recording, progress).run()) {
    return error;
  }
  std::stable_sort(summary.marks.begin(), summary.marks.end(),
                   [](const Mark& a, const Mark& b) { return a.time < b.time; });
  return std::nullopt;
}

}  // namespace skerry::recording
