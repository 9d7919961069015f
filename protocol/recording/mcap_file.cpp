#include "protocol/recording/mcap_file.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "protocol/recording/checksum.hpp"

namespace skerry::recording {
namespace {

constexpr char kLibrary[] = "skerry 0.1.0";

}  // namespace

McapFile::McapFile(ByteSink sink, std::string profile, Compression compression, int zstd_level)
    : sink_(std::move(sink)),
      profile_(std::move(profile)),
      compression_(compression),
      compressor_(compression, zstd_level) {}

std::uint16_t McapFile::schema(const ChannelText& text) {
  const auto known = std::find_if(schemas_.begin(), schemas_.end(), [&](const Schema& schema) {
    return schema.name == text.schema_name;
  });
  const auto id = static_cast<std::uint16_t>(known - schemas_.begin() + 1);
  if (known != schemas_.end()) return id;
  Schema made{text.schema_name, {}};
  mcap::append(made.record,
               mcap::Schema{id, text.schema_name, text.schema_encoding, text.schema_data});
  schemas_.push_back(std::move(made));
  return id;
}

std::optional<std::uint16_t> McapFile::add_channel(const ChannelText& text) {
  if (channels_.size() > std::numeric_limits<std::uint16_t>::max()) return std::nullopt;
  const auto id = static_cast<std::uint16_t>(channels_.size());
  Channel made{schema(text), {}};
  mcap::append(made.record, mcap::Channel{id, made.schema, text.topic, text.message_encoding});
  channels_.push_back(std::move(made));
  return id;
}

void McapFile::start() {
  out_.clear();
  if (begun_) return;
  for (const std::uint8_t octet : mcap::kMagic) out_.push_back(octet);
  mcap::append(out_, mcap::Header{profile_, kLibrary});
}

bool McapFile::give() {
  if (!sink_(out_)) return false;
  offset_ += out_.size();
  crc_ = crc32(out_, crc_);
  begun_ = true;
  return true;
}

bool McapFile::begin() {
  start();
  return begun_ || give();
}

void McapFile::add_schemas_of(const ChunkBuilder& chunk, std::vector<std::uint16_t>& added) {
  for (const auto& [channel, messages] : chunk.contents().channel_messages) {
    const std::uint16_t id = channels_[channel].schema;
    if (summary_.has_schema(id) || std::find(added.begin(), added.end(), id) != added.end()) {
      continue;
    }
    const Bytes& record = schemas_[id - 1U].record;
    out_.insert(out_.end(), record.begin(), record.end());
    added.push_back(id);
  }
}

std::optional<mcap::ChunkIndex> McapFile::append_chunk(const ChunkBuilder& chunk) {
  const auto records = chunk.records();
  mcap::ChunkHead head;
  head.start = chunk.start();
  head.end = chunk.end();
  head.uncompressed = records.size();
  head.crc = crc32(records);
  head.compression = mcap_name_of(compression_);
  const std::size_t begin = out_.size();
  mcap::append(out_, head);
  const std::size_t head_size = out_.size() - begin;
  out_.resize(out_.size() + compressor_.bound(records.size()));
  const auto compressed = compressor_.compress(records, std::span(out_).subspan(begin + head_size));
  if (!compressed) return std::nullopt;
  head.compressed = *compressed;
  // Again, now that its length is known: it has the same size.
  Bytes again;
  mcap::append(again, head);
  std::copy(again.begin(), again.end(), out_.begin() + static_cast<std::ptrdiff_t>(begin));
  out_.resize(begin + head_size + *compressed);
  return mcap::ChunkIndex{head.start, head.end,         offset_ + begin, out_.size() - begin, {},
                          0,          head.compression, head.compressed, head.uncompressed};
}

bool McapFile::write(const ChunkBuilder& chunk) {
  start();
  std::vector<std::uint16_t> schemas;
  add_schemas_of(chunk, schemas);
  auto index = append_chunk(chunk);
  if (!index) return false;
  const std::size_t chunk_end = out_.size();
  index->message_indexes = chunk.append_indexes(out_, offset_ + chunk_end);
  index->message_index_length = out_.size() - chunk_end;
  if (!give()) return false;

  for (const std::uint16_t id : schemas) summary_.add_schema(id, schemas_[id - 1U].record);
  const auto& messages = chunk.contents().channel_messages;
  for (const auto& [channel, number] : messages) {
    summary_.add_channel(channel, channels_[channel].record);
  }
  summary_.add_chunk(*index, messages);
  return true;
}

bool McapFile::attach(const Attachment& attachment) {
  start();
  const std::size_t begin = out_.size();
  const auto time = static_cast<std::uint64_t>(
      std::max<std::int64_t>(attachment.time.time_since_epoch().count(), 0));
  const auto* data = reinterpret_cast<const std::uint8_t*>(attachment.bytes.data());
  mcap::append(out_,
               mcap::Attachment{
                   time, attachment.name, attachment.media_type, {data, attachment.bytes.size()}});
  const mcap::AttachmentIndex index{
      offset_ + begin,         out_.size() - begin, time,
      attachment.bytes.size(), attachment.name,     attachment.media_type};
  if (!give()) return false;
  summary_.add_attachment(index);
  return true;
}

bool McapFile::end() {
  out_ = summary_.end(offset_, crc_);
  return give();
}

}  // namespace skerry::recording
