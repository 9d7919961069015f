// Which keys an output's kind takes.
#pragma once

#include <string>

#include "server/app/config.pb.h"

namespace skerry::server {

// "outputs[2] (navico_4g)".
std::string name_of(const app::Output& output, int index);

// Error: std::runtime_error if a key is given that is not of the output's kind, naming it and those
// that are.
void check_keys(const app::Output& output, const std::string& name);

}  // namespace skerry::server
