#include "echo/targets/echo_splat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/shared_tables.hpp"
#include "echo/kernel/splat_row.hpp"
#include "echo/radar/beam.hpp"
#include "echo/targets/point_echo.hpp"
#include "echo/targets/sector_view.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kMainPlaces = 512;
constexpr double kNearLobesDeg = 5.0;
constexpr float kSlightestPower = 1e-4f;  // of the noise: weaker points are left out
constexpr float kLeastLobe = 0.05f;       // of the noise: weaker side lobes are
constexpr float kLeastCellShare = 1e-7f;  // of a cell
constexpr float kNull = 1e-6f;            // two-way voltage that counts as none

constexpr std::uint32_t kPhases = 1024;
struct Phasors {
  std::array<float, kPhases> cosine, sine;
};
const Phasors& phasors() {
  static const Phasors table = [] {
    Phasors made;
    for (std::uint32_t k = 0; k < kPhases; ++k) {
      const SinCos at = sin_cos_units(k << 22);
      made.cosine[k] = static_cast<float>(at.cos), made.sine[k] = static_cast<float>(at.sin);
    }
    return made;
  }();
  return table;
}

std::shared_ptr<const std::vector<float>> main_lobe_of(double beam_width_deg,
                                                       std::uint32_t null_units) {
  static SharedTables<double, std::vector<float>> tables;
  return tables.get(beam_width_deg, [&] {
    std::vector<float> lobe;
    for (std::uint32_t k = 0; k <= kMainPlaces + 1; ++k) {
      const double off = null_units / kUnitsPerDegree * k / kMainPlaces;
      const double v = std::max(0.0, cosine_taper_voltage(off, beam_width_deg));
      lobe.push_back(static_cast<float>(v * v));
    }
    return lobe;
  });
}

// A share so small that its square, with the slightest of levels, might be denormal counts as none.
float root_of_share(float share) { return share < kLeastCellShare ? 0.0f : std::sqrt(share); }

}  // namespace

EchoSplat::EchoSplat(const RadarModel& model)
    : model_(model),
      pattern_(antenna_pattern_for(model.set)),
      null_units_(static_cast<std::uint32_t>(1.25 * model.set.beam_width_deg * kUnitsPerDegree)),
      lobes_units_(
          std::max(null_units_, static_cast<std::uint32_t>(kNearLobesDeg * kUnitsPerDegree))),
      to_place_(static_cast<float>(kMainPlaces) / static_cast<float>(null_units_)),
      response_(range_response_for(model)),
      main_lobe_(main_lobe_of(model.set.beam_width_deg, null_units_)),
      far_(model) {
  const double highest = std::max(model.set.near_side_lobe_db, model.set.far_side_lobe_db);
  stands_out_ = static_cast<float>(kLeastLobePower / ratio_from_decibels(2.0 * highest));
}

// Two-way voltage is one-way power.
inline __attribute__((always_inline)) float EchoSplat::voltage(std::uint32_t off_units) const {
  if (off_units < null_units_) {
    const float place = static_cast<float>(off_units) * to_place_;
    const auto k = static_cast<std::uint32_t>(place);
    const float t = place - static_cast<float>(k);
    const float* const lobe = main_lobe_->data() + k;
    return lobe[0] + t * (lobe[1] - lobe[0]);
  }
  return side_lobes_ ? pattern_->one_way(off_units) : 0.0f;
}

