// A turn of rows of land and structures, all seen from one place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/radar/range_response.hpp"
#include "echo/returns/hidden_ground.hpp"
#include "echo/returns/packed_rows.hpp"
#include "echo/returns/static_ray.hpp"
#include "echo/returns/turn_crossings.hpp"

namespace skerry::echo {

// How finely a frame is made: powers of two.  Errors by number of rays and rows are printed by
// tests/bench/error/beam_taps_error.
struct FrameDetail {
  std::uint32_t rays = 2048;
  std::uint32_t rows = 4096;
  std::uint32_t cells = 1024;  // of a row: those of the radar and kFrameMargin more
};
// More cells than the radar has, for what comes into range as the own ship sails on.
inline constexpr std::uint32_t kFrameMargin = 32;
// At least kRaysPerBeam rays and kRowsPerBeam rows to a one-way beam width.
inline constexpr double kRaysPerBeam = 5.0, kRowsPerBeam = 10.0;
FrameDetail frame_detail(const RadarModel& model);

// The newest rays, cell by cell: those that rows still to be made are summed from.
class RayRing {
 public:
  struct Extent {
    std::uint32_t first = 0, last = 0;  // cells first .. last - 1 may echo, no others
  };
  // `rays`: how many are kept, a power of two.
  RayRing(std::uint32_t rays, std::uint32_t cells);

  // Forgets all rays.  Memory is taken by the first call.
  void reset();
  bool holds(std::uint32_t ray) const { return slot(ray).ray == ray; }
  // Takes the place of the ray that lies `rays` before; all cells are 0, and none may echo.
  std::span<float> begin(std::uint32_t ray);
  void set_extent(std::uint32_t ray, Extent extent) { slots_[ray & mask_].extent = extent; }
  Extent extent(std::uint32_t ray) const { return slot(ray).extent; }
  const float* power(std::uint32_t ray) const { return power_.data() + (ray & mask_) * pitch_; }
  std::size_t bytes() const { return power_.capacity() * sizeof(float); }

 private:
  struct Slot {
    std::uint32_t ray = ~0u;
    Extent extent;
  };
  const Slot& slot(std::uint32_t ray) const { return slots_[ray & mask_]; }

  std::uint32_t mask_, cells_;
  std::size_t pitch_;
  std::vector<Slot> slots_;
  std::vector<float> power_;
};

// A frame is made bit by bit: first the crossings of all rays, then rows in any order, each the sum
// of the rays that its beam covers.  Rows lie on the bearings of the plane the frame was begun in.
// Memory: of its rows, its rays' hidden ground, the crossings and the ring of rays.
// Thread: one at a time; reading any, between makings.
class StaticFrame {
 public:
  StaticFrame(const RadarModel& model, const FrameDetail& detail);

  // From the scene's coast, `at` in its plane, now.  What was made before is forgotten.
  void begin(const Scene& scene, PlanePoint at, double seconds);
  bool begun() const { return picture_ != nullptr; }

  // The crossings, up to that share of them.
  void work_crossings(double share);
  bool crossings_done() const { return crossings_.done(); }
  // Nearest land or structure, metres; infinite where there is none.
  double nearest_m() const { return nearest_m_; }
  // How far before an echo's own range the receiver's filter shows it, metres.
  double lead_m() const { return response_->lead() * ray_model_.cell_m; }

  // Whether a shore of sand is in range.  Requires crossings_done().
  bool sandy() const;

  // Makes those of rows first .. first + count - 1 (count <= kMostRows) that are not made.
  // Requires crossings_done().
  static constexpr std::uint32_t kMostRows = 64;
  void make_rows(std::uint32_t first, std::uint32_t count, const ParallelFor& parallel);
  // Rays to make before the first of a sequence of rows, so that this row costs no more than later
  // ones.
  std::uint32_t lead_in() const { return 2 * reach_; }
  void make_lead_in(std::uint32_t row, std::uint32_t rays);
  bool made(std::uint32_t row) const { return rows_.made(row); }
  bool complete() const { return rows_.made_count() == detail_.rows; }

  // Finds as PackedRows::find() does.
  void find(const RowPart& part, std::vector<MovedRun>& runs) const { rows_.find(part, runs); }
  // Fetches what find() and dry() first look at of a row.
  void fetch(std::uint32_t row) const {
    rows_.fetch(row);
    ground_.fetch(ray_of(row));
  }

  // Both of the ray nearest to that row, as HiddenGround has them.
  std::span<const CellRun> dry(std::uint32_t row) const { return ground_.dry(ray_of(row)); }
  double shadow_slope(std::uint32_t row, std::uint32_t cell) const {
    return ground_.shadow_slope(ray_of(row), cell);
  }

  const FrameDetail& detail() const { return detail_; }
  const CoastPicturePtr& picture() const { return picture_; }
  const Structures* structures() const { return built_.get(); }
  const StaticView& view() const { return view_; }
  bool empty() const { return empty_; }
  std::size_t bytes() const;

 private:
  std::uint32_t ray_of(std::uint32_t row) const;
  void make_ray(std::uint32_t ray);
  void make_rays(std::uint32_t first, std::uint32_t last, const ParallelFor& parallel);
  void make_row(std::uint32_t row, std::vector<PackedPower>& cells);

  FrameDetail detail_;
  StaticRayModel ray_model_;
  std::shared_ptr<const RangeResponse> response_;
  std::uint32_t per_ray_shift_;              // log2 of rows to a ray
  std::uint32_t reach_;                      // rays to either side of a row's own
  std::vector<std::vector<float>> weights_;  // by row % (rows / rays), of rays -reach .. +reach

  CoastPicturePtr picture_;
  std::shared_ptr<const Structures> built_;
  std::unique_ptr<const StructureIndex> structures_;  // of built_, from this place
  StaticView view_;
  bool empty_ = true;
  double nearest_m_ = 0.0;
  TurnCrossings crossings_;
  RayRing ring_;
  HiddenGround ground_;
  PackedRows rows_;
  std::vector<std::vector<PackedPower>> fresh_;  // of rows just packed, each by its own thread
};

}  // namespace skerry::echo
