// An entry of the audit in words.
#pragma once

#include <string>

#include "protocol/recording/recording.pb.h"

namespace skerry::recording {

// What was done, without who and when: "radar 0 view 0: gain: 50 -> 71 (3 changes): ok".
std::string audit_text(const AuditEntry& entry);

}  // namespace skerry::recording
