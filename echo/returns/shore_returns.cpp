#include "echo/returns/shore_returns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "echo/returns/cover_echo.hpp"
#include "echo/returns/land_ray.hpp"
#include "echo/returns/natural_land.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kFarInland = 900.0;  // of land with no shore in sight, metres

struct Inland {
  double from_begin, from_end;  // metres; huge where that end is open
  double nearest() const { return std::max(0.0, std::min(from_begin, from_end)); }
  bool begin_is_nearer() const { return from_begin <= from_end; }
};

Inland inland_at(const ShoreStretch& s, double range) {
  constexpr double kFar = 1e9;
  if (s.begin.open && s.end.open) return {kFarInland, kFarInland};
  return {s.begin.open ? kFar : range - s.begin.at_m, s.end.open ? kFar : s.end.at_m - range};
}

// Both ends open: as of an unknown shore.
ShoreState state_of(const ShoreStretch& s, bool begin) {
  if (s.begin.open && s.end.open) return {};
  if (s.begin.open) return s.end.state;
  if (s.end.open) return s.begin.state;
  return begin ? s.begin.state : s.end.state;
}

class ShoreRay {
 public:
  ShoreRay(const LandModel& model, const ShoreWater& water, const LatticePath& path,
           const ChartedRelief* relief, GroundProfile* profile, std::span<float> power,
           const ChartedCover* cover)
      : model_(model),
        water_(water),
        path_(path),
        relief_(relief),
        profile_(profile),
        power_(power),
        ray_(model, power) {
    if (cover) cover_.emplace(*cover, model, path, power.size());
    if (!relief) return;
    step_m_ = relief->grid.step_lat_deg * kMeanMetresPerDegree;
    const auto fine = fine_octaves(model.cell_m);
    std::size_t coarse = 0;
    while (coarse < fine.size() && fine[coarse].wavelength_m > step_m_) ++coarse;
    below_step_ = fine.subspan(coarse);
  }

  void add(const ShoreStretch& stretch) {
    const auto first = static_cast<std::size_t>(stretch.begin_m / model_.cell_m);
    if (first >= power_.size()) return;
    const std::size_t last =
        std::min(power_.size() - 1, static_cast<std::size_t>(stretch.end_m / model_.cell_m));
    record_shadow(first);
    if (is_natural(stretch)) {
      if (!natural_) natural_.emplace(model_, path_);
      natural_->add(stretch.begin_m, stretch.end_m, {stretch.begin.at_m, stretch.end.at_m}, ray_,
                    profile_, power_, cover_ ? &*cover_ : nullptr);
      record_shadow(last + 1);
      return;
    }
    add_face(stretch, first);
    for (std::size_t cell = first; cell <= last; cell += kLandChunk) {
      const std::size_t end = std::min(last, cell + kLandChunk - 1);
      add_chunk(stretch, cell, end);
      record_shadow(end + 1);
    }
  }

  void finish() { record_shadow(power_.size()); }

 private:
  using Chunk = std::array<float, kLandChunk>;

  void record_shadow(std::size_t end) {
    if (profile_) profile_->fill(end, static_cast<float>(ray_.shadow()));
  }

  bool is_natural(const ShoreStretch& s) const {
    return !relief_ && is_plain(s.begin.state.shore) && is_plain(s.end.state.shore) &&
           !s.begin.open && !s.end.open;
  }

  void add_face(const ShoreStretch& stretch, std::size_t first) {
    const double face = stretch.begin.open ? 0.0 : face_height(stretch.begin.state);
    if (face <= 0.0) return;
    const double shown = ray_.shown(face, ray_.middle_of(first));
    if (shown <= 0.0) return;
    const double near = stretch.begin_m - stretch.face_near_m;
    const double far = stretch.begin_m + stretch.face_far_m, depth = far - near;
    const auto begin = static_cast<std::size_t>(std::max(0.0, near) / model_.cell_m);
    for (std::size_t cell = begin; cell < power_.size(); ++cell) {
      const double cell_near = static_cast<double>(cell) * model_.cell_m;
      if (cell_near > far) break;
      const double within = std::min(far, cell_near + model_.cell_m) - std::max(near, cell_near);
      ray_.echo(cell, shown, kFaceGamma, depth > 0.0 ? within / depth : 1.0);
    }
  }

