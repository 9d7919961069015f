// InterchangeFile: messages of any schema -> the bytes of an MCAP file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/recording/mcap_file.hpp"

namespace skerry::client {

// Memory: a chunk of 1 MiB, or one message, and its compressed form.  Thread: one at a time.
class InterchangeFile {
 public:
  // `profile` as of McapFile.
  InterchangeFile(recording::ByteSink sink, std::string profile);

  // Of a new channel.  Errors: std::length_error after 65536 of them.
  std::uint16_t add_channel(const recording::ChannelText& text);
  // Any order of times is taken.
  void add(std::uint16_t channel, UtcTime time, std::span<const std::uint8_t> message);
  void add(std::uint16_t channel, UtcTime time, const std::string& message);

  // Ends the file.  False if the sink took not all of it; the file is then of no use.
  bool finish();

 private:
  void flush();

  recording::McapFile file_;
  recording::ChunkBuilder chunk_;
  std::vector<std::uint32_t> sequences_;  // by channel
  bool taken_ = true;
};

}  // namespace skerry::client
