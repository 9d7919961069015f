#include "protocol/captures/navico_facts.hpp"

#include <algorithm>
#include <array>
#include <variant>

#include "protocol/navico/frame.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::captures {
namespace {

using navico::Model;

// A capture has few; a hostile one shall not fill the memory.
constexpr std::size_t kMostKept = 64;
// Value of the larger field where the smaller one holds the range, in quarters of a metre.
constexpr std::uint16_t kSmallForm = 0x80;
constexpr std::uint16_t kLargeForm4g = 0x8000;
constexpr std::uint8_t kType3g = 0x08, kType4g = 0x01, kTypeHalo = 0x00;
constexpr std::size_t kAdvancedOctetsHalo = 21;  // or more

}  // namespace

void NavicoForms::take(std::span<const std::uint8_t> frame) {
  constexpr std::array<std::uint8_t, 4> kFirst = {0x00, 0x44, 0x0D, 0x0E};
  const auto header = frame.subspan(navico::kFrameHeader, navico::kSpokeHeader);
  if (std::equal(kFirst.begin(), kFirst.end(), header.begin() + 4)) {
    first_generation = true;
    return;
  }
  const auto large = little_endian_at<std::uint16_t>(header, 6);
  const auto small = little_endian_at<std::uint16_t>(header, 12);
  if (large == kSmallForm || large == 0) return;
  (small == kLargeForm4g ? large_4g : large_halo) = true;
}

void NavicoFacts::take(const pcap::Datagram& datagram) {
  if (const auto locator = navico::decode_locator(datagram.payload)) {
    for (const std::uint8_t instance : {std::uint8_t{1}, std::uint8_t{2}}) {
      const auto groups = locator->find_picture(instance);
      if (groups && told_.size() < kMostKept) told_[groups->data] = groups->report;
      if (groups && instance == 2 && senders_.size() < kMostKept) {
        senders_[datagram.from.address].two_ranges = true;
      }
    }
    return;
  }
  const auto report = navico::decode_report(datagram.payload);
  if (!report) return;
  const std::uint32_t from = datagram.from.address;
  if (!senders_.contains(from) && senders_.size() >= kMostKept) return;
  Sender& sender = senders_[from];
  if (sender.reports.size() < kMostKept) sender.reports.insert(datagram.to);
  if (const auto* identity = std::get_if<navico::IdentityReport>(&*report)) {
    sender.type = identity->type;
  } else if (std::holds_alternative<navico::HeartbeatReport>(*report)) {
    sender.heartbeat = true;
  } else if (const auto* advanced = std::get_if<navico::AdvancedReport>(&*report)) {
    sender.advanced_octets = std::max(sender.advanced_octets, datagram.payload.size());
    if (doppler_.size() < kMostKept) doppler_.emplace(datagram.to, advanced->doppler != 0);
  }
}

Model NavicoFacts::model_of(std::uint32_t sender, const NavicoForms& forms) const {
  const auto found = senders_.find(sender);
  const Sender facts = found == senders_.end() ? Sender{} : found->second;
  if (forms.first_generation) return facts.type == kType3g ? Model::g3 : Model::br24;
  // A HALO20 and a HALO24 say more in their advanced report than a HALO; only the HALO24 has two
  // ranges.
  const bool is_20 = facts.advanced_octets > kAdvancedOctetsHalo && !facts.two_ranges;
  const Model halo = is_20 ? Model::halo20 : Model::halo;
  if (facts.type == kType4g || facts.type == kType3g) return Model::g4;
  if (facts.type == kTypeHalo || facts.heartbeat || facts.advanced_octets >= kAdvancedOctetsHalo) {
    return halo;
  }
  return forms.large_4g && !forms.large_halo ? Model::g4 : halo;
}

bool NavicoFacts::knows_generation(std::uint32_t sender, const NavicoForms& forms) const {
  if (forms.first_generation || forms.large_4g != forms.large_halo) return true;
  const auto found = senders_.find(sender);
  return found != senders_.end() && (found->second.type || found->second.heartbeat ||
                                     found->second.advanced_octets >= kAdvancedOctetsHalo);
}

std::string NavicoFacts::name_of(std::uint32_t sender, const NavicoForms& forms) const {
  const auto found = senders_.find(sender);
  if (found != senders_.end() && found->second.type == kType3g) return "3G";
  const Model model = model_of(sender, forms);
  if (model == Model::halo && found != senders_.end() &&
      found->second.advanced_octets > kAdvancedOctetsHalo) {
    return "HALO24";
  }
  return std::string(navico::name_of(model));
}

std::optional<Ipv4Endpoint> NavicoFacts::reports_of(std::uint32_t sender,
                                                    const Ipv4Endpoint& picture) const {
  if (const auto told = told_.find(picture); told != told_.end()) return told->second;
  if (picture == navico::kAddressesA.data) return navico::kAddressesA.report;
  if (picture == navico::kAddressesB.data) return navico::kAddressesB.report;
  const auto found = senders_.find(sender);
  if (found == senders_.end() || found->second.reports.empty()) return std::nullopt;
  const auto& reports = found->second.reports;
  const auto same = std::find_if(reports.begin(), reports.end(), [&](const Ipv4Endpoint& each) {
    return each.address == picture.address;
  });
  return same == reports.end() ? *reports.begin() : *same;
}

bool NavicoFacts::begins_with_doppler(const std::optional<Ipv4Endpoint>& reports) const {
  const auto found = reports ? doppler_.find(*reports) : doppler_.end();
  return found != doppler_.end() && found->second;
}

}  // namespace skerry::captures
