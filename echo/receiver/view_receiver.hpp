// ViewReceiver: from the power on the air to the video of one view of a radar.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/coherent_receiver.hpp"
#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/receiver/automatic_controls.hpp"
#include "echo/receiver/azimuth_memory.hpp"
#include "echo/receiver/controls.hpp"
#include "echo/receiver/doppler_colours.hpp"
#include "echo/receiver/log_video.hpp"
#include "echo/receiver/power_memory.hpp"
#include "echo/receiver/receiver_noise.hpp"
#include "echo/receiver/row_resampler.hpp"
#include "echo/receiver/set_video.hpp"

namespace skerry::echo {

// The stages, in order: cells of the view's range - target separation - side lobe suppression -
// target boost - noise, coherent - square-law detector - interference rejection - integration -
// log - gain and STC - 8 bits - noise rejection - rain control - stretch - the set's smoothing and
// levels - 4 bits if so.  A stage that is off costs nothing.  The first three weigh echo against
// echo, so noise does not mislead them; noise rejection blanks what does not stand kMostNoiseDb
// over mean noise, or less.
//
// Views of one radar share its rows and its noise: the same noise, cell by cell, on the same range
// scale and decimation.  The receiver is blind, and its video 0, before model.blind_cells and
// beyond the radar's rows.
// Integration, target separation and the set's smoothing look to either side, for which they want
// rows_ahead() rows of what comes; without those, integration and smoothing look back only, and
// what they show lies late by half of the spokes that they take, as what the stretch across spokes
// shows always does.
//
// Deterministic: the video is a function of the sequence of rows and controls, of no matter how
// many spokes to a call, threads or instruction set.  Calls go on where the last one ended; after a
// jump what was learnt of earlier spokes is forgotten (automatic STC keeps its turn).
// Thread: one at a time; `parallel` hands out the work of a call.
class ViewReceiver {
 public:
  // `model`: of a view on the radar's own range scale.  Requires controls without fault_of.
  ViewReceiver(const RadarModel& model, const ViewControls& controls);

  const ViewControls& controls() const { return controls_; }
  // Stages that stay as they are keep what they have learnt.
  void set_controls(const ViewControls& controls);

  // How many cells the radar's rows have from now on, all of model.cell_m; at first the model's.
  // Keeps what was learnt.
  void set_row_cells(std::uint32_t cells);
  // Decibels by which the receiver is noisier than its set, 0 at first: rows are over the noise
  // that there is, and the picture shows so much more of it, unless gain is automatic.
  void set_noise(double db) {
    if (db == noise_db_) return;
    noise_db_ = db;
    lay_offsets();
  }
  // Whether the radar's rows cover the view's range; what they do not is 0.
  bool reaches() const { return resampler_.reach() == model_.geometry.cells; }
  // How many rows beyond those of a call it can use.
  std::uint32_t rows_ahead() const { return powers_.stages().reach + memory_.lag(); }
  static constexpr double kMostNoiseDb = 12.0;  // at noise rejection 100

  // rows: echo power over mean noise, >= 0, < 1e30, `pitch` floats from spoke to spoke, the row's
  // cells of each; spokes first .. first + count - 1 from the antenna's start; video: one byte per
  // cell, spoke after spoke.  `ahead`: how many rows of the spokes that follow come behind them,
  // rows_ahead() for the picture as it should be.
  void receive(std::span<const float> rows, std::size_t pitch, std::uint64_t first,
               std::uint32_t count, std::uint64_t seed, const ParallelFor& parallel,
               std::span<std::uint8_t> video, std::uint32_t ahead = 0);

  // Brings what it remembers near, for a call some microseconds later; a radar that takes turns
  // with many others finds it far away.
  void fetch() const { memory_.fetch(); }

  // Doppler colours of a call's video: `closing`: speeds beside the rows of that call.
  void colour(std::span<const float> rows, std::span<const float> closing, std::size_t pitch,
              std::uint32_t count, std::span<const std::uint8_t> video,
              std::span<DopplerClass> colours) const;

  // The video, in steps, of a power (echo and noise together, over mean noise) at a cell, with the
  // present STC, before it is rounded and clamped.
  double level_of(double power, std::uint32_t cell) const;

 private:
  struct Piece {
    std::span<const float> rows;
    std::size_t pitch;
    std::uint64_t first;
    std::uint32_t count;
    std::uint64_t seed;
    std::span<std::uint8_t> video;
    std::uint32_t ahead;         // rows behind those of the piece
    bool in_view_cells = false;  // what `rows` are in; else the radar's
  };

  void set_up();
  void lay_offsets();
  void lay_learnt(double constant, std::span<const double> bins);
  void lay_gates();
  // Takes the rows that integration and smoothing look ahead to, at most `ahead`, once before the
  // first spoke of a sequence.
  void look_ahead(const Piece& piece, std::uint32_t ahead, const ParallelFor& parallel);
  void receive_piece(Piece piece, const ParallelFor& parallel);
  // The rows of a piece in the view's cells; of those ahead too.
  void see_rows(Piece& piece, std::uint32_t count, const ParallelFor& parallel);
  void condition_rows(Piece& piece, const ParallelFor& parallel);
  void learn_levels(const Piece& piece, const ParallelFor& parallel);
  NoiseRow noise_of(std::uint64_t seed, std::uint64_t spoke) const;
  std::span<const float> row_of(const Piece& piece, std::size_t k) const;
  std::span<std::uint8_t> video_of(const Piece& piece, std::size_t k) const;
  void finish(std::span<std::uint8_t> video) const;

  RowResampler resampler() const;

  RadarModel model_;
  std::uint32_t row_cells_;
  double noise_db_ = 0.0;  // more than the set's
  ViewControls controls_;  // as asked for
  ViewControls in_force_;  // effective_controls() of them
  RowResampler resampler_;
  double cell_m_;  // of the view
  std::uint32_t blind_cells_;
  std::shared_ptr<const ReceiverNoise> noise_;
  double steps_per_db_;    // of 8 bits
  QuantiserScale scale_;   // the same
  AlignedFloats offsets_;  // gain and STC by cell, in steps
  SetVideo set_video_;
  unsigned rain_octaves_ = 0, rain_weight_ = 0;
  unsigned stretch_cells_ = 0;
  std::vector<std::uint8_t> gates_;  // of noise rejection, by cell; empty: off
  PowerMemory powers_;
  AzimuthMemory memory_;
  AlignedFloats seen_;         // rows of a call in the view's cells, where they must be in order
  AlignedFloats conditioned_;  // and those behind the stages that weigh echoes
  std::optional<AutoSea> auto_sea_;  // which automatic gain needs too, to look around
  std::optional<AutoGain> auto_gain_;
  std::uint32_t laid_sector_ = AutoSea::kBearings;  // whose STC the offsets have
  std::uint64_t next_ = 0;
  std::uint32_t lead_ = 0;  // rows that are taken before the spoke that is shown
};

}  // namespace skerry::echo
