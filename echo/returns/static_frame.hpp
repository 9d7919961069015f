// A turn of rows of land and structures, all seen from one place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/moved_row.hpp"
#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/returns/hidden_water.hpp"
#include "echo/returns/moved_rows.hpp"
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

// Room for rows of packed cells, given out piece by piece and taken back all at once.
class PackedStore {
 public:
  void clear() { block_ = used_ = 0; }
  // Room for `count` (<= kBlock) cells; good until clear().
  PackedPower* take(std::size_t count);
  std::size_t bytes() const { return blocks_.size() * kBlock * sizeof(PackedPower); }

  static constexpr std::size_t kBlock = 1u << 17;

 private:
  std::vector<std::unique_ptr<PackedPower[]>> blocks_;
  std::size_t block_ = 0, used_ = 0;
};

// Made bit by bit: first the crossings of all rays, then rows in any order, each from the rays its
// beam covers.  Rows lie on the bearings of the plane the frame was begun in.
// Memory: two bytes for each cell between a row's echoes' ends, gaps of kGap cells and more apart;
// two bytes for kShadowStep cells of each ray; the crossings; the ring of rays.
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

  // Whether a shore of sand is in range.  Requires crossings_done().
  bool sandy() const;

  // Makes those of rows first .. first + count - 1 (count <= kMostRows) that are not made.
  // Requires crossings_done().
  static constexpr std::uint32_t kMostRows = 64;
  void make_rows(std::uint32_t first, std::uint32_t count, const ParallelFor& parallel);
  // Rays the first of a sequence of rows needs before it; made beforehand, so many of them, they
  // take nothing then.
  std::uint32_t lead_in() const { return 2 * reach_; }
  void make_lead_in(std::uint32_t row, std::uint32_t rays);
  bool made(std::uint32_t row) const { return rows_[row].made; }
  bool complete() const { return made_ == detail_.rows; }

  // Appends what echoes of cells part.first .. part.last - 1 of a spoke, from where they lie in the
  // part's row, whose range was another.
  void find(const RowPart& part, std::vector<MovedRun>& runs) const;

  // Runs of cells of the ray nearest to that row that are land, or water hidden behind land.
  std::span<const CellRun> dry(std::uint32_t row) const {
    const DryRuns& dry = dry_[ray_of(row)];
    return {dry.runs.data(), dry.count};
  }
  // Slope, from the antenna and less the Earth's drop, below which land hides what lies at that
  // cell; kNothingHidden where there is none.
  double shadow_slope(std::uint32_t row, std::uint32_t cell) const;
  static constexpr double kNothingHidden = -1.0;

  const FrameDetail& detail() const { return detail_; }
  const CoastPicturePtr& picture() const { return picture_; }
  const Structures* structures() const { return built_.get(); }
  const StaticView& view() const { return view_; }
  bool empty() const { return empty_; }
  std::size_t bytes() const;

 private:
  struct EchoRun {
    std::uint16_t first = 0, last = 0;
    std::uint32_t at = 0;  // of the zero before cell `first` in the row's cells
  };
  struct Row {
    static constexpr std::size_t kMostRuns = 8;  // more are joined to the last
    bool made = false;
    std::uint8_t count = 0;
    const PackedPower* cells = nullptr;
    std::array<EchoRun, kMostRuns> runs;
  };
  struct DryRuns {
    static constexpr std::size_t kMost = 15;  // more are left out
    std::uint16_t count = 0;
    std::array<CellRun, kMost> runs;
  };
  struct RingRay {
    std::uint32_t ray = ~0u;
    std::uint32_t first = 0, last = 0;  // cells that may echo
  };
  static constexpr std::uint32_t kShadowStep = 8;
  static constexpr std::uint32_t kGap = 48;
  // Power over noise below which nothing is kept, 0.001 dB of what it stands in.
  static constexpr float kLeast = 2e-4f;

  std::uint32_t ray_of(std::uint32_t row) const;
  float* ring_power(std::uint32_t ray) { return ring_.data() + (ray & (ring_size_ - 1)) * pitch_; }
  void make_ray(std::uint32_t ray);
  void make_rays(std::uint32_t first, std::uint32_t last, const ParallelFor& parallel);
  void record_ray(std::uint32_t ray, const StaticScratch& scratch, std::span<const float> power);
  void make_row(std::uint32_t row, std::vector<PackedPower>& cells);
  static void keep(Row& row, std::uint32_t first, std::span<const float> power,
                   std::vector<PackedPower>& cells);

  FrameDetail detail_;
  StaticRayModel ray_model_;
  double pulse_cells_;
  std::uint32_t reach_;                      // rays to either side of a row's own
  std::vector<std::vector<float>> weights_;  // by row % (rows / rays), of rays -reach .. +reach
  std::uint32_t ring_size_;                  // rays kept, a power of two
  std::size_t pitch_;

  CoastPicturePtr picture_;
  std::shared_ptr<const Structures> built_;
  std::unique_ptr<const StructureIndex> structures_;  // of built_, from this place
  StaticView view_;
  bool empty_ = true;
  double nearest_m_ = 0.0;
  TurnCrossings crossings_;
  std::uint32_t made_ = 0;

  std::vector<RingRay> ring_rays_;
  std::vector<float> ring_;
  std::vector<Row> rows_;
  std::vector<std::int16_t> shadows_;  // by ray, kShadowStep cells each
  std::vector<DryRuns> dry_;
  PackedStore store_;
  std::vector<std::vector<PackedPower>> fresh_;  // of rows just made
};

}  // namespace skerry::echo
