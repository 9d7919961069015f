#include "protocol/recording/audit_text.hpp"

#include <fmt/format.h>

namespace skerry::recording {

std::string audit_text(const AuditEntry& entry) {
  std::string text = entry.what();
  if (entry.before().empty()) {
    if (!entry.after().empty()) text += ": " + entry.after();
  } else {
    text += fmt::format(": {} -> {}", entry.before(),
                        entry.after().empty() ? "nothing" : entry.after());
  }
  if (entry.times() > 1) text += fmt::format(" ({} changes)", entry.times());
  if (!entry.result().empty()) text += ": " + entry.result();
  return text;
}

}  // namespace skerry::recording
