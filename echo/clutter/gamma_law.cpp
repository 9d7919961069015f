#include "echo/clutter/gamma_law.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {

namespace {

constexpr double kTwoOfTen = 3.3219280948873623;  // log2(10)

double log2_shape(double grazing_deg, double cell_area_m2, Polarisation polarisation) {
  const double psi = std::clamp(grazing_deg, 0.1, 10.0);
  const double k = polarisation == Polarisation::hh ? 2.09 : 1.39;
  return (2.0 / 3.0) * exact_log2(psi) + 0.625 * exact_log2(std::max(cell_area_m2, 1e-3)) -
         k * kTwoOfTen;
}

double bounded(double log2_nu) {
  return std::clamp(exact_exp2(log2_nu), kLeastShape, kGreatestShape);
}

}  // namespace

double k_shape(double grazing_deg, double cell_area_m2, Polarisation polarisation) {
  return bounded(log2_shape(grazing_deg, cell_area_m2, polarisation));
}

double k_shape_in_swell(double grazing_deg, double cell_area_m2, Polarisation polarisation,
                        double swell_deg) {
  return bounded(log2_shape(grazing_deg, cell_area_m2, polarisation) -
                 kTwoOfTen / 3.0 * sin_cos_degrees(2.0 * swell_deg).cos);
}