  void add_chunk(const ShoreStretch& stretch, std::size_t first, std::size_t last) {
    const std::size_t count = last - first + 1;
    Chunk raster;
    double raster_most = 0.0;
    bool synthetic = true;
    if (relief_) synthetic = read_raster(first, {raster.data(), count}, raster_most);
    const double greatest = greatest_in(stretch, first, last, synthetic, raster_most);
    const auto hidden = [&](double objects) {
      return ray_.hides(greatest + objects, ray_.middle_of(first), ray_.middle_of(last));
    };
    if (hidden(cover_ ? static_cast<double>(kTallestObject) : 0.0)) return;
    const bool covered = cover_ && cover_->read(first, count);
    if (cover_ && hidden(covered ? cover_->most_objects(first, count) : 0.0)) return;

    const auto first32 = static_cast<std::uint32_t>(first);
    Chunk broad, fine, below_step{}, wash{}, objects{};
    relief_noise(path_, broad_octaves(model_.cell_m), model_.seed, first32, {broad.data(), count});
    relief_noise(path_, fine_octaves(model_.cell_m), model_.seed ^ kFineSeed, first32,
                 {fine.data(), count});
    if (relief_)
      relief_noise(path_, below_step_, model_.seed ^ kFineSeed, first32,
                   {below_step.data(), count});
    const bool washed = water_.wave_height_m > 0.0 && is_sandy(stretch);
    if (washed) beach_noise(water_, path_, first32, {wash.data(), count});

    if (covered) cover_->objects(first, {objects.data(), count});

    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t cell = first + k;
      const double middle = ray_.middle_of(cell);
      const double range = std::clamp(middle, stretch.begin_m, stretch.end_m);
      const double fine_noise = static_cast<double>(fine[k]);
      const LandCover cover = covered ? cover_->at(cell) : LandCover::none;
      Ground ground = ground_at(stretch, range, static_cast<double>(broad[k]), fine_noise,
                                cover == LandCover::none);
      if (relief_ && raster[k] == raster[k]) {
        ground.height_m = charted_height(stretch, range, static_cast<double>(raster[k]), step_m_,
                                         static_cast<double>(below_step[k]));
      }
      if (profile_) {
        record_shadow(cell + 1);
        profile_->height_m[cell] = static_cast<float>(ground.height_m);
      }
      if (cover != LandCover::none) {
        const Inland inland = inland_at(stretch, range);
        const double share =
            cover_share(state_of(stretch, inland.begin_is_nearer()), inland.nearest());
        const auto gamma = static_cast<double>(echo_of(cover).gamma);
        ground.height_m += share * static_cast<double>(objects[k]);
        ground.gamma += share * (gamma - ground.gamma);
      }
      const double shown = ray_.shown(ground.height_m, middle);
      if (shown <= 0.0) continue;
      if (washed)
        ground.gamma *= 1.0 + 0.9 * wetness(stretch, range) * static_cast<double>(wash[k]);
      ray_.echo(cell, shown, ground.gamma, static_cast<double>(cover_of(fine[k])));
    }
  }

  // Heights of the raster under the cells; whether one of them has no data.
  bool read_raster(std::size_t first, std::span<float> out, double& most) {
    const auto count = static_cast<double>(out.size());
    const GeoPoint from = relief_->track.at(ray_.middle_of(first));
    const GeoPoint to = relief_->track.at(ray_.middle_of(first) + count * model_.cell_m);
    bool gaps = false;
    for (std::size_t k = 0; k < out.size(); ++k) {
      const double t = static_cast<double>(k) / count;
      out[k] = relief_->grid.at({from.latitude_deg + t * (to.latitude_deg - from.latitude_deg),
                                 from.longitude_deg + t * (to.longitude_deg - from.longitude_deg)});
      if (out[k] == out[k]) {
        most = std::max(most, static_cast<double>(out[k]));
      } else {
        gaps = true;
      }
    }
    return gaps;
  }

  // No cell of the chunk stands higher.
  double greatest_in(const ShoreStretch& stretch, std::size_t first, std::size_t last,
                     bool synthetic, double raster_most) const {
    const ShoreState begin = state_of(stretch, true), end = state_of(stretch, false);
    double most = 0.0;
    if (synthetic) {
      const double inland =
          std::max(0.0, std::min(inland_at(stretch, ray_.middle_of(last)).from_begin,
                                 inland_at(stretch, ray_.middle_of(first)).from_end) +
                            model_.cell_m);
      most = std::max(greatest_height(begin, inland), greatest_height(end, inland));
    }
    if (relief_) {
      most = std::max(most, std::max({0.5, raster_most, bank_height(begin), bank_height(end)}) +
                                0.25 * raster_most + 1.0);
    }
    return most;
  }

  static bool is_sandy(const ShoreStretch& s) {
    return state_of(s, true).shore.type == CoastType::sandy ||
           state_of(s, false).shore.type == CoastType::sandy;
  }

  // 1 at the water's edge of sand, 0 from where waves reach no more, and off sand.
  double wetness(const ShoreStretch& stretch, double range) const {
    const Inland inland = inland_at(stretch, range);
    if (state_of(stretch, inland.begin_is_nearer()).shore.type != CoastType::sandy) return 0.0;
    const double reach = kWetEdge + 2.0 * swash_m(water_.wave_height_m);
    return std::max(0.0, 1.0 - inland.nearest() / reach);
  }

  const LandModel& model_;
  const ShoreWater& water_;
  const LatticePath& path_;
  const ChartedRelief* relief_;
  GroundProfile* profile_;
  std::span<float> power_;
  LandRay ray_;
  double step_m_ = 0.0;
  std::span<const NoiseOctave> below_step_;
  std::optional<NaturalLand> natural_;
  std::optional<CoverRow> cover_;
};

}  // namespace

