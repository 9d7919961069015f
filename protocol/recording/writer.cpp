#include "protocol/recording/writer.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "protocol/recording/chunk_builder.hpp"
#include "protocol/recording/file_builder.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::recording {
namespace {

constexpr std::size_t kMinChunkBytes = 64 << 10;

std::uint64_t ns_of(UtcTime time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time.time_since_epoch().count(), 0));
}

}  // namespace

class RecordingWriter::Impl {
 public:
  Impl(ByteSink sink, const WriterOptions& options)
      : options_(options), file_(std::move(sink), options.compression, options.zstd_level) {
    options_.chunk_bytes = std::clamp(options.chunk_bytes, kMinChunkBytes, kMaxChunkBytes);
    file_.begin();
  }

  void add(const Item& item) {
    ++counts_.items;
    if (item.topic.kind == Kind::spoke) ++counts_.spokes;
    const auto room = make_room(item.topic, ns_of(item.time), item.bytes.size());
    if (room.empty() && !item.bytes.empty()) return;
    std::copy(item.bytes.begin(), item.bytes.end(), room.begin());
    if (item.topic.kind == Kind::event) note_mark(item);
  }

  void add(const Spoke& spoke) {
    to_message(spoke, message_);
    const std::size_t size = message_.ByteSizeLong();
    ++counts_.items;
    ++counts_.spokes;
    const Topic topic{Kind::spoke, spoke.header.radar, spoke.header.view};
    const auto room = make_room(topic, ns_of(spoke.header.utc), size);
    if (!room.empty()) message_.SerializeWithCachedSizesToArray(room.data());
  }

  void attach(const Attachment& attachment) {
    if (attachment.bytes.size() > kMaxAttachment) return;
    flush();
    file_.attach(attachment);
  }

  bool flush() {
    if (chunk_.empty()) return true;
    const bool taken = file_.write(chunk_);
    if (!taken) {
      counts_.items_dropped += chunk_.contents().all_items;
      counts_.spokes_dropped += chunk_.contents().spokes;
    }
    chunk_.clear();
    return taken;
  }

  bool finish() {
    const bool flushed = flush();
    return file_.finish() && flushed;
  }

  WriterCounts counts() const {
    WriterCounts counts = counts_;
    counts.bytes = file_.bytes();
    return counts;
  }

 private:
  // In the chunk, for a message; none, and the item is counted as dropped, if it has no place in
  // any.
  std::span<std::uint8_t> make_room(const Topic& topic, std::uint64_t time, std::size_t size) {
    const auto channel = file_.channel({topic});
    if (!channel || size > kMaxItem) {
      ++counts_.items_dropped;
      if (topic.kind == Kind::spoke) ++counts_.spokes_dropped;
      return {};
    }
    if (!fits(time, size)) flush();
    chunk_.use_channel(*channel, file_.record_of(*channel));
    if (sequences_.size() <= *channel) sequences_.resize(*channel + 1U);
    chunk_.count(topic, time);
    return chunk_.add_message(*channel, sequences_[*channel]++, time, size);
  }

  bool fits(std::uint64_t time, std::size_t size) const {
    if (chunk_.empty()) return true;
    const auto first = std::min(chunk_.start(), time), last = std::max(chunk_.end(), time);
    return chunk_.records().size() + size <= options_.chunk_bytes &&
           last - first < static_cast<std::uint64_t>(options_.chunk_time.count());
  }

  void note_mark(const Item& item) {
    Event event;
    if (event.ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size())) &&
        event.kind() == Event::MARK) {
      chunk_.mark(ns_of(item.time), event.text());
    }
  }

  WriterOptions options_;
  FileBuilder file_;
  ChunkBuilder chunk_;
  std::vector<std::uint32_t> sequences_;  // by channel
  wire::Spoke message_;
  WriterCounts counts_;
};

RecordingWriter::RecordingWriter(ByteSink sink, const WriterOptions& options)
    : impl_(std::make_unique<Impl>(std::move(sink), options)) {}
RecordingWriter::~RecordingWriter() = default;
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;

void RecordingWriter::add(const Item& item) { impl_->add(item); }
void RecordingWriter::add(const Spoke& spoke) { impl_->add(spoke); }
void RecordingWriter::attach(const Attachment& attachment) { impl_->attach(attachment); }
bool RecordingWriter::flush() { return impl_->flush(); }
bool RecordingWriter::finish() { return impl_->finish(); }
WriterCounts RecordingWriter::counts() const { return impl_->counts(); }

}  // namespace skerry::recording
