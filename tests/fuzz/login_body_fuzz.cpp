// Bodies of sign-ins.
#include <string_view>

#include "server/net/http/login_body.hpp"
#include "tests/fuzz/fuzz_require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skerry;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const bool is_signalk : {false, true}) {
    const auto body = server::read_login_body(text, is_signalk);
    if (!body) continue;
    const auto& shown = body->credentials;
    fuzz::require(shown.password.empty() != shown.class_code.empty(), "a password or a code");
    fuzz::require(!is_signalk || !body->cookie, "Signal K's clients have no cookie");
    fuzz::require(shown.name.size() + shown.password.size() + shown.class_code.size() <= size * 3,
                  "what is kept is bounded by what came");
  }
  return 0;
}