void GroundProfile::clear(std::size_t cells) {
  shadow.assign(cells, kHidesNothing);
  height_m.assign(cells, 0.0f);
  filled_ = 0;
}

Ground ground_at(const ShoreStretch& s, double range_m, double broad_noise, double fine_noise,
                 bool roofs) {
  const Inland inland = inland_at(s, range_m);
  const ShoreState begin = state_of(s, true), end = state_of(s, false);
  const Ground by_begin = ground_behind(begin, inland.nearest(), broad_noise, fine_noise, roofs);
  if (begin == end) return by_begin;
  const Ground by_end = ground_behind(end, inland.nearest(), broad_noise, fine_noise, roofs);
  const double near = std::max(0.0, inland.from_begin), far = std::max(0.0, inland.from_end);
  const double to_end = near + far > 0.0 ? near / (near + far) : 0.0;
  return {by_begin.height_m + to_end * (by_end.height_m - by_begin.height_m),
          by_begin.gamma + to_end * (by_end.gamma - by_begin.gamma)};
}

double charted_height(const ShoreStretch& s, double range_m, double raster_m, double step_m,
                      double below_step_noise) {
  const Inland inland = inland_at(s, range_m);
  const ShoreState shore = state_of(s, inland.begin_is_nearer());
  const double bank = bank_height(shore) * std::max(0.0, 1.0 - inland.nearest() / step_m);
  const double ground = std::max(raster_m, bank);
  const double rough =
      std::min(roughness(shore, inland.nearest()), 0.25 * std::max(0.0, raster_m) + 1.0);
  return std::max(0.5, ground + rough * below_step_noise);
}

void add_shores(std::span<const ShoreStretch> land, const LandModel& model, const ShoreWater& water,
                const LatticePath& path, const ChartedRelief* relief, GroundProfile* profile,
                std::span<float> power, const ChartedCover* cover) {
  ShoreRay ray(model, water, path, relief, profile, power, cover);
  for (const ShoreStretch& stretch : land) ray.add(stretch);
  ray.finish();
}

}  // namespace skerry::echo
