// FractionalBridge: the second-order statistics of a fractional Brownian motion on the unit
// interval from which the straight line between its ends has been taken.
#pragma once

#include <array>

namespace skerry::echo {

// Scaled so that the bridge has a standard deviation of 1 at t = 1/2.  So, at any scale, the middle
// of a piece of length d stands off its chord by d^H rms.  As H -> 1 the bridge tends to a proper
// limit, although fractional Brownian motion itself tends to a straight line.
// 0 < hurst < 1.  Source: Mandelbrot and Van Ness 1968 (Ji et al. 2016 eq. 1); SOURCES.md
// "Fractals". Thread: immutable, any number.
class FractionalBridge {
 public:
  explicit FractionalBridge(double hurst);

  // The variance of the increment over `lag` less what a straight line would give, as used in
  // covariances of contrasts that vanish on straight lines: cov(sum u_i X(t_i), sum v_j X(s_j)) =
  // -1/2 sum u_i v_j increment(|t_i - s_j|).  v (lag^2H - lag^2), lag >= 0.
  double increment(double lag) const;
  double covariance(double s, double t) const;  // of the bridge at s and t; any real s, t
  double deviation(double t) const;  // standard deviation of the bridge at t, 0 <= t <= 1

  double hurst() const { return hurst_; }

 private:
  double hurst_, scale_;
};

// 1 / deviation(t), quickly.  Error: at most 7 % (it only shapes how roughness fades towards the
// ends).  Held by BridgeProfile.IsCloseToTheDeviation.
class BridgeProfile {
 public:
  explicit BridgeProfile(const FractionalBridge& bridge);
  // 2^-kOctaves <= t <= 1 - 2^-kOctaves.
  double reciprocal(double t) const;
  static constexpr int kOctaves = 32;

 private:
  std::array<double, kOctaves + 2> deviation_;  // at 2^-k
};

}  // namespace skerry::echo
