#include "tests/system/display_kit.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace skerry::system_test {

std::uint32_t u16(const Bytes& bytes, std::size_t at) {
  return std::uint32_t{bytes.at(at)} | std::uint32_t{bytes.at(at + 1)} << 8;
}

std::uint32_t u32(const Bytes& bytes, std::size_t at) {
  return u16(bytes, at) | u16(bytes, at + 2) << 16;
}

Bytes hex(const std::string& text) {
  Bytes bytes;
  std::string digits;
  for (const char c : text) {
    if (c != ' ') digits += c;
  }
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

Bytes await_datagram(DisplaySocket& socket, std::uint32_t from, const std::string& what,
                     const std::function<bool(const Bytes&)>& reads) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < deadline) {
    auto received = socket.receive(from, std::chrono::seconds(1));
    if (received && reads(received->payload)) return std::move(received->payload);
  }
  throw std::runtime_error("a display waited in vain for " + what);
}

Likeness compare(const std::vector<SeenSpoke>& seen, const Scan& own) {
  Likeness result;
  std::size_t confirmed = 0;
  const auto& first = own.spokes.front()->header;
  const int turn = static_cast<int>(first.geometry.spokes_per_turn);
  const int cells = static_cast<int>(first.geometry.cells);
  const double cell_m = first.cell_size().in_metres();
  const int strong = 192, half = 96;
  const auto echo_near = [&](int spoke, int cell) {
    for (int s = spoke - 1; s <= spoke + 1; ++s) {
      const auto& row = own.spokes[static_cast<std::size_t>((s + turn) % turn)]->cells;
      for (int c = std::max(0, cell - 2); c <= std::min(cells - 1, cell + 2); ++c) {
        if (row[static_cast<std::size_t>(c)] >= half) return true;
      }
    }
    return false;
  };
  for (const SeenSpoke& spoke : seen) {
    const int index = static_cast<int>(std::floor(spoke.turn * turn)) % turn;
    for (std::size_t c = 0; c < spoke.cells.size(); ++c) {
      const double range =
          (static_cast<double>(c) + 0.5) * spoke.reach_m / static_cast<double>(spoke.cells.size());
      const int cell = static_cast<int>(range / cell_m);
      if (spoke.cells[c] < strong || cell >= cells) continue;
      ++result.strong;
      if (echo_near(index, cell)) ++confirmed;
    }
  }
  if (result.strong > 0) {
    result.confirmed = static_cast<double>(confirmed) / static_cast<double>(result.strong);
  }
  return result;
}

}  // namespace skerry::system_test
