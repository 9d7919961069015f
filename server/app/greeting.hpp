// What skerryd says on the terminal once it serves.
#pragma once

#include <string>

#include "server/app/options/options.hpp"
#include "server/net/net_server.hpp"

namespace skerry::server {

// Where it is reached and where its outputs go, on standard error; its ports on standard output, if
// that was asked for.  `what`: what it serves, in a few words.
void greet(const Options& options, const NetServer& net, const std::string& what);

}  // namespace skerry::server
