#include "server/relayed/spoke_reach.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::server {

Spoke reaching(const Spoke& spoke, Length reach) {
  Spoke out;
  out.header = spoke.header;
  out.header.instrumented_range = reach;
  const std::size_t cells = spoke.cells.size();
  const double share = reach / spoke.header.reach();  // cells of the old one to one of the new
  out.cells.assign(cells, 0);
  if (!spoke.doppler.empty()) out.doppler.assign(cells, DopplerClass::none);
  // A boundary that should be whole but for its rounding is.
  constexpr double kRounding = 1e-6;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto begin =
        static_cast<std::size_t>(std::floor(static_cast<double>(cell) * share + kRounding));
    if (begin >= cells) break;
    const auto end =
        static_cast<std::size_t>(std::ceil(static_cast<double>(cell + 1) * share - kRounding));
    const auto from = spoke.cells.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to =
        spoke.cells.begin() + static_cast<std::ptrdiff_t>(std::clamp(end, begin + 1, cells));
    const auto strongest = std::max_element(from, to);
    out.cells[cell] = *strongest;
    if (!spoke.doppler.empty()) {
      out.doppler[cell] = spoke.doppler[static_cast<std::size_t>(strongest - spoke.cells.begin())];
    }
  }
  return out;
}

}  // namespace skerry::server
