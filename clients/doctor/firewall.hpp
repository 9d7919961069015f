// The firewall of this host, as far as it can be read.
#pragma once

#include <string_view>

#include "clients/doctor/host_facts.hpp"

namespace skerry::client::doctor {

// Of what `nft list ruleset` says.
Firewall firewall_of(std::string_view ruleset);

// Asks nft, where it is installed and the user may; else looks for tables of iptables.
Firewall read_firewall();

}  // namespace skerry::client::doctor
