// The summary of an open recording.
#include <fmt/format.h>

#include <algorithm>

#include "protocol/recording/file_builder.hpp"
#include "protocol/recording/item_cursor.hpp"
#include "protocol/recording/open_recording.hpp"
#include "protocol/recording/recording.pb.h"

namespace skerry::recording {
namespace {

UtcTime utc_of(std::uint64_t ns) { return UtcTime(Duration(time_of(ns))); }

void note(Summary& summary, RecordingError damage) {
  if (!summary.damage) summary.damage = std::move(damage);
}

// The attachments that can be read; the Contents is told apart.
std::optional<Contents> read_attachments(OpenRecording& recording) {
  std::optional<Contents> contents;
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
      Contents message;
      if (message.ParseFromArray(data, static_cast<int>(read->data.size()))) contents = message;
      continue;
    }
    if (held + read->data.size() > kMaxAttachment) continue;
    held += read->data.size();
    recording.summary.attachments.push_back(
        {read->name, read->media_type, utc_of(read->time), std::string(data, read->data.size())});
  }
  return contents;
}

void take(const Contents& contents, Summary& summary) {
  for (const Contents::Topic& topic : contents.topics()) {
    if (const auto kind = channel_named(topic.name())) summary.items[kind->topic] += topic.items();
  }
  for (const Contents::Mark& mark : contents.marks()) {
    if (summary.marks.size() >= kMaxMarks) break;
    summary.marks.push_back({utc_of(mark.utc_ns()), mark.name()});
  }
  summary.begin = utc_of(contents.begin_utc_ns());
  summary.end = std::max(utc_of(contents.end_utc_ns()), summary.begin);
}

// Without Contents: numbers from the index, marks and what is packed from the chunks themselves.
std::optional<RecordingError> count(std::shared_ptr<OpenRecording> recording,
                                    const RecordingReader::Progress& progress) {
  Summary& summary = recording->summary;
  std::set<Topic> to_read{{Kind::event}};
  for (const auto& [id, kind] : recording->index.channels) {
    if (kind.packed) {
      to_read.insert(kind.topic);
    }
  }
  for (const auto& [id, kind] : recording->index.channels) {
    const auto messages = recording->index.messages.find(id);
    if (messages == recording->index.messages.end() || to_read.contains(kind.topic)) continue;
    summary.items[kind.topic] += messages->second;
  }
  const auto& chunks = recording->index.chunks;
  if (chunks.empty()) return std::nullopt;
  summary.begin = utc_of(static_cast<std::uint64_t>(chunks[recording->by_start.front()].start));
  for (const ChunkPlace& chunk : chunks) {
    summary.end = std::max(summary.end, utc_of(static_cast<std::uint64_t>(chunk.end)));
  }

  ItemCursor::Impl cursor(recording, to_read);
  std::uint64_t read = 0;
  const double length = std::max(in_seconds(summary.end - summary.begin), 1e-9);
  while (const auto item = cursor.next()) {
    if (progress && ++read % 4096 == 0 &&
        !progress(std::clamp(in_seconds(item->time - summary.begin) / length, 0.0, 1.0))) {
      return recording->file.error(0, "given up");
    }
    ++summary.items[item->topic];
    summary.end = std::max(summary.end, item->time);
    if (item->topic.kind != Kind::event || summary.marks.size() >= kMaxMarks) continue;
    Event event;
    if (event.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())) &&
        event.kind() == Event::MARK) {
      summary.marks.push_back({item->time, event.text()});
    }
  }
  if (cursor.damage()) note(summary, *cursor.damage());
  return std::nullopt;
}

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

std::optional<RecordingError> summarise(const std::shared_ptr<OpenRecording>& recording,
                                        const RecordingReader::Progress& progress) {
  Summary& summary = recording->summary;
  const FileIndex& index = recording->index;
  summary.file = recording->file.path();
  summary.file_bytes = recording->file.size();
  summary.damage = index.damage;
  summary.chunks = index.chunks.size();
  for (const ChunkPlace& chunk : index.chunks) summary.uncompressed_bytes += chunk.uncompressed;
  summary.compact = recording->packed_span > 0;
  summary.compression = index.chunks.empty() ? "none" : compression_name(*recording);
  const auto contents = read_attachments(*recording);
  if (contents && index.whole) {
    take(*contents, summary);
  } else if (auto error = count(recording, progress)) {
    return error;
  }
  std::stable_sort(summary.marks.begin(), summary.marks.end(),
                   [](const Mark& a, const Mark& b) { return a.time < b.time; });
  return std::nullopt;
}

}  // namespace skerry::recording
