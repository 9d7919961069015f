#include "echo/artefacts/shadow_sectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "echo/artefacts/strip_shadow.hpp"
#include "tests/unit/artefacts/small_rig.hpp"

namespace skerry::echo {
namespace {

using Complex = std::complex<double>;

// Past a half plane from the definition: Simpson's rule, in steps of 1/2048 up to |v| = 64.
Complex half_plane(double v) {
  static const std::vector<Complex> integrals = [] {
    const auto f = [](double t) { return std::exp(Complex(0.0, -0.5 * kPi * t * t)); };
    std::vector<Complex> sums{0.0};
    for (int i = 0; i < 64 * 2048; ++i) {
      const double t = i / 2048.0, h = 1.0 / 2048.0;
      sums.push_back(sums.back() + (f(t) + 4.0 * f(t + 0.5 * h) + f(t + h)) * (h / 6.0));
    }
    return sums;
  }();
  const double at = std::fabs(v) * 2048.0;
  const auto i = static_cast<std::size_t>(at);
  const Complex part = integrals[i] + (integrals[i + 1] - integrals[i]) * (at - std::floor(at));
  return Complex(0.5, 0.5) * (Complex(0.5, -0.5) - (v < 0.0 ? -part : part));
}

double knife_edge_db(double v) {
  return 6.9 + 20.0 * std::log10(std::sqrt((v - 0.1) * (v - 0.1) + 1.0) + v - 0.1);
}

TEST(StripShadow, AHalfPlaneIsTheKnifeEdge) {
  double worst = 0.0, worst_db = 0.0;
  for (double v = -8.0; v <= 12.0; v += 0.037) {
    const Voltage got = past_half_plane(v);
    const Complex want = half_plane(v);
    const double error = std::abs(Complex(got.in_phase, got.quadrature) - want);
    worst = std::max(worst, error);
    if (v > 5.0) {
      EXPECT_LT(error, 1.2e-4);
    }
    if (v > -0.7) {
      worst_db = std::max(worst_db, std::fabs(decibels(std::norm(want)) + knife_edge_db(v)));
    }
  }
  std::printf("worst error %.1e in voltage; J(v) is off the integral by %.2f dB\n", worst,
              worst_db);
  EXPECT_LT(worst, 2.2e-3);
  EXPECT_LT(worst_db, 0.6);
  // SOURCES.md "Vectors".
  const auto loss = [](double v) {
    const Voltage e = past_half_plane(v);
    return -decibels(e.in_phase * e.in_phase + e.quadrature * e.quadrature);
  };
  EXPECT_NEAR(loss(0.0), 6.03, 0.02);
  EXPECT_NEAR(loss(1.0), 13.93, 0.35);
  EXPECT_NEAR(loss(2.4), 20.54, 0.35);
}

// One-way power behind the strip from the definition: Fresnel past both edges over the antenna.
double brute_force(const Obstruction& o, double wavelength, double antenna, double lateral) {
  const double fresnel = std::sqrt(0.5 * wavelength * o.distance_m);
  const int taps = 400;
  Complex sum = 0.0;
  double weights = 0.0;
  for (int k = 0; k < taps; ++k) {
    const double u = antenna * ((k + 0.5) / taps - 0.5);
    const double weight = std::cos(kPi * u / antenna);
    const double y = lateral - u;
    sum += weight * (half_plane((0.5 * o.width_m - y) / fresnel) +
                     half_plane((0.5 * o.width_m + y) / fresnel));
    weights += weight;
  }
  return std::norm(sum / weights);
}

TEST(StripShadow, IsTheIntegralOverTheAntenna) {
  double worst = 0.0;
  for (const Obstruction& o : {Obstruction{0.0, 0.6, 8.0}, Obstruction{0.0, 4.0, 15.0},
                               Obstruction{0.0, 0.3, 60.0}, Obstruction{0.0, 1.5, 2.0}}) {
    for (const double wavelength : {0.0319, 0.0983}) {
      const double antenna = antenna_width_m(wavelength < 0.05 ? 1.2 : 1.9, wavelength);
      const StripShadow shadow(o, wavelength, antenna);
      const double fresnel = std::sqrt(0.5 * wavelength * o.distance_m);
      const double followed = 0.5 * o.width_m + 0.5 * antenna + 7.5 * fresnel;
      for (int k = 0; k <= 24; ++k) {
        const double lateral = followed * k / 24.0;
        const double error = std::fabs(std::sqrt(shadow.one_way(lateral)) -
                                       std::sqrt(brute_force(o, wavelength, antenna, lateral)));
        worst = std::max(worst, error);
      }
    }
  }
  std::printf("worst error %.4f in voltage\n", worst);
  EXPECT_LT(worst, 0.01);
}

TEST(StripShadow, AFunnelBlindsAndAMastOnlyDims) {
  const double wavelength = RadarSet{}.wavelength_m();
  const double antenna = antenna_width_m(1.2, wavelength);
  EXPECT_NEAR(antenna, 1.83, 0.01);
  const double mast = StripShadow({0.0, 0.3, 8.0}, wavelength, antenna).one_way(0.0);
  const double funnel = StripShadow({0.0, 6.0, 15.0}, wavelength, antenna).one_way(0.0);
  std::printf("two-way: mast of 0.3 m %.1f dB, funnel of 6 m %.1f dB\n", 2.0 * decibels(mast),
              2.0 * decibels(funnel));
  EXPECT_GT(2.0 * decibels(mast), -8.0);
  EXPECT_LT(2.0 * decibels(mast), -3.0);
  EXPECT_LT(2.0 * decibels(funnel), -30.0);
}

Scene with(std::vector<Obstruction> obstructions, std::vector<BlankedSector> blanked = {}) {
  Scene scene;
  scene.obstructions = std::move(obstructions);
  scene.blanked = std::move(blanked);
  return scene;
}

TEST(ShadowSectors, TheShadowIsAsWideAsItsGeometry) {
  OwnShipGain gain(small_model());
  for (const Obstruction& o : {Obstruction{180.0, 8.0, 20.0}, Obstruction{40.0, 12.0, 60.0},
                               Obstruction{359.0, 5.0, 12.0}}) {
    gain.prepare(with({o}));
    // On the geometric edge of a shadow a quarter of the power comes one way: 12 dB two-way.
    double width = 0.0;
    for (double off = -90.0; off < 90.0; off += 0.01)
      width += gain.two_way(units(o.bearing_deg + off)) < 1.0f / 16.0f ? 0.01 : 0.0;
    const double geometric = 2.0 * std::atan(0.5 * o.width_m / o.distance_m) * 180.0 / kPi;
    std::printf("2 atan(w/2d) %.2f deg, 12 dB down over %.2f deg\n", geometric, width);
    EXPECT_NEAR(width, geometric, 0.12);
    EXPECT_EQ(gain.two_way(units(o.bearing_deg + 180.0)), 1.0f);
  }
}

TEST(ShadowSectors, ThePenumbraFallsSmoothly) {
  OwnShipGain gain(small_model());
  gain.prepare(with({{180.0, 8.0, 20.0}}));
  float steepest = 0.0f;
  for (double off = -60.0; off < 60.0; off += 0.02) {
    const float here = gain.one_way(units(180.0 + off));
    EXPECT_GE(here, 0.999f * static_cast<float>(kLeastGain));
    EXPECT_LT(here, 1.9f);
    steepest = std::max(steepest, std::fabs(gain.one_way(units(180.02 + off)) - here));
  }
  EXPECT_LT(steepest, 0.02f);
}

TEST(ShadowSectors, SeveralMastsMultiply) {
  OwnShipGain one(small_model()), other(small_model()), both(small_model());
  const Obstruction a{10.0, 0.6, 8.0}, b{14.0, 0.4, 12.0};
  one.prepare(with({a}));
  other.prepare(with({b}));
  both.prepare(with({a, b}));
  for (double at = 0.0; at < 30.0; at += 0.5) {
    const double want = double{one.one_way(units(at))} * double{other.one_way(units(at))};
    EXPECT_NEAR(double{both.one_way(units(at))}, want, 0.003) << at;
  }
}

TEST(ShadowSectors, ABlankedSectorIsExactAndGoesThroughTheBow) {
  OwnShipGain gain(small_model());
  gain.prepare(with({}, {{350.0, 10.0}, {90.0, 91.0}, {200.0, 200.0}}));
  EXPECT_TRUE(gain.any());
  for (const double at : {350.0, 355.0, 0.0, 10.0, 90.0, 90.5, 91.0}) {
    EXPECT_EQ(gain.two_way(units(at)), 0.0f) << at;
    EXPECT_FALSE(gain.transmits(units(at)));
    EXPECT_EQ(gain.one_way(units(at)), 1.0f) << "it still hears";
  }
  for (const double at : {349.999, 10.001, 89.999, 91.001, 200.0}) {
    EXPECT_EQ(gain.two_way(units(at)), 1.0f) << at;
  }
}

TEST(ShadowSectors, NothingInTheWayCostsNothing) {
  OwnShipGain gain(small_model());
  gain.prepare(with({}));
  EXPECT_FALSE(gain.any());
  Scene off = with({{180.0, 8.0, 20.0}});
  off.artefacts.shadow_sectors = false;
  gain.prepare(off);
  EXPECT_FALSE(gain.any());
  off.artefacts.shadow_sectors = true;
  gain.prepare(off);
  EXPECT_TRUE(gain.any());
  EXPECT_LT(gain.two_way(units(180.0)), 0.01f);
}

TEST(ShadowSectors, FromZeroToThreeHundredAndSixtyIsBlankedAllRound) {
  OwnShipGain gain(small_model());
  Scene scene = with({});
  scene.blanked = {{0.0, 360.0}};
  gain.prepare(scene);
  for (const double deg : {0.0, 90.0, 180.0, 270.0, 359.9})
    EXPECT_FALSE(gain.transmits(units(deg))) << deg;
}

TEST(ShadowSectors, UnlikelyRigsStayInBounds) {
  OwnShipGain gain(small_model());
  std::vector<Obstruction> rig;
  for (int i = 0; i < 100; ++i) rig.push_back({3.6 * i, 30.0, 0.5});
  rig.push_back({0.0, 0.05, 200.0});
  gain.prepare(with(rig));
  for (int i = 0; i < 3600; ++i) {
    const float g = gain.two_way(units(0.1 * i));
    EXPECT_GE(g, 0.99e-8f);
    EXPECT_LT(g, 3.7f);
  }
}

}  // namespace
}  // namespace skerry::echo
