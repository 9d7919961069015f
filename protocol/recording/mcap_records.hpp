// The records of MCAP 0 (mcap.dev/spec) as values, and their bytes.  Only what recordings use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/wire/wire_error.hpp"

namespace skerry::recording::mcap {

inline constexpr std::uint8_t kMagic[8] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Op : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

// Octets of a record's head: the op and the length of what follows.
inline constexpr std::size_t kRecordHead = 9;
// Octets of a message within a chunk before its data, head included.
inline constexpr std::size_t kMessageHead = kRecordHead + 2 + 4 + 8 + 8;
inline constexpr std::size_t kFooterBytes = kRecordHead + 8 + 8 + 4;
// Octets of a chunk before its records, without the compression's name.
inline constexpr std::size_t kChunkHead = kRecordHead + 8 + 8 + 8 + 4 + 4 + 8;
// No compression has a longer name here.
inline constexpr std::size_t kMaxCompressionName = 4;

struct Header {
  std::string profile;
  std::string library;
};
struct Footer {
  std::uint64_t summary_start = 0;         // 0: there is none
  std::uint64_t summary_offset_start = 0;  // the same
  std::uint32_t summary_crc = 0;           // of all from summary_start up to this field
};
struct Schema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;
};
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;
  std::string topic;
  std::string encoding;
};
// A message with its log_time; publish_time is always the same.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t time = 0;  // ns since 1970
  std::span<const std::uint8_t> data;
};
// All of a chunk but its records.
struct ChunkHead {
  std::uint64_t start = 0, end = 0;  // of the times of its messages; 0 without any
  std::uint64_t uncompressed = 0;    // octets
  std::uint32_t crc = 0;             // of the records before compression
  std::string compression;           // "", "lz4", "zstd"
  std::uint64_t compressed = 0;      // octets
};
struct ChunkIndex {
  std::uint64_t start = 0, end = 0;
  std::uint64_t offset = 0, length = 0;  // of the chunk's record, with its head
  std::vector<std::pair<std::uint16_t, std::uint64_t>> message_indexes;  // channel, offset
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t compressed = 0, uncompressed = 0;
};
struct AttachmentIndex {
  std::uint64_t offset = 0, length = 0;  // of the record, with its head
  std::uint64_t time = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;
};
struct Attachment {
  std::uint64_t time = 0;
  std::string name;
  std::string media_type;
  std::span<const std::uint8_t> data;
};
struct Statistics {
  std::uint64_t messages = 0;
  std::uint16_t schemas = 0;
  std::uint32_t channels = 0;
  std::uint32_t attachments = 0;
  std::uint32_t chunks = 0;
  std::uint64_t start = 0, end = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> channel_messages;
};
struct SummaryOffset {
  Op group = Op::header;
  std::uint64_t start = 0, length = 0;
};

// Each appends a whole record.
void append(Bytes& out, const Header& header);
void append(Bytes& out, const Schema& schema);
void append(Bytes& out, const Channel& channel);
void append(Bytes& out, const Attachment& attachment);  // its CRC too
void append(Bytes& out, const ChunkIndex& index);
void append(Bytes& out, const AttachmentIndex& index);
void append(Bytes& out, const Statistics& statistics);
void append(Bytes& out, const SummaryOffset& offset);
// `crc` of all before it.
void append_data_end(Bytes& out, std::uint32_t crc);
// `summary_crc` is that of the summary's bytes alone; what it lacks is added.
void append_footer(Bytes& out, Footer footer);
// Appends the index of one channel; `entries` are its times and offsets, 16 octets each.
void append_message_index(Bytes& out, std::uint16_t channel, std::span<const std::uint8_t> entries);
// The head of a message of `size` octets of data, which follow.
void append_message_head(Bytes& out, const Message& message, std::size_t size);
// The head of a chunk's record, whose records follow.
void append(Bytes& out, const ChunkHead& head);

// Each reads the content of a record, without its head; nothing if it is too short for what it
// says.  More than is known is left unread, as the format may grow.
std::optional<Header> read_header(std::span<const std::uint8_t> content);
std::optional<Footer> read_footer(std::span<const std::uint8_t> content);
std::optional<Schema> read_schema(std::span<const std::uint8_t> content);
std::optional<Channel> read_channel(std::span<const std::uint8_t> content);
std::optional<Message> read_message(std::span<const std::uint8_t> content);
// The beginning of a chunk is enough; the second is where its records begin in the content.
std::optional<std::pair<ChunkHead, std::size_t>> read_chunk_head(
    std::span<const std::uint8_t> content);
std::optional<ChunkIndex> read_chunk_index(std::span<const std::uint8_t> content);
std::optional<AttachmentIndex> read_attachment_index(std::span<const std::uint8_t> content);
// Also nullopt if its CRC is wrong.
std::optional<Attachment> read_attachment(std::span<const std::uint8_t> content);

}  // namespace skerry::recording::mcap
