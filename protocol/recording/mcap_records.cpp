#include "protocol/recording/mcap_records.hpp"

#include "protocol/recording/checksum.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::recording::mcap {
namespace {

void put(Bytes& out, std::uint64_t value, int octets) { append_little_endian(out, value, octets); }

void put(Bytes& out, std::string_view text) {
  put(out, text.size(), 4);
  out.insert(out.end(), text.begin(), text.end());
}

void put_map(Bytes& out, const std::vector<std::pair<std::uint16_t, std::uint64_t>>& map) {
  put(out, map.size() * 10, 4);
  for (const auto& [key, value] : map) {
    put(out, key, 2);
    put(out, value, 8);
  }
}

// A record whose length is filled in when it ends.
class Open {
 public:
  Open(Bytes& out, Op op) : out_(out) {
    out_.push_back(static_cast<std::uint8_t>(op));
    put(out_, 0, 8);
    start_ = out_.size();
  }
  Open(const Open&) = delete;
  Open& operator=(const Open&) = delete;
  ~Open() { put_little_endian(out_, start_ - 8, out_.size() - start_, 8); }
  std::size_t start() const { return start_; }

 private:
  Bytes& out_;
  std::size_t start_ = 0;  // of the content
};

std::string text(ByteReader& in) {
  const auto bytes = in.take(in.little_endian<std::uint32_t>());
  return {bytes.begin(), bytes.end()};
}

std::uint64_t u64(ByteReader& in) { return in.little_endian<std::uint64_t>(); }

std::vector<std::pair<std::uint16_t, std::uint64_t>> map_of(ByteReader& in) {
  ByteReader entries(in.take(in.little_endian<std::uint32_t>()));
  std::vector<std::pair<std::uint16_t, std::uint64_t>> map;
  map.reserve(entries.left() / 10);
  while (entries.left() >= 10) {
    const auto key = entries.little_endian<std::uint16_t>();
    map.emplace_back(key, u64(entries));
  }
  return map;
}

template <typename T>
std::optional<T> whole(const ByteReader& in, T value) {
  if (in.truncated()) return std::nullopt;
  return value;
}

}  // namespace

void append(Bytes& out, const Header& header) {
  const Open record(out, Op::header);
  put(out, header.profile);
  put(out, header.library);
}

void append(Bytes& out, const Schema& schema) {
  const Open record(out, Op::schema);
  put(out, schema.id, 2);
  put(out, schema.name);
  put(out, schema.encoding);
  put(out, schema.data);
}

void append(Bytes& out, const Channel& channel) {
  const Open record(out, Op::channel);
  put(out, channel.id, 2);
  put(out, channel.schema, 2);
  put(out, channel.topic);
  put(out, channel.encoding);
  put(out, 0, 4);  // no metadata
}

void append(Bytes& out, const Attachment& attachment) {
  const Open record(out, Op::attachment);
  put(out, attachment.time, 8);
  put(out, attachment.time, 8);
  put(out, attachment.name);
  put(out, attachment.media_type);
  put(out, attachment.data.size(), 8);
  out.insert(out.end(), attachment.data.begin(), attachment.data.end());
  put(out, crc32(std::span(out).subspan(record.start())), 4);
}

void append(Bytes& out, const ChunkIndex& index) {
  const Open record(out, Op::chunk_index);
  put(out, index.start, 8);
  put(out, index.end, 8);
  put(out, index.offset, 8);
  put(out, index.length, 8);
  put_map(out, index.message_indexes);
  put(out, index.message_index_length, 8);
  put(out, index.compression);
  put(out, index.compressed, 8);
  put(out, index.uncompressed, 8);
}

void append(Bytes& out, const AttachmentIndex& index) {
  const Open record(out, Op::attachment_index);
  put(out, index.offset, 8);
  put(out, index.length, 8);
  put(out, index.time, 8);
  put(out, index.time, 8);
  put(out, index.data_size, 8);
  put(out, index.name);
  put(out, index.media_type);
}

void append(Bytes& out, const Statistics& statistics) {
  const Open record(out, Op::statistics);
  put(out, statistics.messages, 8);
  put(out, statistics.schemas, 2);
  put(out, statistics.channels, 4);
  put(out, statistics.attachments, 4);
  put(out, 0, 4);  // metadata
  put(out, statistics.chunks, 4);
  put(out, statistics.start, 8);
  put(out, statistics.end, 8);
  put_map(out, statistics.channel_messages);
}

void append(Bytes& out, const SummaryOffset& offset) {
  const Open record(out, Op::summary_offset);
  put(out, static_cast<std::uint8_t>(offset.group), 1);
  put(out, offset.start, 8);
  put(out, offset.length, 8);
}

