#include "clients/interchange/interchange_file.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace skerry::client {
namespace {

constexpr std::size_t kChunkBytes = 1 << 20;
constexpr int kZstdLevel = 3;

}  // namespace

InterchangeFile::InterchangeFile(recording::ByteSink sink, std::string profile)
    : file_(std::move(sink), std::move(profile), recording::Compression::zstd, kZstdLevel) {
  taken_ = file_.begin();
}

std::uint16_t InterchangeFile::add_channel(const recording::ChannelText& text) {
  const auto number = file_.add_channel(text);
  if (!number) throw std::length_error("an MCAP file has at most 65536 channels");
  sequences_.push_back(0);
  return *number;
}

void InterchangeFile::add(std::uint16_t channel, UtcTime time,
                          std::span<const std::uint8_t> message) {
  if (!chunk_.empty() && chunk_.records().size() + message.size() > kChunkBytes) flush();
  const auto ns = std::max<std::int64_t>(time.time_since_epoch().count(), 0);
  chunk_.use_channel(channel, file_.record_of(channel));
  const auto room = chunk_.add_message(channel, sequences_[channel]++,
                                       static_cast<std::uint64_t>(ns), message.size());
  std::copy(message.begin(), message.end(), room.begin());
}

void InterchangeFile::add(std::uint16_t channel, UtcTime time, const std::string& message) {
  add(channel, time, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()});
}

void InterchangeFile::flush() {
  if (!chunk_.empty()) taken_ = file_.write(chunk_) && taken_;
  chunk_.clear();
}

bool InterchangeFile::finish() {
  flush();
  return file_.end() && taken_;
}

}  // namespace skerry::client
