// Sentences in and out, from the configuration.
#pragma once

#include <string>

#include "server/app/config.pb.h"
#include "server/net/common/navigation_config.hpp"

namespace skerry::server {

// The output's own, or what is right where it says none: 0 on loopback, 1 on another interface.
int multicast_ttl(const app::Output& output);

// Error: std::runtime_error beginning with `name`: a sentence that is not known, a period or plan
// that cannot be.
NavigationOutputConfig navigation_output_of(const app::Output& output, const std::string& name);
NavigationInputConfig navigation_input_of(const app::Input& input);

}  // namespace skerry::server