bool EchoSplat::lay(const PointEcho& echo, Point& point) {
  const double start = echo.range_m / model_.cell_m;
  const std::uint32_t lead = response_->lead();
  if (!(start >= 0.0) || start >= model_.geometry.cells + lead) return false;
  const auto cell = static_cast<std::uint32_t>(start);
  // What would lie before the antenna is left out.
  const std::uint32_t before = cell < lead ? lead - cell : 0;
  point.units = echo.bearing_units;
  point.cell = cell + before - lead;
  point.cells = std::min(response_->cells() - before, model_.geometry.cells - point.cell);
  point.shares =
      static_cast<std::uint32_t>(laid_.shares.size()) + point.cell % kSplatLanes + before;
  // Zeros from the beginning of a block, and to the end of one.
  const std::uint32_t into_block = point.cell % kSplatLanes;
  laid_.shares.resize(laid_.shares.size() + into_block + before + point.cells);
  const std::span<float> shares = std::span(laid_.shares).last(before + point.cells);
  response_->shares_of(start - cell, shares);
  for (float& share : shares) share = root_of_share(share);
  laid_.shares.resize(laid_.shares.size() + (0u - into_block - point.cells) % kSplatLanes);
  const float amplitude = std::sqrt(std::min(echo.power, kMaxPointPower));
  const auto turn = static_cast<std::uint32_t>(
      static_cast<std::int32_t>(echo.phase * static_cast<float>(kPhases)));
  point.in_phase = amplitude * phasors().cosine[turn % kPhases];
  point.quadrature = amplitude * phasors().sine[turn % kPhases];
  return true;
}

void EchoSplat::prepare(const std::vector<PointEcho>& points, const SpokeAim& first,
                        const SpokeAim& last, const StrongEchoes* strong) {
  side_lobes_ = strong != nullptr;
  if (released_) laid_ = shelf().take();
  released_ = false;
  laid_.near.clear(), laid_.met.clear(), laid_.points.clear(), laid_.shares.clear(),
      laid_.bodies.clear(), far_.clear();
  const auto turned = static_cast<std::int32_t>(last.plane_units - first.plane_units);
  const std::uint32_t middle = first.plane_units + static_cast<std::uint32_t>(turned / 2);
  const std::uint32_t half = static_cast<std::uint32_t>(std::abs(turned / 2)) + 1;
  for (const PointEcho& echo : points) {
    if (!(echo.power > kSlightestPower)) continue;
    const std::uint32_t off = units_apart(echo.bearing_units, middle);
    const std::uint32_t reach =
        side_lobes_ && echo.power > stands_out_ ? lobes_units_ : null_units_;
    if (off > half + reach) continue;
    laid_.near.push_back(echo);
    if (laid_.met.empty() || laid_.met.back() != echo.body) laid_.met.push_back(echo.body);
  }
  if (strong && !strong->points.empty()) {
    take_near_of(*strong, middle, half + lobes_units_);
    far_.prepare(*pattern_, *strong, laid_.met, half + lobes_units_, first, last);
  }
  const auto by_body = [](const PointEcho& a, const PointEcho& b) { return a.body < b.body; };
  if (!std::is_sorted(laid_.near.begin(), laid_.near.end(), by_body))
    std::stable_sort(laid_.near.begin(), laid_.near.end(), by_body);
  lay_bodies();
}

Shelf<EchoSplat::Laid>& EchoSplat::shelf() {
  static Shelf<Laid> shelf;
  return shelf;
}

void EchoSplat::release() {
  if (released_) return;
  shelf().put_back(std::move(laid_));
  released_ = true;
}

void EchoSplat::take_near_of(const StrongEchoes& strong, std::uint32_t middle,
                             std::uint32_t reach) {
  for (const PointEcho& echo : strong.points) {
    if (units_apart(echo.bearing_units, middle) > reach || !(echo.power > stands_out_)) continue;
    if (std::find(laid_.met.begin(), laid_.met.end(), echo.body) == laid_.met.end())
      laid_.near.push_back(echo);
  }
}

