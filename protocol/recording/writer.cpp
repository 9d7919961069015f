#include "protocol/recording/writer.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "protocol/recording/chunk_builder.hpp"
#include "protocol/recording/file_builder.hpp"
#include "protocol/recording/packed_spokes.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::recording {
namespace {

constexpr std::size_t kMinChunkBytes = 64 << 10;
// Octets of a message before its data, and of the Channel record that it may need.
constexpr std::size_t kMaxRecordHead = 256;

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
    const std::uint64_t time = ns_of(item.time);
    if (!fits(time, item.bytes.size())) flush();
    const bool packed = options_.compact && item.topic.kind == Kind::spoke && pack(item, time);
    const bool taken = packed || add_message({item.topic}, time, item.bytes);
    if (!taken) {
      ++counts_.items_dropped;
      if (item.topic.kind == Kind::spoke) ++counts_.spokes_dropped;
      return;
    }
    note_time(time);
    chunk_.count(item.topic, time);
    if (item.topic.kind == Kind::event) note_mark(item);
  }

  void add(const Spoke& spoke) {
    to_message(spoke, message_);
    bytes_.resize(message_.ByteSizeLong());
    message_.SerializeWithCachedSizesToArray(bytes_.data());
    add(Item{{Kind::spoke, spoke.header.radar, spoke.header.view}, spoke.header.utc, bytes_});
  }

  void attach(const Attachment& attachment) {
    if (attachment.bytes.size() > kMaxAttachment) return;
    flush();
    file_.attach(attachment);
  }

  bool flush() {
    end_packs();
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
  bool empty() const { return chunk_.empty() && packers_.empty(); }

  bool fits(std::uint64_t time, std::size_t size) const {
    if (empty()) return true;
    const auto first = std::min(first_time_, time), last = std::max(last_time_, time);
    std::size_t bytes = chunk_.records().size() + size + kMaxRecordHead;
    for (const auto& [topic, packer] : packers_) bytes += packer.size_bound();
    return bytes <= options_.chunk_bytes &&
           last - first < static_cast<std::uint64_t>(options_.chunk_time.count());
  }

  // Notes a time of the chunk.
  void note_time(std::uint64_t time) {
    first_time_ = started_ ? std::min(first_time_, time) : time;
    last_time_ = started_ ? std::max(last_time_, time) : time;
    started_ = true;
  }

  // False if it has no place in any chunk.
  bool add_message(const ChannelKind& kind, std::uint64_t time,
                   std::span<const std::uint8_t> bytes) {
    const auto channel = file_.channel(kind);
    if (!channel || bytes.size() > kMaxItem) return false;
    chunk_.use_channel(*channel, file_.record_of(*channel));
    if (sequences_.size() <= *channel) sequences_.resize(*channel + 1U);
    const auto room = chunk_.add_message(*channel, sequences_[*channel]++, time, bytes.size());
    std::copy(bytes.begin(), bytes.end(), room.begin());
    return true;
  }

  // False if the spoke cannot be packed.
  bool pack(const Item& spoke, std::uint64_t time) {
    if (!file_.channel({spoke.topic, true})) return false;
    auto known = packers_.find(spoke.topic);
    if (known == packers_.end()) known = packers_.try_emplace(spoke.topic).first;
    SpokePacker& packer = known->second;
    if (packer.size_bound() + spoke.bytes.size() > kMaxItem) end_pack(spoke.topic, packer);
    if (packer.add(spoke.bytes, time)) return true;
    end_pack(spoke.topic, packer);
    const bool packed = packer.add(spoke.bytes, time);
    if (!packed) packers_.erase(known);
    return packed;
  }

  void end_pack(const Topic& topic, SpokePacker& packer) {
    if (packer.empty()) return;
    const std::uint64_t time = packer.first_time();
    packed_.clear();
    packer.finish(packed_);
    add_message({topic, true}, time, packed_);
  }

  void end_packs() {
    for (auto& [topic, packer] : packers_) end_pack(topic, packer);
    packers_.clear();
    started_ = false;
  }

  void note_mark(const Item& item) {
    Event event;
    if (event.ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size())) &&
        event.kind() == Event::MARK) {
      chunk_.mark(ns_of(item.time), event);
    }
  }

  WriterOptions options_;
  FileBuilder file_;
  ChunkBuilder chunk_;
  std::map<Topic, SpokePacker> packers_;          // of spokes that are not in the chunk yet
  bool started_ = false;                          // there is something in the chunk or to be packed
  std::uint64_t first_time_ = 0, last_time_ = 0;  // of that; ns
  Bytes bytes_, packed_;
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
