#include "server/net/encoders.hpp"

#include <cstdint>
#include <span>

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

void add_network_formats(VideoChannel& channel, Cat240Source source) {
  channel.add_format(kNativeFormat, native_encoder());
  channel.add_format(kCat240Format, cat240_encoder({.options = {.source = source, .bits = {}}}));
}

}  // namespace skerry::server