void append_data_end(Bytes& out, std::uint32_t crc) {
  const Open record(out, Op::data_end);
  put(out, crc, 4);
}

void append_footer(Bytes& out, Footer footer) {
  const Open record(out, Op::footer);
  put(out, footer.summary_start, 8);
  put(out, footer.summary_offset_start, 8);
  // The record's length stands among the bytes summed: put it there before it is its turn.
  Bytes head;
  head.push_back(static_cast<std::uint8_t>(Op::footer));
  put(head, kFooterBytes - kRecordHead, 8);
  const std::uint32_t sum = crc32(head, footer.summary_crc);
  put(out, crc32(std::span(out).subspan(record.start()), sum), 4);
}

void append_message_index(Bytes& out, std::uint16_t channel,
                          std::span<const std::uint8_t> entries) {
  const Open record(out, Op::message_index);
  put(out, channel, 2);
  put(out, entries.size(), 4);
  out.insert(out.end(), entries.begin(), entries.end());
}

void append_message_head(Bytes& out, const Message& message, std::size_t size) {
  out.push_back(static_cast<std::uint8_t>(Op::message));
  put(out, kMessageHead - kRecordHead + size, 8);
  put(out, message.channel, 2);
  put(out, message.sequence, 4);
  put(out, message.time, 8);
  put(out, message.time, 8);
}

void append(Bytes& out, const ChunkHead& head) {
  out.push_back(static_cast<std::uint8_t>(Op::chunk));
  put(out, kChunkHead - kRecordHead + head.compression.size() + head.compressed, 8);
  put(out, head.start, 8);
  put(out, head.end, 8);
  put(out, head.uncompressed, 8);
  put(out, head.crc, 4);
  put(out, head.compression);
  put(out, head.compressed, 8);
}

std::optional<Header> read_header(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  Header header;
  header.profile = text(in);
  header.library = text(in);
  return whole(in, std::move(header));
}

std::optional<Footer> read_footer(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  Footer footer;
  footer.summary_start = u64(in);
  footer.summary_offset_start = u64(in);
  footer.summary_crc = in.little_endian<std::uint32_t>();
  return whole(in, footer);
}

std::optional<Schema> read_schema(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  Schema schema;
  schema.id = in.little_endian<std::uint16_t>();
  schema.name = text(in);
  schema.encoding = text(in);
  schema.data = text(in);
  return whole(in, std::move(schema));
}

std::optional<Channel> read_channel(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  Channel channel;
  channel.id = in.little_endian<std::uint16_t>();
  channel.schema = in.little_endian<std::uint16_t>();
  channel.topic = text(in);
  channel.encoding = text(in);
  return whole(in, std::move(channel));
}

std::optional<Message> read_message(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  Message message;
  message.channel = in.little_endian<std::uint16_t>();
  message.sequence = in.little_endian<std::uint32_t>();
  message.time = u64(in);
  (void)u64(in);
  message.data = in.take(in.left());
  return whole(in, message);
}

std::optional<std::pair<ChunkHead, std::size_t>> read_chunk_head(
    std::span<const std::uint8_t> content) {
  ByteReader in(content);
  ChunkHead head;
  head.start = u64(in);
  head.end = u64(in);
  head.uncompressed = u64(in);
  head.crc = in.little_endian<std::uint32_t>();
  head.compression = text(in);
  head.compressed = u64(in);
  return whole(in, std::pair(std::move(head), in.offset()));
}

std::optional<ChunkIndex> read_chunk_index(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  ChunkIndex index;
  index.start = u64(in);
  index.end = u64(in);
  index.offset = u64(in);
  index.length = u64(in);
  index.message_indexes = map_of(in);
  index.message_index_length = u64(in);
  index.compression = text(in);
  index.compressed = u64(in);
  index.uncompressed = u64(in);
  return whole(in, std::move(index));
}

std::optional<AttachmentIndex> read_attachment_index(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  AttachmentIndex index;
  index.offset = u64(in);
  index.length = u64(in);
  index.time = u64(in);
  (void)u64(in);
  index.data_size = u64(in);
  index.name = text(in);
  index.media_type = text(in);
  return whole(in, std::move(index));
}

std::optional<Attachment> read_attachment(std::span<const std::uint8_t> content) {
  ByteReader in(content);
  Attachment attachment;
  attachment.time = u64(in);
  (void)u64(in);
  attachment.name = text(in);
  attachment.media_type = text(in);
  attachment.data = in.take(static_cast<std::size_t>(u64(in)));
  const std::size_t summed = in.offset();
  const auto crc = in.little_endian<std::uint32_t>();
  if (in.truncated() || (crc != 0 && crc != crc32(content.first(summed)))) return std::nullopt;
  return attachment;
}

}  // namespace skerry::recording::mcap
