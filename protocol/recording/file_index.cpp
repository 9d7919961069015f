#include "protocol/recording/file_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "protocol/recording/checksum.hpp"
#include "protocol/recording/compression.hpp"
#include "protocol/recording/file_builder.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::recording {
namespace {

constexpr std::size_t kMagicBytes = sizeof(mcap::kMagic);

bool is_magic(std::span<const std::uint8_t> bytes) {
  return bytes.size() == kMagicBytes && std::equal(bytes.begin(), bytes.end(), mcap::kMagic);
}

// Goes through a summary and takes what it says.
class SummaryReader {
 public:
  SummaryReader(const InputFile& file, std::uint64_t end) : file_(file), window_(file), end_(end) {}

  // Returns the fault; nullopt if there is none.
  std::optional<RecordingError> read(std::uint64_t start) {
    std::uint64_t offset = start;
    while (offset < end_) {
      const auto place = record_at(window_, offset, end_);
      if (!place) return file_.error(offset, "the summary's record reaches beyond its end");
      if (auto error = take(*place)) return error;
      offset = place->end();
    }
    index.whole = true;
    return std::nullopt;
  }

  FileIndex index;

 private:
  std::optional<RecordingError> take(const RecordPlace& place) {
    const bool wanted = place.op == mcap::Op::schema || place.op == mcap::Op::channel ||
                        place.op == mcap::Op::chunk_index || place.op == mcap::Op::statistics ||
                        place.op == mcap::Op::attachment_index;
    if (!wanted) return std::nullopt;
    if (place.length > kMaxRecord || !file_.read_all(place.content, place.length, content_)) {
      return file_.error(place.offset, fmt::format("a record of {} octets in the summary, expected "
                                                   "at most {}",
                                                   place.length, kMaxRecord));
    }
    const bool read = take_content(place.op);
    if (read) return std::nullopt;
    return file_.error(place.offset, fmt::format("the summary's record of kind {} is not one that "
                                                 "can be believed",
                                                 static_cast<int>(place.op)));
  }

  bool take_content(mcap::Op op) {
    switch (op) {
      case mcap::Op::schema: {
        const auto schema = mcap::read_schema(content_);
        if (schema) index.schemas[schema->id] = schema->name.substr(0, kMaxName);
        return schema.has_value();
      }
      case mcap::Op::channel: {
        const auto channel = mcap::read_channel(content_);
        if (channel) index.add(*channel);
        return channel.has_value();
      }
      case mcap::Op::chunk_index: {
        const auto chunk = mcap::read_chunk_index(content_);
        return chunk && take_chunk(*chunk);
      }
      case mcap::Op::attachment_index: {
        const auto attachment = mcap::read_attachment_index(content_);
        return attachment && take_attachment(*attachment);
      }
      default:
        return take_statistics();
    }
  }

  bool take_statistics() {
    ByteReader in(content_);
    (void)in.take(8 + 2 + 4 + 4 + 4 + 4 + 8 + 8);
    ByteReader counts(in.take(in.little_endian<std::uint32_t>()));
    while (counts.left() >= 10) {
      const auto channel = counts.little_endian<std::uint16_t>();
      index.messages[channel] = counts.little_endian<std::uint64_t>();
    }
    return !in.truncated();
  }

  // One after the other and none twice: a chunk must not be read for ever.
  bool take_chunk(const mcap::ChunkIndex& chunk) {
    const auto& channels = chunk.message_indexes;
    if (chunk.offset < next_chunk_ || chunk.length < mcap::kChunkHead || chunk.offset > end_ ||
        chunk.length > end_ - chunk.offset || index.chunks.size() >= kMaxChunks ||
        index.chunk_channels.size() + channels.size() > kMaxChunkChannels) {
      return false;
    }
    next_chunk_ = chunk.offset + chunk.length;
    const auto uncompressed = std::min<std::uint64_t>(chunk.uncompressed, 0xFFFFFFFF);
    index.chunks.push_back({chunk.offset, chunk.length, time_of(chunk.start), time_of(chunk.end),
                            static_cast<std::uint32_t>(uncompressed),
                            static_cast<std::uint32_t>(channels.size()),
                            index.chunk_channels.size()});
    for (const auto& [channel, offset] : channels) index.chunk_channels.push_back(channel);
    return true;
  }

