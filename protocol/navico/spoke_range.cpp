#include "protocol/navico/spoke_range.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/wire/byte_order.hpp"

namespace skerry::navico {
namespace {

// One unit of a BR24's range, 10/sqrt(2) m.
constexpr double kFirstGenerationUnit = 7.0710678118654752;
// Units per metre of set range: what the BR24 and 3G of the recordings say, rounded down, at all
// their 18 ranges from 50 m to 24 NM.
constexpr double kFirstGenerationFactor = 0.2502025;
constexpr double kG4Factor = 1000.0 / 512.0, kHaloFactor = 880.0 / 512.0;
constexpr std::uint16_t kSmallForm = 0x80;  // in the large field: the small one counts, quarters
// From here (a chart plotter's step after 2 NM is 3 NM) the large form; the small one would
// overflow 15 bits soon after.
constexpr double kLargeFormFrom_m = 4100.0;
constexpr double kG4Step_m = 64.0, kG4Most_m = 72'704.0;
constexpr double kHalo20Most_m = 57'860.0;

SpokeRange later(std::uint16_t large, std::uint16_t small, double reach_m) {
  SpokeRange range;
  range.at_4 = {0x00, 0x44, 0, 0};
  put_little_endian(range.at_4, 2, large, 2);
  put_little_endian(range.at_12, 0, small, 2);
  range.reach = metres(reach_m);
  return range;
}

SpokeRange small_form(double reach_m) {
  const double whole = std::floor(reach_m + 0.5);
  return later(kSmallForm, static_cast<std::uint16_t>(whole * 4.0), whole);
}

}  // namespace

SpokeRange spoke_range(Model model, std::uint32_t range_dm) {
  const double range_m = range_dm / 10.0;
  if (is_first_generation(model)) {
    const auto units = static_cast<std::uint32_t>(range_m * kFirstGenerationFactor);
    SpokeRange range;
    range.at_4 = {0x00, 0x44, 0x0D, 0x0E};
    put_little_endian(range.at_12, 0, units, 3);
    range.reach = metres(units * kFirstGenerationUnit);
    return range;
  }
  if (model == Model::g4) {
    const double reach_m = range_m * kG4Factor;
    if (range_m < kLargeFormFrom_m) return small_form(reach_m);
    const double steps = std::floor(std::min(reach_m, kG4Most_m) / kG4Step_m);
    return later(static_cast<std::uint16_t>(steps), 0x8000, steps * kG4Step_m);
  }
  const double reach_m = range_m * kHaloFactor;
  if (range_m < kLargeFormFrom_m) return small_form(reach_m);
  // A half rounds down: 7408 m is 12732.5 m, and the recording has 12732.
  const double most = model == Model::halo20 ? kHalo20Most_m : 4.0 * 65535.0;
  const double whole = std::ceil(std::min(reach_m, most) - 0.5);
  std::uint16_t small = 512;
  double large = whole;
  while (large > 65535.0) {
    small = static_cast<std::uint16_t>(small * 2);
    large = std::floor(large / 2.0);
  }
  return later(static_cast<std::uint16_t>(large), small, large * small / 512.0);
}

Length reach_of(Model model, std::span<const std::uint8_t> header) {
  if (is_first_generation(model)) {
    return metres(little_endian_at<std::uint32_t>(header, 12, 3) * kFirstGenerationUnit);
  }
  const auto large = little_endian_at<std::uint16_t>(header, 6);
  const auto small = little_endian_at<std::uint16_t>(header, 12);
  if (large == kSmallForm) return metres(small / 4.0);
  if (model == Model::g4) return metres(static_cast<std::int16_t>(large) * kG4Step_m);
  return metres(static_cast<double>(large) * small / 512.0);
}

}  // namespace skerry::navico
