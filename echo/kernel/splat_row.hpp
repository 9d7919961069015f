// Points of one body as voltages in the cells they fill.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace skerry::echo {

// A point as a spoke sees it: its voltage, and the roots of its shares of `cells` cells from
// `cell` on.
struct SplatPoint {
  const float* shares = nullptr;
  std::uint32_t cell = 0, cells = 0;
  float in_phase = 0.0f, quadrature = 0.0f;
};

// Cells are worked on in blocks: a point begins with one, and behind its last share lie zeros up to
// the end of one.  Points over each other then add to the same blocks, and wait for no store of
// parts of them.
inline constexpr std::uint32_t kSplatLanes = 8;

// power[c] += |sum over points of voltage share[c - cell]|^2.  `scratch` holds both sums, each as
// long as power and kSplatLanes more.  Requires cell + cells <= power.size(), cell a multiple of
// kSplatLanes, and shares that go on with zeros to a multiple of it.
// Error: 1e-6 of the power that all points in phase would have.  Held by
// SplatRow.MatchesItsReference.
void add_voltages(std::span<const SplatPoint> points, std::span<float> scratch,
                  std::span<float> power) noexcept;

// Twin in double.
void add_voltages_reference(std::span<const SplatPoint> points, std::span<double> power);

}  // namespace skerry::echo
