// Own ship and her radar as sentences.
#pragma once

#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/navigation/navigation_plan.hpp"
#include "server/navigation/track_table.hpp"

namespace skerry::server {

// Requires one of rmc to osd.
std::string own_ship_sentence(NavigationSentence sentence, const wire::OwnShip& ship,
                              const wire::Settings& settings, bool says_simulated);

// Tracked targets, all of one kind of sentence: ttm, tll or ttd.  `identifier` is that of the TTD.
std::vector<std::string> target_sentences(NavigationSentence sentence,
                                          const std::vector<Track>& tracks,
                                          const wire::OwnShip& ship, unsigned identifier);

}  // namespace skerry::server
