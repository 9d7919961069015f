// Certificates as no tool of the server makes them, for tests.
#pragma once

#include <chrono>
#include <string>

namespace skerry::server {

// NAME.pem of the pair in `file` again, signed by the authority whose pair is in `authority`, for
// another time.  Both files' keys are beside them as .key.
struct TestValidity {
  std::chrono::seconds from_now{-3600}, until_now{3600};  // from now on
};
void sign_again(const std::string& file, const std::string& authority, TestValidity validity = {});

// The certificate as it is sent (DER), as bytes.
std::string der_of(const std::string& file);

}  // namespace skerry::server
