#include "echo/kernel/bearing_sector.hpp"

#include <cmath>
#include <cstddef>

#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

// atan(x) / 2 pi on [0, 1], Chebyshev of degree 7 in x^2: 1e-8 turns off, less than float rounds.
inline __attribute__((always_inline)) float arc_turns(float x) {
  const float z = x * x;
  float p = -0.000725713434f;
  p = p * z + 0.00378478708f;
  p = p * z - 0.00936304601f;
  p = p * z + 0.0157067872f;
  p = p * z - 0.0222869285f;
  p = p * z + 0.0317784067f;
  p = p * z - 0.0530492275f;
  p = p * z + 0.159154924f;
  return x * p;
}

SKERRY_KERNEL_BODY sectors_body(const double* __restrict points, double east, double north,
                                float sectors, std::int32_t* __restrict out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float e = static_cast<float>(points[2 * i] - east);
    const float h = static_cast<float>(points[2 * i + 1] - north);
    const float ae = std::fabs(e), ah = std::fabs(h);
    const bool steep = ah >= ae;  // nearer to north or south
    const float low = steep ? ae : ah, high = steep ? ah : ae;
    const float arc = arc_turns(low / (high > 0.0f ? high : 1.0f));
    float turns = steep ? arc : 0.25f - arc;
    turns = h < 0.0f ? 0.5f - turns : turns;
    turns = e < 0.0f ? 1.0f - turns : turns;
    const auto whole = static_cast<std::int32_t>(turns * sectors);
    out[i] = static_cast<float>(whole) >= sectors ? 0 : whole;
  }
}
SKERRY_KERNEL(sectors,
              (const double* __restrict points, double east, double north, float sectors,
               std::int32_t* __restrict out, std::size_t n),
              (points, east, north, sectors, out, n))

}  // namespace

static_assert(sizeof(PlanePoint) == 2 * sizeof(double));
static_assert(offsetof(PlanePoint, east_m) == 0);

void bearing_sectors(std::span<const PlanePoint> points, PlanePoint from, std::uint32_t sectors_of,
                     std::span<std::int32_t> out) noexcept {
  sectors(reinterpret_cast<const double*>(points.data()), from.east_m, from.north_m,
          static_cast<float>(sectors_of), out.data(), out.size());
}

}  // namespace skerry::echo