namespace {

constexpr float kHigh = 4.5f;

struct QuantileFit {
  float low;
  std::array<float, 7> terms;
};

// nu = 0.1 * 2^(k/4).  log2 of the gamma quantile over nu, interpolated at the seven Chebyshev
// nodes between `low`, where it is -14 (or -4.5), and 4.5.
constexpr QuantileFit kFits[] = {
    {-0.477829f, {3.397165f, 5.026926f, -4.04172f, 4.653224f, -3.875636f, 0.5204947f, 0.7096747f}},
    {-0.645366f, {3.141874f, 5.097302f, -4.0847f, 4.612014f, -3.725206f, 0.3827014f, 0.7509108f}},
    {-0.822466f, {2.884832f, 5.172831f, -4.129001f, 4.556739f, -3.55973f, 0.2541491f, 0.780467f}},
    {-1.010001f, {2.626301f, 5.253113f, -4.173656f, 4.48673f, -3.37996f, 0.1360275f, 0.7979368f}},
    {-1.208934f, {2.366601f, 5.337616f, -4.217574f, 4.401677f, -3.187162f, 0.02930526f, 0.803267f}},
    {-1.420334f,
     {2.106106f, 5.425678f, -4.259571f, 4.301667f, -2.983116f, -0.06530801f, 0.796777f}},
    {-1.645378f,
     {1.845255f, 5.516513f, -4.298398f, 4.187209f, -2.770079f, -0.1473901f, 0.7791567f}},
    {-1.885372f, {1.584543f, 5.60923f, -4.332798f, 4.059224f, -2.550711f, -0.216821f, 0.7514414f}},
    {-2.141758f,
     {1.324529f, 5.702847f, -4.361551f, 3.919032f, -2.327973f, -0.2737828f, 0.7149629f}},
    {-2.416131f, {1.065822f, 5.79633f, -4.383542f, 3.768294f, -2.104993f, -0.318744f, 0.6712807f}},
    {-2.710250f,
     {0.8090782f, 5.888623f, -4.397809f, 3.608951f, -1.884919f, -0.3524277f, 0.6220982f}},
    {-3.026057f,
     {0.5549869f, 5.97869f, -4.403605f, 3.443138f, -1.670769f, -0.3757683f, 0.5691701f}},
    {-3.365687f,
     {0.3042589f, 6.06555f, -4.400432f, 3.273087f, -1.465284f, -0.3898588f, 0.5142112f}},
    {-3.731487f,
     {0.05761053f, 6.148318f, -4.388067f, 3.101035f, -1.270815f, -0.3958924f, 0.4588144f}},
    {-4.126033f,
     {-0.1842528f, 6.226231f, -4.366569f, 2.929135f, -1.089233f, -0.3951062f, 0.4043839f}},
    {-4.500000f,
     {-0.3845035f, 6.212043f, -4.23847f, 2.696014f, -0.9171232f, -0.3708083f, 0.3454772f}},
    {-4.500000f,
     {-0.3199051f, 5.598779f, -3.475777f, 2.074342f, -0.7221111f, -0.2363255f, 0.2464788f}},
    {-4.500000f,
     {-0.2665338f, 5.06193f, -2.86156f, 1.584836f, -0.549419f, -0.1424366f, 0.1664414f}},
    {-4.500000f,
     {-0.2223475f, 4.587938f, -2.364005f, 1.205621f, -0.407292f, -0.08081277f, 0.1071862f}},
    {-4.500000f,
     {-0.1856947f, 4.166515f, -1.958625f, 0.9154494f, -0.2963438f, -0.04284074f, 0.06636496f}},
    {-4.500000f,
     {-0.1552372f, 3.78978f, -1.626648f, 0.6951387f, -0.2129222f, -0.02088707f, 0.03983451f}},
    {-4.500000f,
     {-0.1298871f, 3.451566f, -1.353611f, 0.5284857f, -0.1517772f, -0.009004058f, 0.02336289f}},
    {-4.500000f,
     {-0.1087578f, 3.146913f, -1.128253f, 0.4024978f, -0.1076904f, -0.003029872f, 0.01348299f}},
    {-4.500000f,
     {-0.09112425f, 2.871743f, -0.9417066f, 0.3071283f, -0.07621781f, -0.0003022017f,
      0.007701616f}},
    {-4.500000f,
     {-0.07639182f, 2.622632f, -0.7869132f, 0.2347753f, -0.05387683f, 0.000757975f, 0.004374436f}},
    {-4.500000f,
     {-0.0640714f, 2.396676f, -0.6582071f, 0.1797479f, -0.03806503f, 0.00102723f, 0.002479209f}},
    {-4.500000f,
     {-0.05375955f, 2.191381f, -0.5510077f, 0.1377989f, -0.02689005f, 0.0009626137f, 0.001405494f}},
    {-4.500000f,
     {-0.04512269f, 2.004595f, -0.4615908f, 0.1057537f, -0.01899657f, 0.0007867472f,
      0.0007983494f}},
    {-4.500000f,
     {-0.03788434f, 1.834442f, -0.3869137f, 0.0812317f, -0.01342169f, 0.0005987264f,
      0.0004548394f}},
    {-4.500000f,
     {-0.03181491f, 1.679281f, -0.3244807f, 0.06243989f, -0.009484092f, 0.0004363187f,
      0.0002600607f}},
    {-4.500000f,
     {-0.02672338f, 1.537667f, -0.2722373f, 0.04802267f, -0.006702513f, 0.0003089747f,
      0.0001492619f}},
    {-4.500000f,
     {-0.0224506f, 1.408322f, -0.2284871f, 0.0369514f, -0.004737247f, 0.0002144501f,
      8.599744e-05f}},
    {-4.500000f,
     {-0.01886378f, 1.290109f, -0.1918256f, 0.02844317f, -0.003348521f, 0.0001466869f,
      4.97306e-05f}},
    {-4.500000f,
     {-0.01585197f, 1.182012f, -0.1610876f, 0.02190068f, -0.002367072f, 9.92465e-05f,
      2.885766e-05f}},
};
constexpr int kLastFit = static_cast<int>(sizeof(kFits) / sizeof(kFits[0])) - 1;

}  // namespace

RankLaw gamma_law(double nu) {
  const double steps = 4.0 * exact_log2(std::clamp(nu, kLeastShape, kGreatestShape) / kLeastShape);
  const int k = std::min(static_cast<int>(steps), kLastFit - 1);
  const auto share = static_cast<float>(steps - k);
  const QuantileFit &a = kFits[k], &b = kFits[k + 1];
  RankLaw law;
  law.low = a.low + share * (b.low - a.low);
  law.high = kHigh;
  law.slope = 2.0f / (kHigh - law.low);
  law.offset = -1.0f - law.low * law.slope;
  for (std::size_t i = 0; i < law.terms.size(); ++i) {
    law.terms[i] = a.terms[i] + share * (b.terms[i] - a.terms[i]);
  }
  return law;
}

}  // namespace skerry::echo
