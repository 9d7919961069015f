#include "protocol/recording/compression.hpp"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>

namespace skerry::recording {
namespace {

// LZ4's fastest that still finds what radar video has to find; a lower one gains no speed and loses
// ratio (recording_bench).
constexpr int kLz4Level = -1;

LZ4F_preferences_t lz4_preferences(std::size_t size) {
  LZ4F_preferences_t preferences{};
  preferences.frameInfo.blockSizeID = LZ4F_max4MB;
  preferences.frameInfo.contentSize = size;
  preferences.compressionLevel = kLz4Level;
  return preferences;
}

struct FreeZstdReader {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};
struct FreeLz4Reader {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};

constexpr std::size_t kLeastShare = 16;  // of a block's room that its octets take

// The most octets of a frame's block, unpacked.
std::size_t block_bytes(LZ4F_blockSizeID_t size) {
  switch (size) {
    case LZ4F_max256KB:
      return 256 << 10;
    case LZ4F_max1MB:
      return 1 << 20;
    case LZ4F_max4MB:
      return 4 << 20;
    default:
      return 64 << 10;
  }
}

Result<OctetBlock, std::string> read_lz4(std::span<const std::uint8_t> in, std::size_t size) {
  const auto fail = [](std::size_t error) {
    return Failure{fmt::format("LZ4 frame: {}", LZ4F_getErrorName(error))};
  };
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) {
    return Failure{std::string("no memory")};
  }
  const std::unique_ptr<LZ4F_dctx, FreeLz4Reader> context(made);
  LZ4F_frameInfo_t info{};
  std::size_t taken = in.size(), given = 0;
  std::size_t left = LZ4F_getFrameInfo(context.get(), &info, in.data(), &taken);
  if (LZ4F_isError(left)) return fail(left);
  // A block that has room is unpacked in place and not copied, the last one too; except blocks of a
  // few octets, of which there may be many.
  const std::size_t block = block_bytes(info.blockSizeID);
  OctetBlock out(size, size < block / kLeastShare ? 0 : (size + block - 1) / block * block);
  LZ4F_decompressOptions_t options{};
  options.stableDst = 1;
  while (left != 0) {
    std::size_t room = out.room().size() - given, source = in.size() - taken;
    left = LZ4F_decompress(context.get(), out.room().data() + given, &room, in.data() + taken,
                           &source, &options);
    if (LZ4F_isError(left)) return fail(left);
    if (room == 0 && source == 0) {
      return Failure{std::string("LZ4 frame: it does not end where it should")};
    }
    taken += source;
    given += room;
  }
  if (taken != in.size() || given != size) {
    return Failure{fmt::format("LZ4 frame: {} of {} octets became {}, expected {}", taken,
                               in.size(), given, size)};
  }
  return out;
}

Result<OctetBlock, std::string> read_zstd(std::span<const std::uint8_t> in, std::size_t size) {
  const std::unique_ptr<ZSTD_DCtx, FreeZstdReader> context(ZSTD_createDCtx());
  if (!context) return Failure{std::string("no memory")};
  OctetBlock out(size);
  const std::size_t given =
      ZSTD_decompressDCtx(context.get(), out.room().data(), size, in.data(), in.size());
  if (ZSTD_isError(given)) {
    return Failure{fmt::format("Zstandard frame: {}", ZSTD_getErrorName(given))};
  }
  if (given != size) {
    return Failure{fmt::format("Zstandard frame: it became {} octets, expected {}", given, size)};
  }
  return out;
}

}  // namespace

std::string_view mcap_name_of(Compression compression) {
  switch (compression) {
    case Compression::none:
      return "";
    case Compression::lz4:
      return "lz4";
    case Compression::zstd:
      break;
  }
  return "zstd";
}

std::optional<Compression> compression_of_mcap_name(std::string_view name) {
  for (const Compression c : {Compression::none, Compression::lz4, Compression::zstd}) {
    if (name == mcap_name_of(c)) return c;
  }
  return std::nullopt;
}

struct Compressor::Contexts {
  struct FreeZstd {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  };
  std::unique_ptr<ZSTD_CCtx, FreeZstd> zstd;
};

Compressor::Compressor(Compression compression, int zstd_level)
    : compression_(compression), level_(zstd_level), contexts_(std::make_unique<Contexts>()) {
  if (compression_ != Compression::zstd) return;
  contexts_->zstd.reset(ZSTD_createCCtx());
  ZSTD_CCtx_setParameter(contexts_->zstd.get(), ZSTD_c_compressionLevel, level_);
}

Compressor::~Compressor() = default;
Compressor::Compressor(Compressor&&) noexcept = default;
Compressor& Compressor::operator=(Compressor&&) noexcept = default;

std::size_t Compressor::bound(std::size_t size) const {
  switch (compression_) {
    case Compression::none:
      return size;
    case Compression::lz4: {
      const LZ4F_preferences_t preferences = lz4_preferences(size);
      return LZ4F_compressFrameBound(size, &preferences);
    }
    case Compression::zstd:
      break;
  }
  return ZSTD_compressBound(size);
}

std::optional<std::size_t> Compressor::compress(std::span<const std::uint8_t> in,
                                                std::span<std::uint8_t> out) {
  if (compression_ == Compression::none) {
    std::memcpy(out.data(), in.data(), in.size());
    return in.size();
  }
  if (compression_ == Compression::lz4) {
    const LZ4F_preferences_t preferences = lz4_preferences(in.size());
    const std::size_t size =
        LZ4F_compressFrame(out.data(), out.size(), in.data(), in.size(), &preferences);
    if (LZ4F_isError(size)) return std::nullopt;
    return size;
  }
  if (!contexts_->zstd) return std::nullopt;
  const std::size_t size =
      ZSTD_compress2(contexts_->zstd.get(), out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(size)) return std::nullopt;
  return size;
}

bool plausible(Compression compression, std::size_t compressed, std::uint64_t uncompressed) {
  if (uncompressed > kMaxChunkBytes) return false;
  switch (compression) {
    case Compression::none:
      return uncompressed == compressed;
    case Compression::lz4:
      // A byte of a match's length stands for 255 octets at most.
      return uncompressed <= 255 * std::uint64_t{compressed};
    case Compression::zstd:
      break;
  }
  // A block of a repeated octet takes four and stands for at most 128 KiB.
  return uncompressed <= std::uint64_t{compressed} * (128 << 10) / 4;
}

Result<OctetBlock, std::string> decompress(Compression compression,
                                           std::span<const std::uint8_t> in, std::size_t size) {
  if (!plausible(compression, in.size(), size)) {
    return Failure{fmt::format("{} octets said to come of {} of compression \"{}\"", size,
                               in.size(), mcap_name_of(compression))};
  }
  if (compression == Compression::none) {
    OctetBlock out(size);
    std::copy(in.begin(), in.end(), out.room().begin());
    return out;
  }
  return compression == Compression::lz4 ? read_lz4(in, size) : read_zstd(in, size);
}

}  // namespace skerry::recording
