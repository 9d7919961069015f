#include "protocol/raymarine/run_length.hpp"

#include <fmt/format.h>

namespace skerry::raymarine {

Result<Bytes, WireError> decode_runs(std::span<const std::uint8_t> coded, std::size_t most) {
  Bytes plain;
  std::size_t i = 0;
  while (i < coded.size()) {
    std::size_t count = 1, taken = 1;
    std::uint8_t value = coded[i];
    if (value == kRunMark) {
      if (i + 2 >= coded.size()) {
        return Failure{WireError{WireErrorKind::truncated, i, "a run without count and value"}};
      }
      count = coded[i + 1];
      value = coded[i + 2];
      taken = 3;
    }
    if (count > most - plain.size()) {
      return Failure{WireError{WireErrorKind::oversized, i,
                               fmt::format("runs make more than {} bytes", most)}};
    }
    plain.insert(plain.end(), count, value);
    i += taken;
  }
  return plain;
}

void append_runs(Bytes& out, std::span<const std::uint8_t> plain) {
  constexpr std::size_t kLongestRun = 255, kCodedRun = 3;  // a lone mark takes three bytes
  const std::size_t before = out.size();
  out.resize(before + kCodedRun * plain.size());
  std::uint8_t* next = out.data() + before;
  std::size_t i = 0;
  while (i < plain.size()) {
    const std::uint8_t value = plain[i];
    std::size_t end = i + 1;
    while (end < plain.size() && plain[end] == value && end - i < kLongestRun) ++end;
    const std::size_t count = end - i;
    if (count >= kShortestRun || value == kRunMark) {
      *next++ = kRunMark;
      *next++ = static_cast<std::uint8_t>(count);
      *next++ = value;
    } else {
      for (std::size_t k = 0; k < count; ++k) *next++ = value;
    }
    i = end;
  }
  out.resize(static_cast<std::size_t>(next - out.data()));
}

}  // namespace skerry::raymarine
