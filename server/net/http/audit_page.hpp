// The page /audit: who did what of late.
#pragma once

#include <string_view>

#include "server/core/audit_port.hpp"
#include "server/net/http/web_answer.hpp"

namespace skerry::server {

// {"entries": [...], "newest": n, "has_file": true, "unwritten": 0}, the newest entry first, each
// as a line of the audit file has it.  The query may have `last` (at most kMostShown, 200 without),
// `after` (only entries with a greater number), `who` (part of name or address) and `kind`.
// 400 if it has anything else.  `audit` may be null.  Thread: net-0.
constexpr std::size_t kMostShown = 1000;
WebAnswer audit_page(const AuditPort* audit, std::string_view target);

}  // namespace skerry::server
