// A message as JSON, for other programs.
#pragma once

#include <string>

#include "protocol/wire/schema.hpp"

namespace skerry::client {

// With the schema's field names; what is absent is left out, and 64-bit counts are strings, as
// protobuf writes them.  Error: std::runtime_error for a message that JSON cannot hold.
std::string json_text(const wire::Message& message);

}  // namespace skerry::client
