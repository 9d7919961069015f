#include "protocol/navico/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

constexpr std::uint8_t kReport = 0xC4;
constexpr std::size_t kStateOctets = 18, kControlOctets = 99, kIdentityOctets = 129,
                      kInstallationOctets = 66, kBlankingOctets = 68, kNewBlankingOctets = 74,
                      kAdvancedOctets = 18;
constexpr std::size_t kMaxReport = 2048;
// Offsets of the four sectors, five octets each.
constexpr std::size_t kInstallationSectors = 34, kBlankingSectors = 36, kNewBlankingSectors = 42;
constexpr std::size_t kFirmwareDate = 58, kFirmwareTime = 90, kFirmwareCharacters = 15;

Bytes begin_report(std::uint8_t kind, std::size_t octets) {
  Bytes out(octets);
  out[0] = kind;
  out[1] = kReport;
  return out;
}

void put_sectors(Bytes& out, std::size_t at, const BlankedSectors& sectors) {
  for (const BlankedSector& each : sectors) {
    out[at] = each.on ? 1 : 0;
    put_little_endian(out, at + 1, each.from, 2);
    put_little_endian(out, at + 3, each.to, 2);
    at += 5;
  }
}

BlankedSectors get_sectors(std::span<const std::uint8_t> in, std::size_t at) {
  BlankedSectors sectors;
  for (BlankedSector& each : sectors) {
    each.on = in[at] != 0;
    each.from = little_endian_at<std::uint16_t>(in, at + 1);
    each.to = little_endian_at<std::uint16_t>(in, at + 3);
    at += 5;
  }
  return sectors;
}

// UTF-16LE, of characters below 128.
void put_text(Bytes& out, std::size_t at, const std::string& text) {
  for (std::size_t i = 0; i < std::min(text.size(), kFirmwareCharacters); ++i) {
    out[at + 2 * i] = static_cast<std::uint8_t>(text[i]) & 0x7F;
  }
}

std::string get_text(std::span<const std::uint8_t> in, std::size_t at) {
  std::string text;
  for (std::size_t i = 0; i < kFirmwareCharacters; ++i) {
    const auto unit = little_endian_at<std::uint16_t>(in, at + 2 * i);
    if (unit == 0) break;
    text += unit < 128 ? static_cast<char>(unit) : '?';
  }
  return text;
}

StateReport read_state(std::span<const std::uint8_t> in) {
  // 3 is what BR24 and 3G say while the antenna comes up to speed.
  return {in[2] == 3 ? RadarState::spinning_up : static_cast<RadarState>(in[2])};
}

ControlReport read_controls(std::span<const std::uint8_t> in) {
  ControlReport report;
  report.range_dm = little_endian_at<std::uint32_t>(in, 2);
  report.mode = in[7];
  report.gain_auto = little_endian_at<std::uint32_t>(in, 8) > 0;
  report.gain = in[12];
  report.sea_auto = in[13];
  report.sea = in[17];
  report.rain = in[22];
  report.interference = in[34];
  report.expansion = in[38];
  report.boost = in[42];
  return report;
}

InstallationReport read_installation(std::span<const std::uint8_t> in) {
  InstallationReport report;
  report.bearing_alignment = little_endian_at<std::uint16_t>(in, 6);
  report.parking = little_endian_at<std::uint16_t>(in, 8);
  report.antenna_height_mm = little_endian_at<std::uint16_t>(in, 10);
  report.accent_light = in[19];
  report.sectors = get_sectors(in, kInstallationSectors);
  return report;
}

AdvancedReport read_advanced(std::span<const std::uint8_t> in) {
  AdvancedReport report;
  report.sea_state = in[2];
  report.local_interference = in[3];
  report.scan_speed = in[4];
  report.side_lobe_auto = in[5] != 0;
  report.side_lobe = in[9];
  report.noise_rejection = in[12];
  report.target_separation = in[13];
  if (in.size() == kAdvancedOctets) return report;
  report.halo_sea = in[14];
  report.halo_sea_adjust = static_cast<std::int8_t>(in[15]);
  report.doppler = in[18];
  report.doppler_threshold_cms = little_endian_at<std::uint16_t>(in, 19);
  return report;
}

WireError wrong_report(WireErrorKind kind, std::size_t offset, std::string text) {
  return {kind, offset, "Navico report: " + std::move(text)};
}

}  // namespace

Bytes encode(Model model, const StateReport& report) {
  Bytes out = begin_report(0x01, kStateOctets);
  out[2] = static_cast<std::uint8_t>(report.state);
  if (is_first_generation(model) && report.state == RadarState::spinning_up) {
    out[2] = 3;
    out[10] = 1;
  }
  return out;
}

Bytes encode(Model, const ControlReport& report) {
  Bytes out = begin_report(0x02, kControlOctets);
  put_little_endian(out, 2, report.range_dm, 4);
  out[7] = report.mode;
  out[8] = report.gain_auto ? 1 : 0;
  out[12] = report.gain;
  out[13] = report.sea_auto;
  out[17] = report.sea;
  out[22] = report.rain;
  out[34] = report.interference;
  out[38] = report.expansion;
  out[42] = report.boost;
  return out;
}

