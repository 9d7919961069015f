// How far over the mean of its neighbours a cell must be, by the share of false alarms.
#pragma once

#include <cstdint>

namespace skerry::server {

// How the neighbours of a cell are made one number.
enum class Statistic : std::uint8_t {
  ordered,      // the one of a given rank: echoes among them, and land on one side, do not matter
  cell_mean,    // CA-CFAR: best where all is alike; an echo beside hides another
  greatest_of,  // GO-CFAR, of the means of both sides: fewest false alarms where rain begins
  smallest_of,  // SO-CFAR: sees an echo beside land, at the price of false alarms there
};

// Multipliers of thresholds over square-law video of exponential noise with `cells` independent
// neighbours (half of them on either side), for the share `false_alarms` of cells of noise alone:
// threshold = multiplier times the mean of all, the greater or the smaller mean of a half, or the
// `rank`-th smallest cell (from 1).
//   CA: P = (1 + a/N)^-N;  OS: P = prod_{i<k} (N-i)/(N-i+a);
//   SO, with n = N/2, t = a/n: P = 2 sum_{k<n} C(n-1+k, k) (2+t)^-(n+k);  GO: 2 (1+t)^-n - P of SO.
// Sources: Finn and Johnson 1968 (CA), Rohling 1983 (OS), Weiss 1982 (GO, SO).
// Error: 1e-9 relative.
// Errors: std::invalid_argument unless 0 < false_alarms < 1, 1 <= cells <= 1024 (GO and SO: even),
// 1 <= rank <= cells.
double cell_mean_multiplier(std::uint32_t cells, double false_alarms);
double greatest_of_multiplier(std::uint32_t cells, double false_alarms);
double smallest_of_multiplier(std::uint32_t cells, double false_alarms);
double ordered_multiplier(std::uint32_t cells, std::uint32_t rank, double false_alarms);

// The share of looks in which an echo is seen whose strength fades from look to look (Swerling 1),
// of a mean signal-to-noise ratio (of powers), by such a threshold: the same law with a/(1+S).
double cell_mean_detection(std::uint32_t cells, double multiplier, double snr);
double ordered_detection(std::uint32_t cells, std::uint32_t rank, double multiplier, double snr);

}  // namespace skerry::server
