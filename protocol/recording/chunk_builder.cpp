#include "protocol/recording/chunk_builder.hpp"

#include <algorithm>

#include "protocol/recording/mcap_records.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::recording {

void ChunkBuilder::use_channel(std::uint16_t channel, std::span<const std::uint8_t> record) {
  if (index_.size() <= channel) index_.resize(channel + 1U);
  if (!index_[channel].empty()) return;
  records_.insert(records_.end(), record.begin(), record.end());
}

std::span<std::uint8_t> ChunkBuilder::add_message(std::uint16_t channel, std::uint32_t sequence,
                                                  std::uint64_t time_ns, std::size_t size) {
  append_little_endian(index_[channel], time_ns, 8);
  append_little_endian(index_[channel], records_.size(), 8);
  start_ = messages_ == 0 ? time_ns : std::min(start_, time_ns);
  end_ = messages_ == 0 ? time_ns : std::max(end_, time_ns);
  ++messages_;
  ++contents_.channel_messages[channel];
  mcap::append_message_head(records_, {channel, sequence, time_ns, {}}, size);
  records_.resize(records_.size() + size);
  return std::span(records_).last(size);
}

void ChunkBuilder::count(const Topic& topic, std::uint64_t last_time_ns, std::uint64_t count) {
  contents_.items[topic] += count;
  contents_.all_items += count;
  if (topic.kind == Kind::spoke) contents_.spokes += count;
  contents_.last_time = std::max(contents_.last_time, last_time_ns);
}

void ChunkBuilder::mark(std::uint64_t time_ns, const Event& event) {
  Contents::Mark& mark = contents_.marks.emplace_back();
  mark.set_utc_ns(time_ns);
  mark.set_name(event.text());
  mark.set_kind(event.mark_kind());
}

std::vector<std::pair<std::uint16_t, std::uint64_t>> ChunkBuilder::append_indexes(
    Bytes& out, std::uint64_t offset) const {
  std::vector<std::pair<std::uint16_t, std::uint64_t>> places;
  const std::size_t begin = out.size();
  for (std::size_t channel = 0; channel < index_.size(); ++channel) {
    if (index_[channel].empty()) continue;
    places.emplace_back(static_cast<std::uint16_t>(channel), offset + out.size() - begin);
    mcap::append_message_index(out, static_cast<std::uint16_t>(channel), index_[channel]);
  }
  return places;
}

void ChunkBuilder::clear() {
  records_.clear();
  for (Bytes& entries : index_) entries.clear();
  messages_ = 0;
  contents_ = {};
}

}  // namespace skerry::recording
