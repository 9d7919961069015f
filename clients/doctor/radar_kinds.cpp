#include "clients/doctor/radar_kinds.hpp"

#include <algorithm>
#include <array>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/raymarine/quantum_locator.hpp"

namespace skerry::client::doctor {
namespace {

using navico::kAddressesA;
using navico::kLocatorGroup;

constexpr std::array<RadarKind, 7> kKinds = {{
    {"navico_br24", Maker::navico, kAddressesA.report, true, kAddressesA.send},
    {"navico_3g", Maker::navico, kAddressesA.report, true, kAddressesA.send},
    {"navico_4g", Maker::navico, kAddressesA.report, true, kAddressesA.send},
    {"navico_halo20", Maker::navico, kLocatorGroup, false, kLocatorGroup},
    {"navico_halo", Maker::navico, kLocatorGroup, false, kLocatorGroup},
    {"garmin_xhd",
     Maker::garmin,
     garmin::kReportAddress,
     true,
     {0, garmin::kCommandPort},
     ipv4(172, 16, 0, 0),
     ipv4(255, 240, 0, 0)},
    {"raymarine_quantum", Maker::raymarine, raymarine::kLocatorAddress, false, {}},
}};

}  // namespace

std::span<const RadarKind> radar_kinds() { return kKinds; }

const RadarKind* find_radar_kind(std::string_view name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const RadarKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

}  // namespace skerry::client::doctor
