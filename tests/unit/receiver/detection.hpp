// Detection theory: thresholds, probabilities and the signal they need.
#pragma once

namespace skerry::echo {

// All powers are ratios to mean noise, behind a square-law detector.

// Threshold that exponential noise passes with probability pfa in (0, 1): -ln(pfa).
double detection_threshold(double pfa);
// Gain control whose video begins at that threshold (threshold_db); may lie outside 0 to 100 where
// no setting does.
double gain_for_pfa(double pfa);

// Factor on the mean of n cells of exponential clutter for a false alarm rate of pfa, cell
// averaging: n (pfa^(-1/n) - 1).  Source: SOURCES.md "Receiver".
double cfar_multiplier(int cells, double pfa);

// One pulse of a target that fluctuates from scan to scan (Swerling 1) or not at all (Rician).
// Source: SOURCES.md "Targets" for the first; Marcum's Q function, by its Poisson series, for the
// second (error 1e-12 for snr and threshold below 600).
double swerling1_pd(double snr, double pfa);
double swerling1_snr(double pd, double pfa);
double steady_pd(double snr, double threshold);

// Signal over noise of each of n pulses of a steady target that are summed, dB.  Albersheim's
// approximation, 0.2 dB for pfa 1e-7 to 1e-3, pd 0.1 to 0.9; for one pulse
// A + 0.12 A B + 1.7 B itself.  Source: Albersheim 1981; numbers: SOURCES.md "Vectors".
double albersheim_snr_db(double pd, double pfa, int pulses);

}  // namespace skerry::echo
