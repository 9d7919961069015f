#include "protocol/recording/chunk_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "protocol/recording/checksum.hpp"
#include "protocol/recording/compression.hpp"
#include "protocol/recording/file_builder.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::recording {

// Goes through the records of a chunk.
class ChunkParser {
 public:
  ChunkParser(const FileIndex& index, const std::set<Topic>& topics)
      : index_(index), topics_(topics), chunk_(std::make_shared<ChunkData>()) {}

  void take(OctetBlock records) { chunk_->records_ = std::move(records); }

  // Returns the fault; nullopt if there is none.
  std::optional<std::string> parse() {
    const std::span<const std::uint8_t> records = chunk_->records_.octets();
    ByteReader in(records);
    while (in.left() > 0) {
      const std::size_t begin = in.offset();
      const auto op = static_cast<mcap::Op>(in.octet());
      const auto length = in.little_endian<std::uint64_t>();
      if (in.truncated() || length > in.left()) {
        return fmt::format("the record {} octets into the chunk reaches beyond its end", begin);
      }
      const std::size_t content_at = in.offset();
      const auto content = in.take(static_cast<std::size_t>(length));
      if (op == mcap::Op::channel && !take_channel(content)) {
        return fmt::format("the Channel record {} octets into the chunk is too short", begin);
      }
      if (op == mcap::Op::message && !take_message(content, content_at)) {
        return fmt::format("the Message record {} octets into the chunk is too short", begin);
      }
    }
    const auto by_time = [](const auto& a, const auto& b) { return a.time < b.time; };
    auto& entries = chunk_->entries_;
    if (!std::is_sorted(entries.begin(), entries.end(), by_time)) {
      std::stable_sort(entries.begin(), entries.end(), by_time);
    }
    return std::nullopt;
  }

  std::shared_ptr<const ChunkData> take() { return std::move(chunk_); }

 private:
  static constexpr std::uint32_t kLeftOut = 0xFFFFFFFF;

  bool take_channel(std::span<const std::uint8_t> content) {
    auto channel = mcap::read_channel(content);
    if (!channel) return false;
    // A chunk may tell of a channel that an earlier part of the file tells otherwise: its own
    // rules.
    if (own_.schemas.empty()) {
      own_.schemas = index_.schemas;
      own_.profile = index_.profile;
    }
    own_.channels.erase(channel->id);
    own_.add(*channel);
    numbers_.erase(channel->id);
    if (known_here_.insert(channel->id).second) chunk_->channels_.push_back(*std::move(channel));
    return true;
  }

  bool take_message(std::span<const std::uint8_t> content, std::size_t content_at) {
    const auto message = mcap::read_message(content);
    if (!message) return false;
    const std::int64_t time = time_of(message->time);
    const bool first = chunk_->messages_.empty();
    chunk_->start_ = first ? time : std::min(chunk_->start_, time);
    chunk_->end_ = first ? time : std::max(chunk_->end_, time);
    ++chunk_->messages_[message->channel];
    const std::uint32_t kind = number_of(message->channel);
    if (kind == kLeftOut) return true;
    const std::size_t offset = content_at + content.size() - message->data.size();
    chunk_->entries_.push_back({time, static_cast<std::uint32_t>(offset),
                                static_cast<std::uint32_t>(message->data.size()), kind});
    return true;
  }

  // The number of the channel's kind among those of the chunk.
  std::uint32_t number_of(std::uint16_t channel) {
    const auto known = numbers_.find(channel);
    if (known != numbers_.end()) return known->second;
    const Channels& from = known_here_.contains(channel) ? own_.channels : index_.channels;
    const auto kind = from.find(channel);
    std::uint32_t number = kLeftOut;
    if (kind != from.end() && (topics_.empty() || topics_.contains(kind->second.topic))) {
      number = static_cast<std::uint32_t>(chunk_->kinds_.size());
      chunk_->kinds_.push_back(kind->second);
    }
    numbers_.emplace(channel, number);
    return number;
  }

  const FileIndex& index_;
  const std::set<Topic>& topics_;
  FileIndex own_;  // channels that the chunk tells of
  std::set<std::uint16_t> known_here_;
  std::map<std::uint16_t, std::uint32_t> numbers_;
  std::shared_ptr<ChunkData> chunk_;
};

namespace {

// The records of the chunk, whose record's content is given.  Error: what is wrong with it.
Result<OctetBlock, std::string> unpack(std::span<const std::uint8_t> content, bool ours) {
  const auto fail = [](std::string text) { return Failure{std::move(text)}; };
  const auto read = mcap::read_chunk_head(content);
  if (!read) return fail("the chunk's head is cut short");
  const auto& [head, records_at] = *read;
  if (content.size() - records_at != head.compressed) {
    return fail(fmt::format("the chunk says it holds {} octets, expected {}", head.compressed,
                            content.size() - records_at));
  }
  const auto compression = compression_of_mcap_name(head.compression);
  if (!compression) {
    return fail(fmt::format("the chunk's compression is \"{}\", expected lz4, zstd or none",
                            head.compression.substr(0, 20)));
  }
  if (head.uncompressed > kMaxChunkBytes) {
    return fail(fmt::format("the chunk says it becomes {} octets, expected at most {}",
                            head.uncompressed, kMaxChunkBytes));
  }
  auto records = decompress(*compression, content.subspan(records_at),
                            static_cast<std::size_t>(head.uncompressed));
  // Others may leave the checksum out; we do not.
  if (records && (ours || head.crc != 0) && crc32(records->octets()) != head.crc) {
    return fail("the chunk's checksum is wrong");
  }
  return records;
}

}  // namespace

Result<std::shared_ptr<const ChunkData>, RecordingError> ChunkData::read(
    const InputFile& file, const ChunkPlace& place, const FileIndex& index,
    const std::set<Topic>& topics) {
  const auto fail = [&](std::string text) {
    return Failure{file.error(place.offset, std::move(text))};
  };
  // Compressed it may be a little larger than not.
  constexpr std::uint64_t kMaxLength = kMaxChunkBytes + (1 << 20);
  if (place.length > kMaxLength) {
    return fail(fmt::format("a chunk of {} octets, expected at most {}", place.length, kMaxLength));
  }
  OctetBlock record(static_cast<std::size_t>(place.length));
  if (!file.read_all(place.offset, record.room())) {
    return fail("the chunk cannot be read: the file is shorter than it was, or the disk fails");
  }
  ByteReader in(record.octets());
  const auto op = static_cast<mcap::Op>(in.octet());
  if (op != mcap::Op::chunk || in.little_endian<std::uint64_t>() != in.left()) {
    return fail("there is no chunk of the length that the index says");
  }
  ChunkParser parser(index, topics);
  auto records = unpack(in.take(in.left()), index.profile == kProfile);
  if (!records) return fail(records.error());
  parser.take(std::move(records).value());
  if (auto error = parser.parse()) return fail(*std::move(error));
  return parser.take();
}

}  // namespace skerry::recording
