// A password from whoever sits at the terminal, or from a pipe.
#pragma once

#include <string>

namespace skerry::server {

// On a terminal it asks twice without showing what is typed; otherwise the first line of the
// standard input is the password.
// Error: std::runtime_error if the two differ, nothing comes, or why_no_password() says why.
std::string enter_password(const std::string& user);

}  // namespace skerry::server
