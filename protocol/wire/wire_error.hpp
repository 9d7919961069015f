// WireError: why bytes from outside could not be read, and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/quantity/result.hpp"

namespace skerry {

using Bytes = std::vector<std::uint8_t>;

enum class WireErrorKind : std::uint8_t {
  truncated,     // ends before it should
  oversized,     // longer than the format or the receiver allows
  malformed,     // cannot be read as this format
  out_of_range,  // reads, but holds a value the format does not allow
  unknown_kind,  // a kind of message or item that does not exist
};

constexpr std::string_view name_of(WireErrorKind kind) {
  switch (kind) {
    case WireErrorKind::truncated:
      return "truncated";
    case WireErrorKind::oversized:
      return "oversized";
    case WireErrorKind::malformed:
      return "malformed";
    case WireErrorKind::out_of_range:
      return "out of range";
    case WireErrorKind::unknown_kind:
      return "unknown kind";
  }
  return "unknown";
}

struct WireError {
  WireErrorKind kind = WireErrorKind::malformed;
  std::size_t offset = 0;  // byte at which it went wrong
  std::string text;        // what was wrong, what was expected
};

// The error that a decoder returns in place of a value.
inline Failure<WireError> failure(WireErrorKind kind, std::size_t offset, std::string text) {
  return {WireError{kind, offset, std::move(text)}};
}

}  // namespace skerry
