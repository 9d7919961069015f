// An own ship under way over a chart, as a sequence of scenes, one a sector.
#pragma once

#include <memory>
#include <optional>

#include "echo/kernel/exact_math.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/scene/coast_picture.hpp"
#include "echo/scene/scene.hpp"
#include "tests/scenes/charts.hpp"

namespace skerry::echo {

// Sails on from `start` at `speed_mps` on a course that turns; the coast's picture follows her as
// the server has it, laid anew each time half its slack is sailed.
class Voyage {
 public:
  Voyage(CoastChart chart, GeoPoint start, const RadarModel& model, double speed_mps,
         double course_deg, double turn_rate_deg_s = 0.0)
      : model_(model),
        preparer_(std::move(chart), start, CoastRules{.seed = 1}),
        geo_(start),
        speed_(speed_mps),
        course_(course_deg),
        turn_rate_(turn_rate_deg_s) {
    picture(start);
    at_ = picture_->plane.to_plane(start);
    scene_.seed = 20261121;
  }

  // The scene of the sector that begins with that spoke; call in order.
  const Scene& at(std::uint64_t spoke) {
    const double dt = in_seconds(model_.clock.time_of(spoke) - scene_.time);
    course_ += turn_rate_ * dt;
    const SinCos u = sin_cos_degrees(course_);
    scene_.own_velocity = {speed_ * u.sin, speed_ * u.cos};
    at_ = at_ + scene_.own_velocity * dt;
    const PlanePoint off = at_ - picture_->centre;
    if (off.east_m * off.east_m + off.north_m * off.north_m >
        0.25 * picture_->slack_m * picture_->slack_m)
      picture(picture_->plane.to_geo(at_));
    if (!index_ || !index_->serves(at_))
      index_ = std::make_shared<const PolarIndex>(*picture_, at_, 30.0);
    scene_.time = model_.clock.time_of(spoke);
    scene_.coast = picture_;
    scene_.index = index_;
    if (picture_->structures && (!structures_ || !structures_->serves(at_)))
      structures_ = std::make_shared<const StructureIndex>(picture_->structures, at_, 30.0);
    scene_.structure_index = structures_;
    scene_.own_ship = at_;
    scene_.own_ship_geo = picture_->plane.to_geo(at_);
    scene_.true_north_deg = picture_->plane.true_north_degrees(scene_.own_ship_geo);
    scene_.heading_deg = course_ - scene_.true_north_deg;
    scene_.turn_rate_deg_s = turn_rate_;
    return scene_;
  }

  // Waves, water level and the rest, for the scenes to come.
  Scene& scene() { return scene_; }
  int pictures() const { return pictures_; }

 private:
  void picture(GeoPoint where) {
    picture_ = preparer_.prepare(where, {model_.scale.length().in_metres(), model_.cell_m,
                                         360.0 / model_.geometry.spokes_per_turn});
    index_ = nullptr;
    structures_ = nullptr;
    ++pictures_;
  }

  RadarModel model_;
  CoastPreparer preparer_;
  GeoPoint geo_;
  double speed_, course_, turn_rate_;
  CoastPicturePtr picture_;
  std::shared_ptr<const PolarIndex> index_;
  std::shared_ptr<const StructureIndex> structures_;
  PlanePoint at_;
  Scene scene_;
  int pictures_ = 0;
};

}  // namespace skerry::echo
