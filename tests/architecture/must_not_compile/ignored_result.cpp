// A result that may be an error must be looked at.
#include "protocol/quantity/result.hpp"

using namespace skerry;

Result<int, int> parse();

int value() {
#ifdef SKERRY_BREACH
  parse();
  return 0;
#else
  const auto parsed = parse();
  return parsed.ok() ? *parsed : 0;
#endif
}
