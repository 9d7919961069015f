#include "protocol/recording/item.hpp"

#include <fmt/format.h>

namespace skerry::recording {

std::string RecordingError::to_string() const {
  return fmt::format("{}: byte {}: {}", file, offset, text);
}

}  // namespace skerry::recording
