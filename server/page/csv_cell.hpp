// Cells of tables for other programs.
#pragma once

#include <string>
#include <string_view>

namespace skerry::server {

// A cell of a CSV file: in quotes where it must be (RFC 4180); a text that a spreadsheet would take
// for a formula gets an apostrophe in front.
std::string csv_cell(std::string_view text);

}  // namespace skerry::server
