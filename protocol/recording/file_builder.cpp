#include "protocol/recording/file_builder.hpp"

#include <algorithm>
#include <utility>

namespace skerry::recording {

FileBuilder::FileBuilder(ByteSink sink, Compression compression, int zstd_level)
    : file_(std::move(sink), kProfile, compression, zstd_level) {}

std::optional<std::uint16_t> FileBuilder::channel(const ChannelKind& kind) {
  const auto known = numbers_.find(kind);
  if (known != numbers_.end()) return known->second;
  const auto id = file_.add_channel(
      {name_of(kind), "protobuf", schema_name(kind), "protobuf", schema_data(kind)});
  if (id) numbers_.emplace(kind, *id);
  return id;
}

bool FileBuilder::write(const ChunkBuilder& chunk) {
  if (!file_.write(chunk)) return false;
  count(chunk);
  return true;
}

void FileBuilder::count(const ChunkBuilder& chunk) {
  const ChunkContents& contents = chunk.contents();
  const bool first = items_.empty();
  for (const auto& [topic, number] : contents.items) items_[topic] += number;
  for (const Contents::Mark& mark : contents.marks) {
    if (static_cast<std::size_t>(contents_.marks_size()) >= kMaxMarks) break;
    *contents_.add_marks() = mark;
  }
  contents_.set_begin_utc_ns(
      first ? chunk.start() : std::min<std::uint64_t>(contents_.begin_utc_ns(), chunk.start()));
  contents_.set_end_utc_ns(std::max<std::uint64_t>(contents_.end_utc_ns(), contents.last_time));
}

bool FileBuilder::finish() {
  Contents contents = contents_;
  for (const auto& [topic, number] : items_) {
    Contents::Topic& entry = *contents.add_topics();
    entry.set_name(name_of({topic}));
    entry.set_items(number);
  }
  const UtcTime end{Duration(static_cast<std::int64_t>(contents.end_utc_ns()))};
  if (!attach({kContentsName, kContentsType, end, contents.SerializeAsString()})) return false;
  return file_.end();
}

}  // namespace skerry::recording
