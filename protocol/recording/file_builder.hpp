// FileBuilder: a recording as an MCAP file: its channels, and what it says of itself at its end.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "protocol/recording/chunk_builder.hpp"
#include "protocol/recording/mcap_file.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/recording/topics.hpp"

namespace skerry::recording {

inline constexpr char kProfile[] = "skerry";
// The attachment that holds the Contents of a finished file.
inline constexpr char kContentsName[] = "skerry.contents";
inline constexpr char kContentsType[] = "application/x-protobuf";
// Marks in the Contents, and in a reader's summary: no more are kept.
inline constexpr std::size_t kMaxMarks = 100'000;

// Memory: that of a compressed chunk, and of the summary.  Thread: one at a time.
class FileBuilder {
 public:
  FileBuilder(ByteSink sink, Compression compression, int zstd_level);

  // A number of its own for each; nothing when there are too many for 16 bits.
  std::optional<std::uint16_t> channel(const ChannelKind& kind);
  std::span<const std::uint8_t> record_of(std::uint16_t channel) const {
    return file_.record_of(channel);
  }

  // As of McapFile.
  bool begin() { return file_.begin(); }
  bool write(const ChunkBuilder& chunk);
  bool attach(const Attachment& attachment) { return file_.attach(attachment); }
  bool finish();

  std::uint64_t bytes() const { return file_.bytes(); }

 private:
  void count(const ChunkBuilder& chunk);

  McapFile file_;
  std::map<ChannelKind, std::uint16_t> numbers_;
  std::map<Topic, std::uint64_t> items_;
  Contents contents_;
};

}  // namespace skerry::recording
