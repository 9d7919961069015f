// Values of a debrief in words.
#pragma once

#include <string>
#include <string_view>

#include "server/debrief/debrief.hpp"

namespace skerry::server {

// "0.42 NM", below a tenth also in metres: "0.03 NM (55 m)".
std::string miles_text(double metres);
// "60.41234, 5.03210"
std::string place_text(GeoPoint place);
// "collision" or "grounding".
const char* kind_of(const Contact& contact);
// "collision of A and B", "A aground: the shore".
std::string words_for(const Contact& contact);
// Which side each turned to the other: "port to starboard"; "ahead" and "astern" within 20 deg.
std::string side_text(const ShipPassing& passing);
// Letters alone, for a class of a row.
std::string class_of(std::string_view kind);
// At most so many octets of whole characters, and "...".
std::string shortened(std::string_view text, std::size_t octets);

}  // namespace skerry::server
