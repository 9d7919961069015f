// FileIndex: where the chunks of a file are and what is in them, as its summary says or a search
// found.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/input_file.hpp"
#include "protocol/recording/mcap_records.hpp"
#include "protocol/recording/topics.hpp"

namespace skerry::recording {

// A file that says it has more is not believed.
inline constexpr std::size_t kMaxChunks = 1'000'000;
// Channels of all chunks together, for the same reason.
inline constexpr std::size_t kMaxChunkChannels = 16'000'000;
inline constexpr std::size_t kMaxAttachments = 100'000;
// Octets of a schema's name that are kept; ours are shorter.
inline constexpr std::size_t kMaxName = 256;
// Octets of Schema and Channel records, and of what else is read as one record.
inline constexpr std::size_t kMaxRecord = 1 << 20;

struct ChunkPlace {
  std::uint64_t offset = 0, length = 0;  // of its record, with its head
  std::int64_t start = 0, end = 0;       // of the times of its messages, ns since 1970
  std::uint32_t uncompressed = 0;        // octets of its records
  std::uint32_t channels = 0;            // how many, in FileIndex::chunk_channels
  std::uint64_t first_channel = 0;       // from there
};

// The kinds of a file's channels, without channels of other programs.
using Channels = std::map<std::uint16_t, ChannelKind>;
using Schemas = std::map<std::uint16_t, std::string>;  // names

struct FileIndex {
  std::string profile;
  Schemas schemas;
  Channels channels;
  std::vector<ChunkPlace> chunks;                   // in the order of the file
  std::vector<std::uint16_t> chunk_channels;        // with messages in a chunk
  std::map<std::uint16_t, std::uint64_t> messages;  // by channel
  std::vector<RecordPlace> attachments;
  bool whole = false;  // as its summary says
  // Found by a search: octets that belong to no record, or to a chunk that cannot be read.
  std::uint64_t chunks_unreadable = 0;
  std::uint64_t bytes_unreadable = 0;
  std::optional<RecordingError> damage;

  std::span<const std::uint16_t> channels_of(const ChunkPlace& chunk) const {
    return std::span(chunk_channels).subspan(chunk.first_channel, chunk.channels);
  }
  // Takes a channel of ours.  Those of others are left out; so are, in files that are not of our
  // profile, those of another schema than their name has.
  void add(const mcap::Channel& channel);
};

// ns since 1970 as a file has them; beyond the year 2262 that year's.
std::int64_t time_of(std::uint64_t ns);

// Reads the file's summary.  Error: there is none, or it is not credible.
Result<FileIndex, RecordingError> read_summary(const InputFile& file);
// Reads record by record, and goes on after parts that cannot be read.  Error: given up.
Result<FileIndex, RecordingError> search(const InputFile& file,
                                         const std::function<bool(double)>& progress);
// The beginning of a file.  Error: it is no recording.
Result<mcap::Header, RecordingError> read_beginning(const InputFile& file);

}  // namespace skerry::recording