  // So too.
  bool take_attachment(const mcap::AttachmentIndex& attachment) {
    if (attachment.offset < next_attachment_ || attachment.length < mcap::kRecordHead ||
        attachment.offset > end_ || attachment.length > end_ - attachment.offset ||
        index.attachments.size() >= kMaxAttachments) {
      return false;
    }
    next_attachment_ = attachment.offset + attachment.length;
    index.attachments.push_back({mcap::Op::attachment, attachment.offset,
                                 attachment.offset + mcap::kRecordHead,
                                 attachment.length - mcap::kRecordHead});
    return true;
  }

  const InputFile& file_;
  FileWindow window_;
  std::uint64_t end_ = 0;
  std::uint64_t next_chunk_ = 0, next_attachment_ = 0;  // the next one begins here or later
  Bytes content_;
};

// The CRC of the octets from `begin` to `end`; nullopt if they cannot be read.
std::optional<std::uint32_t> crc_of(const InputFile& file, std::uint64_t begin, std::uint64_t end) {
  FileWindow window(file);
  std::uint32_t crc = 0;
  while (begin < end) {
    const auto size = std::min<std::uint64_t>(end - begin, FileWindow::kMaxWindow);
    const auto bytes = window.at(begin, static_cast<std::size_t>(size));
    if (bytes.empty()) return std::nullopt;
    crc = crc32(bytes, crc);
    begin += bytes.size();
  }
  return crc;
}

}  // namespace

std::int64_t time_of(std::uint64_t ns) {
  constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min(ns, kMax));
}

void FileIndex::add(const mcap::Channel& channel) {
  const auto kind = channel_named(channel.topic);
  if (!kind || channel.encoding != "protobuf") return;
  // Channels with our names need no schema: it may be damaged.
  const auto schema = schemas.find(channel.schema);
  const bool ours =
      profile == kProfile || (schema != schemas.end() && schema->second == schema_name(*kind));
  if (ours) channels[channel.id] = *kind;
}

Result<mcap::Header, RecordingError> read_beginning(const InputFile& file) {
  FileWindow window(file);
  const auto magic = window.at(0, kMagicBytes);
  if (magic.empty()) return Failure{file.error(0, "is empty, expected a recording (MCAP)")};
  if (!is_magic(magic)) {
    return Failure{file.error(0, "does not begin as a recording (MCAP 0) does")};
  }
  const auto place = record_at(window, kMagicBytes, file.size());
  Bytes content;
  std::optional<mcap::Header> header;
  if (place && place->op == mcap::Op::header && place->length <= kMaxRecord &&
      file.read_all(place->content, place->length, content)) {
    header = mcap::read_header(content);
  }
  if (!header) return Failure{file.error(kMagicBytes, "there is no header, expected MCAP's")};
  return *std::move(header);
}

Result<FileIndex, RecordingError> read_summary(const InputFile& file) {
  const std::uint64_t tail = mcap::kFooterBytes + kMagicBytes;
  Bytes bytes;
  if (file.size() < tail + kMagicBytes || !file.read_all(file.size() - tail, tail, bytes) ||
      !is_magic(std::span<const std::uint8_t>(bytes).last(kMagicBytes)) ||
      bytes[0] != static_cast<std::uint8_t>(mcap::Op::footer)) {
    return Failure{
        file.error(file.size(), "it ends without a footer: it was not finished, or cut")};
  }
  const std::uint64_t footer_at = file.size() - tail;
  const auto footer = mcap::read_footer(std::span<const std::uint8_t>(bytes).subspan(
      mcap::kRecordHead, mcap::kFooterBytes - mcap::kRecordHead));
  if (!footer || footer->summary_start == 0 || footer->summary_start >= footer_at ||
      footer->summary_offset_start > footer_at ||
      (footer->summary_offset_start != 0 && footer->summary_offset_start < footer->summary_start)) {
    return Failure{file.error(footer_at, "the footer tells of no summary")};
  }
  if (footer->summary_crc != 0 &&
      crc_of(file, footer->summary_start, file.size() - kMagicBytes - 4) != footer->summary_crc) {
    return Failure{file.error(footer->summary_start, "the summary's checksum is wrong")};
  }
  const auto header = read_beginning(file);
  const std::uint64_t end =
      footer->summary_offset_start != 0 ? footer->summary_offset_start : footer_at;
  SummaryReader reader(file, end);
  reader.index.profile = header ? header->profile : std::string();
  if (auto error = reader.read(footer->summary_start)) return Failure{*std::move(error)};
  return std::move(reader.index);
}

}  // namespace skerry::recording
