#include "protocol/captures/picture_decoder.hpp"

#include "protocol/asterix/cat240.hpp"
#include "protocol/furuno/spoke_frame.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/rd_packets.hpp"
#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/datagram.hpp"

namespace skerry::captures {
namespace {

using Octets = std::span<const std::uint8_t>;

bool is_navico_frame(Octets payload) {
  return payload.size() >= navico::kFrameHeader + navico::kSpokeOctets && payload[0] == 1 &&
         little_endian_at<std::uint16_t>(payload, 6) == navico::kSpokeCells / 2 &&
         payload.size() == navico::kFrameHeader + payload[5] * navico::kSpokeOctets;
}

// The SAC and SIC of the first video record; nothing if it is no CAT240 datagram with one.
std::optional<std::uint16_t> cat240_source(Octets payload) {
  if (payload.size() < 8 || payload[0] != kCat240) return std::nullopt;
  const auto records = decode_cat240(payload);
  if (!records) return std::nullopt;
  for (const Cat240Record& record : *records) {
    if (record.video) {
      return static_cast<std::uint16_t>(record.source.sac << 8 | record.source.sic);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<PictureKey> picture_of(const pcap::Datagram& datagram) {
  const Octets payload = datagram.payload;
  if (payload.size() < 8) return std::nullopt;
  PictureKey key{Family::navico, datagram.from.address, datagram.to, 0};
  if (is_navico_frame(payload)) return key;
  if (const auto native = decode_datagram_header(payload)) {
    key.family = Family::native;
    key.source =
        static_cast<std::uint16_t>((native->spoke.radar & 255) << 8 | (native->spoke.view & 255));
    return key;
  }
  const auto type = little_endian_at<std::uint32_t>(payload, 0);
  if (type == static_cast<std::uint32_t>(garmin::Type::spoke)) {
    key.family = Family::garmin;
  } else if (type == raymarine::kQuantumSpokeType) {
    key.family = Family::quantum;
  } else if (type == raymarine::kRdSpokesType) {
    key.family = Family::rd;
  } else if (furuno::is_spoke_frame(payload)) {
    key.family = Family::furuno;
    key.source = (payload[15] & 0x40) != 0 ? 1 : 0;
  } else if (const auto source = cat240_source(payload)) {
    key.family = Family::cat240;
    key.source = *source;
  } else {
    return std::nullopt;
  }
  return key;
}

std::unique_ptr<PictureDecoder> make_picture(const PictureTraits& traits) {
  switch (traits.key.family) {
    case Family::navico:
      return make_navico_picture(traits);
    case Family::garmin:
      return make_garmin_picture(traits);
    case Family::quantum:
      return make_quantum_picture(traits);
    case Family::rd:
      return make_rd_picture(traits);
    case Family::furuno:
      return make_furuno_picture(traits);
    case Family::native:
      return make_native_picture(traits);
    case Family::cat240:
      break;
  }
  return make_cat240_picture(traits);
}

wire::Settings told_settings(const PictureDecoder& decoder, std::uint32_t radar,
                             const SpokeHeader& last, double rpm) {
  wire::Settings settings = decoder.settings();
  settings.set_radar(radar);
  settings.set_range_nm(last.range_scale.in_nautical_miles());
  settings.set_radar_range_nm(settings.range_nm());
  settings.set_instrumented_range_m(last.reach().in_metres());
  settings.set_rotation_rpm(rpm);
  return settings;
}

}  // namespace skerry::captures
