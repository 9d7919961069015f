#include "protocol/board/registers.hpp"

namespace skerry::board {

std::string_view name_of(RegisterError error) {
  switch (error) {
    case RegisterError::ok:
      return "ok";
    case RegisterError::unknown_register:
      return "unknown register";
    case RegisterError::read_only:
      return "read only";
    case RegisterError::out_of_range:
      return "out of range";
    case RegisterError::misaligned:
      return "misaligned";
  }
  return "unknown";
}

}  // namespace skerry::board
