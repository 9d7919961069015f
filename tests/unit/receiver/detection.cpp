#include "tests/unit/receiver/detection.hpp"

#include <algorithm>
#include <cmath>

#include "echo/receiver/log_video.hpp"

namespace skerry::echo {

double detection_threshold(double pfa) { return -std::log(pfa); }

double gain_for_pfa(double pfa) {
  const double wanted = 10.0 * std::log10(detection_threshold(pfa));
  const double at_0 = threshold_db(0.0), per_step = threshold_db(1.0) - at_0;
  return (wanted - at_0) / per_step;
}

double cfar_multiplier(int cells, double pfa) {
  return cells * (std::pow(pfa, -1.0 / cells) - 1.0);
}

double swerling1_pd(double snr, double pfa) { return std::pow(pfa, 1.0 / (1.0 + snr)); }

double swerling1_snr(double pd, double pfa) { return std::log(pfa) / std::log(pd) - 1.0; }

// Sum over k of Poisson(k; snr) times the chance that k + 1 exponentials together pass the
// threshold, which is that of at most k Poisson events of mean `threshold`.
double steady_pd(double snr, double threshold) {
  double chance = std::exp(-snr), event = std::exp(-threshold), at_most = event, sum = 0.0;
  const int terms = static_cast<int>(snr + threshold + 12.0 * std::sqrt(snr + threshold)) + 60;
  for (int k = 0; k < terms; ++k) {
    sum += chance * at_most;
    chance *= snr / (k + 1);
    event *= threshold / (k + 1);
    at_most += event;
  }
  return std::min(1.0, sum);
}

double albersheim_snr_db(double pd, double pfa, int pulses) {
  const double a = std::log(0.62 / pfa), b = std::log(pd / (1.0 - pd));
  const double once = 10.0 * std::log10(a + 0.12 * a * b + 1.7 * b);
  if (pulses == 1) return once;
  return -5.0 * std::log10(pulses) + (0.62 + 0.454 / std::sqrt(pulses + 0.44)) * once;
}

}  // namespace skerry::echo
