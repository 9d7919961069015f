#include "protocol/recording/summary_builder.hpp"

#include <algorithm>
#include <span>

#include "protocol/recording/checksum.hpp"

namespace skerry::recording {

void SummaryBuilder::add_schema(std::uint16_t id, Bytes record) {
  schemas_.emplace(id, std::move(record));
}

void SummaryBuilder::add_channel(std::uint16_t id, Bytes record) {
  channels_.emplace(id, std::move(record));
}

void SummaryBuilder::add_chunk(const mcap::ChunkIndex& index,
                               const std::map<std::uint16_t, std::uint64_t>& channel_messages) {
  start_ = chunks_ == 0 ? index.start : std::min(start_, index.start);
  end_ = std::max(end_, index.end);
  ++chunks_;
  for (const auto& [channel, messages] : channel_messages) channel_messages_[channel] += messages;
  mcap::append(chunk_indexes_, index);
}

void SummaryBuilder::add_attachment(const mcap::AttachmentIndex& index) {
  ++attachments_;
  mcap::append(attachment_indexes_, index);
}

mcap::Statistics SummaryBuilder::statistics() const {
  mcap::Statistics statistics;
  for (const auto& [channel, messages] : channel_messages_) {
    statistics.messages += messages;
    statistics.channel_messages.emplace_back(channel, messages);
  }
  statistics.schemas = static_cast<std::uint16_t>(schemas_.size());
  statistics.channels = static_cast<std::uint32_t>(channels_.size());
  statistics.attachments = attachments_;
  statistics.chunks = chunks_;
  statistics.start = start_;
  statistics.end = end_;
  return statistics;
}

Bytes SummaryBuilder::end(std::uint64_t offset, std::uint32_t crc) const {
  Bytes out;
  mcap::append_data_end(out, crc);
  const std::size_t summary = out.size();
  std::vector<mcap::SummaryOffset> groups;
  // Records that `append` adds form one group.
  const auto group = [&](mcap::Op op, const auto& append) {
    const std::size_t start = out.size();
    append();
    if (out.size() != start) groups.push_back({op, offset + start, out.size() - start});
  };
  const auto put = [&](const Bytes& records) {
    out.insert(out.end(), records.begin(), records.end());
  };
  group(mcap::Op::schema, [&] {
    for (const auto& [id, record] : schemas_) put(record);
  });
  group(mcap::Op::channel, [&] {
    for (const auto& [id, record] : channels_) put(record);
  });
  group(mcap::Op::statistics, [&] { mcap::append(out, statistics()); });
  group(mcap::Op::chunk_index, [&] { put(chunk_indexes_); });
  group(mcap::Op::attachment_index, [&] { put(attachment_indexes_); });
  const std::size_t offsets = out.size();
  for (const mcap::SummaryOffset& each : groups) mcap::append(out, each);
  mcap::append_footer(out,
                      {offset + summary, offset + offsets, crc32(std::span(out).subspan(summary))});
  for (const std::uint8_t octet : mcap::kMagic) out.push_back(octet);
  return out;
}

}  // namespace skerry::recording