void EchoSplat::lay_bodies() {
  for (std::size_t i = 0; i < laid_.near.size();) {
    const auto begin = static_cast<std::uint32_t>(laid_.points.size());
    const std::uint32_t about = laid_.near[i].bearing_units, number = laid_.near[i].body;
    std::int64_t left = 0, right = 0;
    std::uint32_t cell = ~0u, cell_end = 0;
    bool stands_out = false;
    float power = 0.0f;
    for (; i < laid_.near.size() && laid_.near[i].body == number; ++i) {
      Point point;
      if (!lay(laid_.near[i], point)) continue;
      laid_.points.push_back(point);
      const std::int64_t off = static_cast<std::int32_t>(point.units - about);
      left = std::min(left, off), right = std::max(right, off);
      cell = std::min(cell, point.cell);
      cell_end = std::max(cell_end, point.cell + point.cells);
      stands_out = stands_out || laid_.near[i].power > stands_out_;
      power += std::min(laid_.near[i].power, kMaxPointPower);
    }
    const auto end = static_cast<std::uint32_t>(laid_.points.size());
    if (end == begin) continue;
    const auto half = static_cast<std::uint32_t>((right - left) / 2 + 1);
    const std::uint32_t lobes = side_lobes_ && stands_out ? lobes_units_ : null_units_;
    laid_.bodies.push_back({begin, end, about + static_cast<std::uint32_t>((left + right) / 2),
                            std::min(half + lobes, kUnitsPerHalfTurn), half + null_units_, power,
                            cell, std::min(cell_end, model_.geometry.cells), number});
  }
}

void EchoSplat::add_power(const Point& point, float factor, std::span<float> power) const {
  const float level =
      factor * (point.in_phase * point.in_phase + point.quadrature * point.quadrature);
  if (!(level > kSlightestPower)) return;
  const float* const shares = laid_.shares.data() + point.shares;
  float* const cells = power.data() + point.cell;
  for (std::size_t c = 0; c < point.cells; ++c) cells[c] += level * shares[c] * shares[c];
}

void EchoSplat::add_body(const Body& body, std::uint32_t axis_units, std::span<float> power) const {
  thread_local std::vector<float> voltages;
  thread_local std::vector<SplatPoint> seen;
  const std::uint32_t first = body.cell / kSplatLanes * kSplatLanes;
  const std::size_t width = body.cell_end - first;
  if (voltages.size() < 2 * (width + kSplatLanes)) voltages.resize(2 * (width + kSplatLanes));
  if (seen.size() < body.end - body.begin) seen.resize(body.end - body.begin);
  std::size_t count = 0;
  for (std::uint32_t i = body.begin; i < body.end; ++i) {
    const Point& point = laid_.points[i];
    const float g = voltage(units_apart(point.units, axis_units));
    if (g < kNull) continue;
    const std::uint32_t into_block = point.cell % kSplatLanes;
    seen[count++] = {laid_.shares.data() + (point.shares - into_block),
                     point.cell - into_block - first, point.cells + into_block, g * point.in_phase,
                     g * point.quadrature};
  }
  if (count > 0) add_voltages(std::span(seen).first(count), voltages, power.subspan(first, width));
}

bool EchoSplat::add_one(const Body& body, const SpokeAim& aim, std::span<float> power) const {
  const std::uint32_t off = units_apart(aim.plane_units, body.middle);
  if (off > body.reach) return false;
  if (off < body.main_reach && body.end - body.begin > 1) {
    add_body(body, aim.plane_units, power);
    return true;
  }
  const float g = voltage(off);
  if (off >= body.main_reach && !(g * g * body.power > kLeastLobe)) return false;
  for (std::uint32_t i = body.begin; i < body.end; ++i) add_power(laid_.points[i], g * g, power);
  return true;
}

void EchoSplat::add(const SpokeAim& aim, std::span<float> power) const {
  for (const Body& body : laid_.bodies) add_one(body, aim, power);
  far_.add(aim, power);
}

void EchoSplat::each_body(const SpokeAim& aim, std::size_t cells, const VisitBody& visit) const {
  thread_local std::vector<float> alone;
  if (alone.size() < cells) alone.resize(cells);
  const std::span row(alone.data(), cells);
  for (const Body& body : laid_.bodies) {
    const auto filled = row.subspan(body.cell, body.cell_end - body.cell);
    std::fill(filled.begin(), filled.end(), 0.0f);
    if (add_one(body, aim, row)) visit(body.number, body.cell, filled);
  }
}

}  // namespace skerry::echo
