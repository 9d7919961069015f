// Tracked targets as sentences.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "protocol/wire/own_ship.pb.h"
#include "server/navigation/navigation_plan.hpp"
#include "server/navigation/told_targets.hpp"

namespace skerry::server {

// All of one kind of sentence: ttm, tll, ttd or tlb.  `utc`: of the targets.  `identifier`: that of
// the TTD, 0 to 9.
std::vector<std::string> target_sentences(NavigationSentence sentence,
                                          std::span<const ToldTarget> targets, UtcTime utc,
                                          unsigned identifier);

}  // namespace skerry::server
