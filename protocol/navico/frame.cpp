#include "protocol/navico/frame.hpp"

#include <fmt/format.h>

#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

constexpr std::uint16_t kHeadingTrue = 0x4000, kHeadingUnits = 0x0FFF;

WireError wrong_frame(WireErrorKind kind, std::size_t offset, std::string text) {
  return {kind, offset, "Navico frame: " + std::move(text)};
}

}  // namespace

Result<std::vector<FrameSpoke>, WireError> decode_frame(Model model,
                                                        std::span<const std::uint8_t> datagram) {
  if (datagram.size() < kFrameHeader + kSpokeOctets) {
    return Failure{wrong_frame(WireErrorKind::truncated, datagram.size(),
                               fmt::format("{} octets, expected {} or more", datagram.size(),
                                           kFrameHeader + kSpokeOctets))};
  }
  if (datagram.size() > kFrameOctets) {
    return Failure{
        wrong_frame(WireErrorKind::oversized, kFrameOctets,
                    fmt::format("{} octets, expected at most {}", datagram.size(), kFrameOctets))};
  }
  const std::size_t spokes = datagram[5];
  if (datagram[0] != 1 || little_endian_at<std::uint16_t>(datagram, 6) != kSpokeCells / 2) {
    return Failure{wrong_frame(WireErrorKind::malformed, 0,
                               "does not begin 01, or spokes are not of 512 "
                               "octets")};
  }
  if (spokes * kSpokeOctets + kFrameHeader != datagram.size()) {
    return Failure{wrong_frame(WireErrorKind::malformed, 5,
                               fmt::format("{} spokes in {} octets", spokes, datagram.size()))};
  }
  std::vector<FrameSpoke> out(spokes);
  for (std::size_t i = 0; i < spokes; ++i) {
    const std::size_t at = kFrameHeader + i * kSpokeOctets;
    const auto header = datagram.subspan(at, kSpokeHeader);
    if (header[0] != kSpokeHeader) {
      return Failure{wrong_frame(WireErrorKind::malformed, at,
                                 fmt::format("spoke header of {} octets, expected 24", header[0]))};
    }
    SpokeFields& fields = out[i].fields;
    fields.status = header[1];
    fields.scan = little_endian_at<std::uint16_t>(header, 2);
    fields.angle = little_endian_at<std::uint16_t>(header, 8);
    fields.heading = little_endian_at<std::uint16_t>(header, 10);
    fields.rotation = little_endian_at<std::uint16_t>(header, 14);
    fields.reach = reach_of(model, header);
    if (fields.angle >= kTurnUnits) {
      return Failure{wrong_frame(WireErrorKind::malformed, at + 8,
                                 fmt::format("angle {}, expected less than 4096", fields.angle))};
    }
    const auto octets = datagram.subspan(at + kSpokeHeader, kSpokeCells / 2);
    for (std::size_t c = 0; c < octets.size(); ++c) {
      out[i].cells[2 * c] = octets[c] & 0x0F;
      out[i].cells[2 * c + 1] = octets[c] >> 4;
    }
  }
  return out;
}

std::optional<SpokeHeading> heading_of(std::uint16_t field) {
  if ((field & ~(kHeadingTrue | kHeadingUnits)) != 0) return std::nullopt;
  return SpokeHeading{static_cast<std::uint16_t>(field & kHeadingUnits),
                      (field & kHeadingTrue) != 0};
}

std::uint16_t heading_field(TrueBearing heading) {
  return static_cast<std::uint16_t>(kHeadingTrue | heading.nearest_spoke(kTurnUnits));
}

void append_frame_header(Bytes& out, std::size_t spokes) {
  const std::uint8_t header[kFrameHeader] = {1,    0,   0, 0, 0, static_cast<std::uint8_t>(spokes),
                                             0x00, 0x02};
  out.insert(out.end(), std::begin(header), std::end(header));
}

void append_spoke(Bytes& out, const SpokeFields& fields, const SpokeRange& range, Model model,
                  std::span<const std::uint8_t, kSpokeCells / 2> nibbles) {
  std::array<std::uint8_t, kSpokeHeader> header{};
  header[0] = kSpokeHeader;
  header[1] = fields.status;
  put_little_endian(header, 2, fields.scan, 2);
  for (std::size_t i = 0; i < range.at_4.size(); ++i) header[4 + i] = range.at_4[i];
  put_little_endian(header, 8, fields.angle, 2);
  put_little_endian(header, 10, fields.heading, 2);
  for (std::size_t i = 0; i < range.at_12.size(); ++i) header[12 + i] = range.at_12[i];
  if (is_first_generation(model)) {
    // The same in every spoke of the recordings.
    header[15] = 0x01;
    header[17] = 0x44;
    header[21] = 0x40;
    header[23] = 0xC3;
  } else {
    put_little_endian(header, 14, fields.rotation, 2);
    header[19] = 0x80;
    header[23] = 0xA0;
  }
  out.insert(out.end(), header.begin(), header.end());
  out.insert(out.end(), nibbles.begin(), nibbles.end());
}

void pack_cells(std::span<const std::uint8_t, kSpokeCells> cells,
                std::span<std::uint8_t, kSpokeCells / 2> nibbles) {
  // ceil(cell / 17) in 16 bits: (x * 241) >> 12 is floor(x / 17) for every x below 4080.
  const auto nibble = [](std::uint8_t cell) {
    return static_cast<std::uint16_t>(static_cast<std::uint16_t>((cell + 16) * 241) >> 12);
  };
  for (std::size_t i = 0; i < nibbles.size(); ++i) {
    nibbles[i] = static_cast<std::uint8_t>(nibble(cells[2 * i]) | nibble(cells[2 * i + 1]) << 4);
  }
}

void pack_nibbles(std::span<const std::uint8_t, kSpokeCells> cells,
                  std::span<std::uint8_t, kSpokeCells / 2> nibbles) {
  for (std::size_t i = 0; i < nibbles.size(); ++i) {
    nibbles[i] = static_cast<std::uint8_t>((cells[2 * i] & 0x0F) | cells[2 * i + 1] << 4);
  }
}

}  // namespace skerry::navico
