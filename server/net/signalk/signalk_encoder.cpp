#include "server/net/signalk/signalk_encoder.hpp"

#include <algorithm>
#include <memory>
#include <optional>

#include "protocol/signalk/radar_message.hpp"
#include "protocol/video/spoke_resampler.hpp"

namespace skerry::server {

SignalkShape signalk_shape(std::uint32_t turn_spokes, std::uint32_t cells) {
  const SignalkShape finest;
  return {std::min(turn_spokes, finest.turn_spokes), std::min(cells, finest.cells)};
}

SignalkShape signalk_shape(const ScanGeometry& geometry) {
  return signalk_shape(geometry.spokes_per_turn, geometry.cells);
}

SectorEncoder signalk_encoder() {
  return [resampler = std::optional<SpokeResampler>(),
          next = std::uint64_t{0}](const Sector& sector) mutable -> EncodedSectorPtr {
    const SpokeHeader& first = sector.spokes.front()->header;
    const SignalkShape shape = signalk_shape(first.geometry);
    // A spoke begun before nobody watched belongs to an earlier time.
    if (!resampler || first.sequence != next) resampler.emplace(shape.turn_spokes, shape.cells);
    next = sector.spokes.back()->header.sequence + 1;

    const auto encoded = std::make_shared<EncodedSector>();
    encoded->first_sequence = first.sequence;
    encoded->scan = first.scan;
    encoded->bytes.reserve(sector.spokes.size() * (shape.cells + 64));
    for (const SpokePtr& source : sector.spokes) {
      resampler->add(*source, [&](const ResampledSpoke& resampled) {
        signalk::RadarSpoke spoke = signalk::radar_spoke(resampled.header);
        spoke.cells = resampled.cells;
        spoke.doppler = resampled.doppler;
        signalk::append_radar_spoke(encoded->bytes, spoke);
        encoded->spoke_ends.push_back(static_cast<std::uint32_t>(encoded->bytes.size()));
      });
    }
    return encoded;
  };
}

}  // namespace skerry::server
