#include "server/net/encoders.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>

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

std::string summary_text(const SpokeHeader& h) {
  return fmt::format("Skerry radar {} scan {}: {} NM, {} spokes, {} cells", h.radar, h.scan,
                     h.range_scale.in_nautical_miles(), h.geometry.spokes_per_turn,
                     h.geometry.cells);
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

SectorEncoder cat240_encoder(Cat240Source source) {
  return [source, message_index = std::uint32_t{0}, summarised = std::optional<std::uint32_t>()](
             const Sector& sector) mutable -> EncodedSectorPtr {
    const auto encoded = begin_sector(sector);
    for (const SpokePtr& spoke : sector.spokes) {
      const SpokeHeader& header = spoke->header;
      if (summarised != header.scan) {
        append_cat240_summary(encoded->bytes, summary_text(header), source, header.utc);
        summarised = header.scan;
      }
      append_cat240_video(encoded->bytes, *spoke, source, message_index++);
      end_spoke(*encoded);
    }
    return encoded;
  };
}

void add_network_formats(VideoChannel& channel, Cat240Source source) {
  channel.add_format(kNativeFormat, native_encoder());
  channel.add_format(kCat240Format, cat240_encoder(source));
}

}  // namespace skerry::server
