// What the body of a sign-in says.
#pragma once

#include <optional>
#include <string_view>

#include "server/net/common/signing_in.hpp"

namespace skerry::server {

struct LoginBody {
  Credentials credentials = {};
  bool cookie = false;  // whether a cookie is wanted in place of a token
};

// {"name", "password"} or {"name", "code"}, with "cookie" if wanted; of Signal K's clients
// {"username", "password"}.  Nothing: it is no such document, or has both a password and a code.
// Never throws.
std::optional<LoginBody> read_login_body(std::string_view text, bool is_signalk);

}  // namespace skerry::server
