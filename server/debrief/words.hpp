// Values of a debrief in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/debrief/debrief.hpp"
#include "server/page/html_text.hpp"

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
// How a target's track ended aboard: "lost", "told to the end", "let go".
const char* ending_text(const KnownTarget& target);
// Columns of a table, those of a moment first: the exercise's clock only where it is another.
std::vector<std::string> moment_columns(const Debrief& debrief, std::vector<std::string> more);
void add_moment(const Debrief& debrief, const Moment& when, HtmlTable& table);
// Letters alone, for a class of a row.
std::string class_of(std::string_view kind);
// At most so many octets of whole characters, and "...".
std::string shortened(std::string_view text, std::size_t octets);

}  // namespace skerry::server
