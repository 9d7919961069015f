// What instruments of a ship's con say.
#pragma once

#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/navigation/navigation_plan.hpp"

namespace skerry::server {

bool is_of_con(NavigationSentence sentence);

// Requires one of rsa to xte, and a ship that has a con: one with a class.  The transducer of DPT
// is at the keel's level 5 m under the water line or at the keel, whichever is higher; MWV is the
// wind as it is felt on board, MWD the true wind; XTE is not valid where she is on no track.  What
// sensors do not tell is empty: MWV without wind, MWD without wind or her way over ground, VDR
// without that or the log, XTE without a position.
std::string con_sentence(NavigationSentence sentence, const wire::OwnShip& ship);

}  // namespace skerry::server
