// LatticeField: correlated random values without a seam.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skerry::echo {

// A plane of values laid on a ring of 2^18: the value at (along, across) is
// values[(along + across * kLatticeStep) mod kLatticeSize].  So values that follow one another
// along lie side by side, 64-byte aligned for every `across`, and nothing has an edge.  The plane
// repeats, but no two equal places are closer than 541 (as the crow flies, in values).
inline constexpr std::uint32_t kLatticeSize = 1u << 18;
inline constexpr std::uint32_t kLatticeStep = 167440;  // 16 * an odd number
inline constexpr std::uint32_t kLatticeMask = kLatticeSize - 1;

// Longest correlation asked for; longer is cut to it.
inline constexpr double kLongestCorrelation = 96.0;

// kLatticeSize Gaussian values of zero mean and unit variance over the ring, autocorrelation
// exp(-(d / along)^2) along and exp(-(d / across)^2) across (1 / e at those lengths; 0: white),
// made from hashes alone. Error: the filter is cut where it falls to 1e-4; the ring holds
// kLatticeSize / (1.57 along across) independent values (along, across >= 1), and its correlation
// scatters accordingly. Held by LatticeField.CorrelatesAsAskedFor.
std::vector<float> lattice_field(double along, double across, std::uint64_t seed);

// Gives positive `values` the distribution of the unit-mean exponential, keeping their order:
// what had rank r of n becomes -ln of the share of those above.  Error: within a bin of 1/128
// octave values are spread evenly.
void give_exponential_law(std::span<float> values);

}  // namespace skerry::echo
