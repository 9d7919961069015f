// Own ship and her radar as sentences.
#pragma once

#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/navigation/navigation_plan.hpp"

namespace skerry::server {

// Requires one of rmc to osd.
std::string own_ship_sentence(NavigationSentence sentence, const wire::OwnShip& ship,
                              const wire::Settings& settings, bool says_simulated);

}  // namespace skerry::server
