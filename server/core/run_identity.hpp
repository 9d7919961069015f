// A name for one run of a server, by which relays know it again.
#pragma once

#include <string>

namespace skerry::server {

// 32 hexadecimal digits, other ones at every call.
std::string new_run_identity();

}  // namespace skerry::server
