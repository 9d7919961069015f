// The files of tokens and of users: what is read is written so that it reads the same, and what is
// wrong is an error that says where.
#include <string>

#include "server/access/token_file.hpp"
#include "server/access/user_file.hpp"
#include "server/config/config_error.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::server;

template <typename File>
void check(const std::string& text) {
  File file;
  try {
    file = File::parse(text, "file");
  } catch (const ConfigError& error) {
    fuzz::require(std::string(error.what()).find("file") != std::string::npos,
                  "an error names the file");
    return;
  }
  const std::string written = file.text();
  fuzz::require(File::parse(written, "file").text() == written, "what is written reads the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  check<TokenFile>(text);
  check<UserFile>(text);
  return 0;
}
