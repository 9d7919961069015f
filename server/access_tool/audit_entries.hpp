// Entries of the audit, from where they are kept.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "server/audit/audit_chain.hpp"

namespace skerry::server {

// By its first octets; false if it cannot be read.
bool is_recording(const std::string& file);

// Gives the entries of an audit file, or of a recording, in their order.  What is wrong with the
// file, if anything is: of an audit file the first wrong line, behind which nothing is given; of a
// recording, that it has none, or which are missing.
// Error: std::runtime_error naming the file, if it cannot be read.
std::optional<std::string> read_entries(const std::string& file,
                                        const std::function<void(const audit::Entry&)>& each);

}  // namespace skerry::server
