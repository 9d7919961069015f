// What a server needs before other hosts may reach it.
#pragma once

#include <string>

#include "server/net/common/net_config.hpp"

namespace skerry::server {

// What is missing of a server that is bound to more than loopback: TLS, users or tokens, and of a
// control token, if it has one, 16 characters.  Empty if nothing is.  One sentence, for the page
// and the status of a server that runs all the same.
std::string exposure_of(const NetConfig& net);

// Error: std::runtime_error with the lines that would mend it, if something is missing and
// `insecure` was not asked for.
void require_guarded(const NetConfig& net, bool insecure);

}  // namespace skerry::server
