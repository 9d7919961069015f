// A password from whoever sits at the terminal, or from a pipe.
#pragma once

#include <string>

namespace skerry::client {

// On a terminal it asks without showing what is typed; otherwise the first line of the standard
// input is the password.
// Error: std::runtime_error if nothing comes.
std::string enter_password(const std::string& user, const std::string& server);

}  // namespace skerry::client
