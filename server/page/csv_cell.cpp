#include "server/page/csv_cell.hpp"

namespace skerry::server {

std::string csv_cell(std::string_view text) {
  std::string cell;
  if (!text.empty() && std::string_view("=+-@\t\r").find(text[0]) != std::string_view::npos) {
    cell = "'";
  }
  bool quotes = false;
  for (const char c : text) {
    quotes = quotes || c == '"' || c == ',' || c == '\n' || c == '\r';
    cell += c;
    if (c == '"') cell += c;
  }
  return quotes ? "\"" + cell + "\"" : cell;
}

}  // namespace skerry::server
