// Reports: what a Navico radar says of itself.  Octets that nobody knows are listed in README.md.
// Source: navico/README.md, and captures of real radars.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "protocol/navico/model.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::navico {

// 01C4, 18 octets.
enum class RadarState : std::uint8_t { off = 0, standby = 1, transmit = 2, spinning_up = 5 };
struct StateReport {
  RadarState state = RadarState::standby;
  friend bool operator==(const StateReport&, const StateReport&) = default;
};

// 02C4, 99 octets.
struct ControlReport {
  std::uint32_t range_dm = 0;
  std::uint8_t mode = 0;
  bool gain_auto = false;
  std::uint8_t gain = 0;
  std::uint8_t sea_auto = 0;  // 0 manual, 1 harbour, 2 offshore; a HALO: 1
  std::uint8_t sea = 0;
  std::uint8_t rain = 0;
  std::uint8_t interference = 0;
  std::uint8_t expansion = 0;
  std::uint8_t boost = 0;
  friend bool operator==(const ControlReport&, const ControlReport&) = default;
};

// 03C4, 129 octets.
struct IdentityReport {
  std::uint8_t type = 0;      // 0F BR24, 08 3G, 01 4G, 00 HALO
  std::uint32_t hours = 0;    // of operation
  std::string firmware_date;  // "Sep  9 2021", at most 15 characters
  std::string firmware_time;  // "19:53:32 182"
  friend bool operator==(const IdentityReport&, const IdentityReport&) = default;
};

// A sector in which a HALO does not transmit; 0.1 deg clockwise from the bow.
struct BlankedSector {
  bool on = false;
  std::uint16_t from = 0, to = 0;
  friend bool operator==(const BlankedSector&, const BlankedSector&) = default;
};
using BlankedSectors = std::array<BlankedSector, 4>;

// 04C4, 66 octets.
struct InstallationReport {
  std::uint16_t bearing_alignment = 0;  // 0.1 deg, 0 .. 3599
  std::uint16_t parking = 0;            // 0.1 deg
  std::uint16_t antenna_height_mm = 0;
  std::uint8_t accent_light = 0;
  BlankedSectors sectors;  // HALO
  friend bool operator==(const InstallationReport&, const InstallationReport&) = default;
};

// 06C4, 68 octets (74 from newer firmware); HALO alone.
struct BlankingReport {
  BlankedSectors sectors;
  friend bool operator==(const BlankingReport&, const BlankingReport&) = default;
};

// 08C4, 18 octets; HALO 21, 22 or 24.
struct AdvancedReport {
  std::uint8_t sea_state = 0;
  std::uint8_t local_interference = 0;
  std::uint8_t scan_speed = 0;
  bool side_lobe_auto = false;
  std::uint8_t side_lobe = 0;
  std::uint8_t noise_rejection = 0;
  std::uint8_t target_separation = 0;
  std::uint8_t halo_sea = 0;        // 0 .. 100
  std::int8_t halo_sea_adjust = 0;  // around automatic
  std::uint8_t doppler = 0;
  std::uint16_t doppler_threshold_cms = 0;
  friend bool operator==(const AdvancedReport&, const AdvancedReport&) = default;
};

// 11C6, 3 octets: a HALO's heartbeat.
struct HeartbeatReport {
  friend bool operator==(const HeartbeatReport&, const HeartbeatReport&) = default;
};

using Report = std::variant<StateReport, ControlReport, IdentityReport, InstallationReport,
                            BlankingReport, AdvancedReport, HeartbeatReport>;

Bytes encode(Model model, const StateReport& report);
Bytes encode(Model model, const ControlReport& report);
Bytes encode(Model model, const IdentityReport& report);
Bytes encode(Model model, const InstallationReport& report);
Bytes encode(Model model, const BlankingReport& report);
Bytes encode(Model model, const AdvancedReport& report);
Bytes encode(Model model, const HeartbeatReport& report);

// Error: unknown_kind (of the reports that are not above, there are many), truncated or oversized
// (not the length that report has: displays ignore it as well), out_of_range (a state not above).
Result<Report, WireError> decode_report(std::span<const std::uint8_t> datagram);

// IdentityReport::type of a BR24, 3G, 4G or HALO.
std::uint8_t identity_type(Model model);

}  // namespace skerry::navico
