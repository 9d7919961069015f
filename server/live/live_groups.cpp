#include "server/live/live_groups.hpp"

#include <algorithm>
#include <array>

#include "protocol/furuno/spoke_frame.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/raymarine/quantum_locator.hpp"

namespace skerry::server {
namespace {

using captures::Family;

constexpr std::array<LiveKind, 11> kKinds = {{
    {"navico_br24", Family::navico, navico::Model::br24, false, true},
    {"navico_3g", Family::navico, navico::Model::g3, false, true},
    {"navico_4g", Family::navico, navico::Model::g4, true, true},
    {"navico_halo20", Family::navico, navico::Model::halo20, false, true},
    {"navico_halo", Family::navico, navico::Model::halo, true, true},
    {"garmin_xhd", Family::garmin, {}, false, true},
    {"raymarine_quantum", Family::quantum, {}, false, true},
    {"raymarine_rd", Family::rd},
    {"furuno_drs", Family::furuno, {}, true},
    {"cat240", Family::cat240, {}, false, false, true},
    {"native", Family::native, {}, false, false, true},
}};

}  // namespace

std::span<const LiveKind> live_kinds() { return kKinds; }

const LiveKind* find_live_kind(std::string_view name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(),
                                  [&](const LiveKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : &*found;
}

LiveGroups::LiveGroups(const LiveSource& source) : source_(source) {
  if (source.kind->family == Family::navico) {
    questions_.push_back({navico::kLocatorGroup, navico::encode_locator_question()});
  }
  begin_anew();
}

void LiveGroups::begin_anew() {
  all_.clear();
  others_.clear();
  switch (source_.kind->family) {
    case Family::navico:
      for (const navico::Addresses& range : {navico::kAddressesA, navico::kAddressesB}) {
        add(range.data);
        add(range.report);
      }
      others_.push_back(source_.second_range ? navico::kAddressesA.data : navico::kAddressesB.data);
      add(navico::kLocatorGroup);
      add(navico::kHeadingGroup);
      for (const Ipv4Endpoint& group : navico::kSpeedGroups) add(group);
      if (!commands_) {
        commands_ = (source_.second_range ? navico::kAddressesB : navico::kAddressesA).send;
      }
      break;
    case Family::garmin:
      add(garmin::kReportAddress);
      add(garmin::kSpokeAddress);
      break;
    case Family::quantum:
    case Family::rd:
      add(raymarine::kLocatorAddress);
      break;
    case Family::furuno:
      add(furuno::kSpokeAddress);
      break;
    case Family::cat240:
    case Family::native:
      if (source_.at) add(*source_.at);
      break;
  }
}

bool LiveGroups::add(const Ipv4Endpoint& at) {
  if (std::find(all_.begin(), all_.end(), at) != all_.end()) return false;
  if (all_.size() >= kMost) {
    ++left_out_;
    return false;
  }
  all_.push_back(at);
  return true;
}

bool LiveGroups::hear(const pcap::Datagram& datagram) {
  if (source_.from && datagram.from.address != *source_.from) return false;
  bool more = false;
  if (source_.kind->family == Family::navico && datagram.to == navico::kLocatorGroup) {
    const auto locator = navico::decode_locator(datagram.payload);
    if (!locator) return false;
    for (const std::uint8_t instance : {std::uint8_t{1}, std::uint8_t{2}}) {
      const auto picture = locator->find_picture(instance);
      if (!picture || !picture->data.is_multicast() || !picture->report.is_multicast()) continue;
      more |= add(picture->data);
      more |= add(picture->report);
      const bool wanted = (instance == 2) == source_.second_range;
      if (wanted && picture->send.is_multicast()) commands_ = picture->send;
      const auto known = std::find(others_.begin(), others_.end(), picture->data);
      if (wanted && known != others_.end()) others_.erase(known);
      if (!wanted && known == others_.end() && others_.size() < kMost) {
        others_.push_back(picture->data);
      }
    }
  } else if (datagram.to == raymarine::kLocatorAddress) {
    const auto addresses = raymarine::decode_locator_addresses(datagram.payload);
    const std::uint32_t model = source_.kind->family == Family::quantum ? raymarine::kQuantumModel
                                                                        : raymarine::kAnalogueModel;
    const bool wanted = addresses && addresses->id.model == model;
    if (wanted && addresses->data.is_multicast()) more |= add(addresses->data);
    // Only to the one that announces itself.
    if (wanted && addresses->radar.address == datagram.from.address) commands_ = addresses->radar;
  } else if (datagram.to == garmin::kReportAddress) {
    commands_ = Ipv4Endpoint{datagram.from.address, garmin::kCommandPort};
  }
  return more;
}

bool LiveGroups::is_picture(const Ipv4Endpoint& to) const {
  return std::find(others_.begin(), others_.end(), to) == others_.end();
}

}  // namespace skerry::server
