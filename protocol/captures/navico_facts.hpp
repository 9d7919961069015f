// NavicoFacts: which Navico radar sends a picture, and where its reports go.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "protocol/navico/model.hpp"
#include "protocol/pcap/capture_reader.hpp"

namespace skerry::captures {

// How the headers of a picture's spokes say their range.
struct NavicoForms {
  bool first_generation = false;  // a BR24's constants
  bool large_4g = false, large_halo = false;

  void take(std::span<const std::uint8_t> frame);  // requires a whole frame
};

class NavicoFacts {
 public:
  void take(const pcap::Datagram& datagram);

  navico::Model model_of(std::uint32_t sender, const NavicoForms& forms) const;
  // Whether reports or the form of the spokes leave no doubt of the generation: BR24 and 3G, 4G, or
  // HALO.
  bool knows_generation(std::uint32_t sender, const NavicoForms& forms) const;
  std::string name_of(std::uint32_t sender, const NavicoForms& forms) const;
  std::optional<Ipv4Endpoint> reports_of(std::uint32_t sender, const Ipv4Endpoint& picture) const;
  // Whether its first report of Doppler was that it is on.
  bool begins_with_doppler(const std::optional<Ipv4Endpoint>& reports) const;

 private:
  struct Sender {
    std::optional<std::uint8_t> type;  // of its identity
    bool heartbeat = false;
    std::size_t advanced_octets = 0;
    bool two_ranges = false;  // its locator names a second
    std::set<Ipv4Endpoint> reports;
  };

  std::map<std::uint32_t, Sender> senders_;
  std::map<Ipv4Endpoint, Ipv4Endpoint> told_;  // picture -> reports, by locators
  std::map<Ipv4Endpoint, bool> doppler_;       // by where the report went
};

}  // namespace skerry::captures
