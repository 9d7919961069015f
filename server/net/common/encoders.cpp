#include "server/net/common/encoders.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "protocol/thin/thin_encoder.hpp"
#include "protocol/video/spoke_resampler.hpp"
#include "protocol/wire/frame.hpp"

namespace skerry::server {
namespace {

// Room for a spoke's header in any format; more only costs a second allocation.
constexpr std::size_t kHeaderRoom = 128;

std::shared_ptr<EncodedSector> begin_sector(const Sector& sector) {
  auto encoded = std::make_shared<EncodedSector>();
  const SpokeHeader& first = sector.spokes.front()->header;
  encoded->first_sequence = first.sequence;
  encoded->scan = first.scan;
  encoded->spoke_ends.reserve(sector.spokes.size());
  encoded->bytes.reserve(sector.spokes.size() * (first.geometry.cells + kHeaderRoom));
  return encoded;
}

void end_spoke(EncodedSector& encoded) {
  encoded.spoke_ends.push_back(static_cast<std::uint32_t>(encoded.bytes.size()));
}

}  // namespace

SectorEncoder native_encoder() {
  return [](const Sector& sector) -> EncodedSectorPtr {
    const auto encoded = begin_sector(sector);
    for (const SpokePtr& spoke : sector.spokes) {
      append_spoke_frame(encoded->bytes, *spoke);
      end_spoke(*encoded);
    }
    return encoded;
  };
}

std::string thin_format(std::uint32_t level) { return "thin-" + std::to_string(level); }

SectorEncoder thin_encoder(std::uint32_t level) {
  // Shared: a std::function is copyable.
  return [stream = std::make_shared<ThinEncoder>(level),
          message = wire::ServerMessage()](const Sector& sector) mutable -> EncodedSectorPtr {
    const auto encoded = begin_sector(sector);
    encoded->first_sequence = stream->next();
    for (const SpokePtr& spoke : sector.spokes) {
      stream->add(*spoke, [&](const wire::ThinSpokes& block) {
        *message.mutable_thin_spokes() = block;
        append_frame(encoded->bytes, message);
      });
      end_spoke(*encoded);
    }
    return encoded;
  };
}

std::string native_format(std::uint32_t thin) {
  return thin == 0 ? kNativeFormat : thin_format(thin);
}

void add_native_formats(VideoChannel& channel) {
  channel.add_format(kNativeFormat, native_encoder());
  for (std::uint32_t level = 1; level <= kThinLevels; ++level) {
    channel.add_format(thin_format(level), thin_encoder(level));
  }
}

namespace {

// A cell of `from` bits as one of `to`: the highest bits of more, fewer so that the strongest stay
// so.
std::uint8_t cell_of(std::uint8_t cell, std::uint32_t from, std::uint32_t to) {
  if (from == to) return cell;
  return static_cast<std::uint8_t>(from > to ? cell >> 4 : (cell & 15) * 17);
}

class NativeStream {
 public:
  explicit NativeStream(const NativeShape& shape) : shape_(shape) {}

  void add(const Spoke& spoke, EncodedSector& out) {
    const ScanGeometry& source = spoke.header.geometry;
    if (!resampler_ || source_ != source) {
      source_ = source;
      resampler_.emplace(shape_.turn_spokes != 0 ? shape_.turn_spokes : source.spokes_per_turn,
                         shape_.cells != 0 ? shape_.cells : source.cells);
    }
    resampler_->add(spoke, [&](const ResampledSpoke& made) { give(made, out); });
  }
  std::uint64_t next() const { return sequence_; }

 private:
  void give(const ResampledSpoke& made, EncodedSector& out) {
    const std::uint32_t bits = made.header.geometry.bits;
    spoke_.header = made.header;
    spoke_.header.geometry.bits = shape_.bits != 0 ? shape_.bits : bits;
    spoke_.header.sequence = sequence_++;
    spoke_.cells.resize(made.cells.size());
    for (std::size_t c = 0; c < made.cells.size(); ++c) {
      spoke_.cells[c] = cell_of(made.cells[c], bits, spoke_.header.geometry.bits);
    }
    spoke_.doppler.assign(made.doppler.begin(), made.doppler.end());
    append_spoke_frame(out.bytes, spoke_);
    end_spoke(out);
  }

  NativeShape shape_;
  ScanGeometry source_;
  std::optional<SpokeResampler> resampler_;
  std::uint64_t sequence_ = 0;
  Spoke spoke_;
};

}  // namespace

SectorEncoder native_encoder(const NativeShape& shape) {
  if (shape == NativeShape{}) return native_encoder();
  return [stream = NativeStream(shape)](const Sector& sector) mutable -> EncodedSectorPtr {
    const auto encoded = begin_sector(sector);
    encoded->first_sequence = stream.next();
    for (const SpokePtr& spoke : sector.spokes) stream.add(*spoke, *encoded);
    return encoded;
  };
}

SectorEncoder cat240_encoder(const Cat240StreamShape& shape) {
  return [stream = Cat240Stream(shape)](const Sector& sector) mutable -> EncodedSectorPtr {
    const auto encoded = begin_sector(sector);
    for (const SpokePtr& spoke : sector.spokes) {
      stream.add(*spoke, [&](std::span<const std::uint8_t> datagram) {
        encoded->bytes.insert(encoded->bytes.end(), datagram.begin(), datagram.end());
      });
      end_spoke(*encoded);
    }
    return encoded;
  };
}

}  // namespace skerry::server