Bytes encode(Model, const IdentityReport& report) {
  Bytes out = begin_report(0x03, kIdentityOctets);
  out[2] = report.type;
  put_little_endian(out, 34, report.hours, 4);
  put_text(out, kFirmwareDate, report.firmware_date);
  put_text(out, kFirmwareTime, report.firmware_time);
  out[122] = 0x02;  // in all recordings
  return out;
}

Bytes encode(Model model, const InstallationReport& report) {
  Bytes out = begin_report(0x04, kInstallationOctets);
  put_little_endian(out, 6, report.bearing_alignment, 2);
  put_little_endian(out, 8, report.parking, 2);
  put_little_endian(out, 10, report.antenna_height_mm, 2);
  out[19] = report.accent_light;
  if (is_halo(model)) put_sectors(out, kInstallationSectors, report.sectors);
  return out;
}

Bytes encode(Model, const BlankingReport& report) {
  Bytes out = begin_report(0x06, kBlankingOctets);
  out[6] = 0x01;  // these five in all recordings
  out[8] = 0x0E;
  out[24] = 0x02;
  out[26] = 0x03;
  out[31] = 0x03;
  put_sectors(out, kBlankingSectors, report.sectors);
  return out;
}

Bytes encode(Model model, const AdvancedReport& report) {
  Bytes out = begin_report(0x08, model == Model::halo20 ? 22u
                                 : model == Model::halo ? 21u
                                                        : kAdvancedOctets);
  out[2] = report.sea_state;
  out[3] = report.local_interference;
  out[4] = report.scan_speed;
  out[5] = report.side_lobe_auto ? 1 : 0;
  out[9] = report.side_lobe;
  out[12] = report.noise_rejection;
  out[13] = report.target_separation;
  if (!is_halo(model)) return out;
  out[14] = report.halo_sea;
  out[15] = static_cast<std::uint8_t>(report.halo_sea_adjust);
  out[16] = 0x01;  // in all recordings
  out[18] = report.doppler;
  put_little_endian(out, 19, report.doppler_threshold_cms, 2);
  return out;
}

Bytes encode(Model, const HeartbeatReport&) { return {0x11, 0xC6, 0x00}; }

Result<Report, WireError> decode_report(std::span<const std::uint8_t> in) {
  const std::size_t size = in.size();
  if (size < 3) {
    return Failure{wrong_report(WireErrorKind::truncated, size, fmt::format("{} octets", size))};
  }
  if (size > kMaxReport) {
    return Failure{
        wrong_report(WireErrorKind::oversized, kMaxReport, fmt::format("{} octets", size))};
  }
  const unsigned code = big_endian_at<std::uint16_t>(in, 0);
  const auto not_of = [&](std::size_t expected) {
    return Failure{
        wrong_report(size < expected ? WireErrorKind::truncated : WireErrorKind::oversized,
                     std::min(size, expected),
                     fmt::format("{:04X} of {} octets, expected {}", code, size, expected))};
  };
  switch (code) {
    case 0x01C4: {
      if (size != kStateOctets) return not_of(kStateOctets);
      if (in[2] > 3 && in[2] != 5) {
        return Failure{
            wrong_report(WireErrorKind::out_of_range, 2, fmt::format("state {}", in[2]))};
      }
      return Report(read_state(in));
    }
    case 0x02C4:
      if (size != kControlOctets) return not_of(kControlOctets);
      return Report(read_controls(in));
    case 0x03C4:
      if (size != kIdentityOctets) return not_of(kIdentityOctets);
      return Report(IdentityReport{in[2], little_endian_at<std::uint32_t>(in, 34),
                                   get_text(in, kFirmwareDate), get_text(in, kFirmwareTime)});
    case 0x04C4:
      if (size != kInstallationOctets) return not_of(kInstallationOctets);
      return Report(read_installation(in));
    case 0x06C4:
      if (size != kBlankingOctets && size != kNewBlankingOctets) return not_of(kBlankingOctets);
      return Report(BlankingReport{
          get_sectors(in, size == kBlankingOctets ? kBlankingSectors : kNewBlankingSectors)});
    case 0x08C4:
      if (size != kAdvancedOctets && size != 21 && size != 22 && size != 24) {
        return not_of(kAdvancedOctets);
      }
      return Report(read_advanced(in));
    case 0x11C6:
      if (size != 3) return not_of(3);
      return Report(HeartbeatReport{});
    default:
      return Failure{
          wrong_report(WireErrorKind::unknown_kind, 0, fmt::format("{:04X} is not known", code))};
  }
}

std::uint8_t identity_type(Model model) {
  switch (model) {
    case Model::br24:
      return 0x0F;
    case Model::g3:
      return 0x08;
    case Model::g4:
      return 0x01;
    case Model::halo20:
    case Model::halo:
      return 0x00;
  }
  return 0x00;
}

}  // namespace skerry::navico
