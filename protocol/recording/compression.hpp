// How a chunk's records are compressed: not, as an LZ4 frame, or as a Zstandard frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/quantity/result.hpp"
#include "protocol/recording/octet_block.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::recording {

// "", "lz4", "zstd", as MCAP names them.
std::string_view mcap_name_of(Compression compression);
std::optional<Compression> compression_of_mcap_name(std::string_view name);

// Octets of a chunk's records, before compression: no more are written, none is read that says
// more.
inline constexpr std::size_t kMaxChunkBytes = 64 << 20;

// Memory: what the library needs, kept from chunk to chunk.  Thread: one at a time.
class Compressor {
 public:
  Compressor(Compression compression, int zstd_level);
  ~Compressor();
  Compressor(Compressor&&) noexcept;
  Compressor& operator=(Compressor&&) noexcept;

  // The most that `size` octets become.
  std::size_t bound(std::size_t size) const;
  // Requires room for bound(in.size()).  The octets written; nothing if the library failed.
  std::optional<std::size_t> compress(std::span<const std::uint8_t> in,
                                      std::span<std::uint8_t> out);

 private:
  struct Contexts;
  Compression compression_;
  int level_;
  std::unique_ptr<Contexts> contexts_;
};

// False if `in` cannot hold that much: asked before the room for it is taken.
bool plausible(Compression compression, std::size_t compressed, std::uint64_t uncompressed);
// All of `in` must become exactly `size` octets.  Error: what is wrong with it.
Result<OctetBlock, std::string> decompress(Compression compression,
                                           std::span<const std::uint8_t> in, std::size_t size);

}  // namespace skerry::recording
