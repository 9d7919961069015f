#include "server/plotter/judge/read_notes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skerry::server {

void ReadNotes::leave_out(std::string_view kind, std::size_t line, std::string_view detail) {
  auto found = std::find_if(kinds_.begin(), kinds_.end(),
                            [&](const Kind& each) { return each.name == kind; });
  if (found == kinds_.end() && kinds_.size() >= kMostKinds) found = kinds_.end() - 1;
  if (found == kinds_.end()) {
    const bool last = kinds_.size() + 1 == kMostKinds;
    kinds_.push_back(
        {last ? std::string("of other kinds") : std::string(kind), 0, line, shown_text(detail)});
    found = kinds_.end() - 1;
  }
  ++found->count;
}

std::size_t ReadNotes::left_out() const {
  std::size_t sum = 0;
  for (const Kind& kind : kinds_) sum += kind.count;
  return sum;
}

std::size_t ReadNotes::left_out(std::string_view kind) const {
  for (const Kind& each : kinds_)
    if (each.name == kind) return each.count;
  return 0;
}

std::string ReadNotes::text() const {
  std::string out = fmt::format("{} lines, {} used", lines_, used_);
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const Kind& kind = kinds_[i];
    out += fmt::format("{}{} {} (first in line {}{}{})", i == 0 ? "; left out: " : ", ", kind.count,
                       kind.name, kind.first_line, kind.detail.empty() ? "" : ": ", kind.detail);
  }
  return out;
}

std::string shown_text(std::string_view text, std::size_t most) {
  std::string out;
  for (const char c : text.substr(0, most)) out += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > most ? out + "..." : out;
}

}  // namespace skerry::server
