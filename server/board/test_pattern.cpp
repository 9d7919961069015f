#include "server/board/test_pattern.hpp"

#include <algorithm>

namespace skerry::server {

void fill_test_pattern(const ChannelSettings& channel, std::uint64_t trigger, double turns,
                       std::span<std::uint16_t> codes) {
  const auto full = static_cast<std::uint16_t>((1u << channel.format.bits) - 1);
  const std::size_t step = std::max(channel.test_value, 1u);
  std::fill(codes.begin(), codes.end(), std::uint16_t{0});
  switch (channel.test_mode) {
    case board::TestMode::off:
      break;
    case board::TestMode::ramp:
      for (std::size_t i = 0; i < codes.size(); ++i) {
        codes[i] = static_cast<std::uint16_t>((i + trigger) & full);
      }
      break;
    case board::TestMode::rings:
      for (std::size_t i = step; i < codes.size(); i += step) codes[i] = full;
      break;
    case board::TestMode::wedge:
      if (turns * 3600.0 < static_cast<double>(step)) std::fill(codes.begin(), codes.end(), full);
      break;
    case board::TestMode::target:
      if ((turns <= kTestTargetHalfWidth || turns >= 1.0 - kTestTargetHalfWidth) &&
          step < codes.size()) {
        codes[step] = full;
      }
      break;
    case board::TestMode::checkerboard: {
      const auto column = static_cast<std::size_t>(turns * 32.0);
      for (std::size_t i = 0; i < codes.size(); ++i) {
        if ((i / step + column) % 2 == 1) codes[i] = full;
      }
      break;
    }
  }
  if (channel.format.inverted) {
    for (std::uint16_t& code : codes) code = static_cast<std::uint16_t>(full - code);
  }
}

}  // namespace skerry::server
