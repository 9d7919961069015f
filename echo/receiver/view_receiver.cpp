#include "echo/receiver/view_receiver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/video_stages.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kMaxPiece = 64;  // spokes
constexpr std::size_t kTogether = 4;     // spokes to a piece of work where they are independent
// Cells handed out at a time where spokes have to follow each other: what they remember of each
// other then stays in the nearest cache.
constexpr std::size_t kColumns = 512;
constexpr float kBlind = -1e6f;   // steps
constexpr double kTrimDb = 12.0;  // of automatic STC by the sea control, at 0 and 100

RowResampler resampler_of(const RadarModel& model, const ViewControls& controls) {
  return {model.geometry.cells, model.scale, controls.range_scale, controls.decimation};
}

}  // namespace

ViewReceiver::ViewReceiver(const RadarModel& model, const ViewControls& controls)
    : model_(model),
      controls_(controls),
      resampler_(resampler_of(model, controls)),
      steps_per_db_(256.0 / model.set.video_range_db),
      scale_{static_cast<float>(steps_per_db_ * kDecibelsPerOctave), 255.0f},
      offsets_(model.geometry.cells) {
  set_up();
}

void ViewReceiver::set_controls(const ViewControls& controls) {
  if (controls == controls_) return;
  const bool same_cells =
      controls.range_scale == controls_.range_scale && controls.decimation == controls_.decimation;
  controls_ = controls;
  if (!same_cells) {
    resampler_ = resampler_of(model_, controls);
    memory_.forget();
    auto_sea_.reset();
  }
  set_up();
}

void ViewReceiver::set_up() {
  const ScanGeometry& geometry = model_.geometry;
  cell_m_ = geometry.cell_size(controls_.range_scale).in_metres();
  blind_cells_ = std::min(
      geometry.cells,
      static_cast<std::uint32_t>(std::ceil(model_.blind_cells * model_.cell_m / cell_m_ - 1e-9)));
  noise_ =
      receiver_noise_for(samples_in_cell(cell_m_, model_.pulse.bandwidth_hz), controls_.decimation);
  const double look_back = std::clamp(kDifferentiatorLength / cell_m_, 2.0, geometry.cells / 2.0);
  rain_octaves_ = static_cast<unsigned>(exact_log2(look_back) + 0.5);
  rain_weight_ = static_cast<unsigned>(controls_.rain * 2.56 + 0.5);
  stretch_cells_ = static_cast<unsigned>(std::ceil(controls_.echo_stretch * 0.03));
  memory_.set_up(azimuth_stages(model_.set.beam_width_deg, geometry.spokes_per_turn,
                                controls_.interference_rejection, controls_.integration,
                                controls_.stretch_bearing ? stretch_cells_ : 0),
                 geometry.cells, noise_->mean_power());
  if (!controls_.sea_auto) {
    auto_sea_.reset();
  } else if (!auto_sea_) {
    auto_sea_.emplace(geometry.spokes_per_turn, geometry.cells, cell_m_, blind_cells_,
                      noise_->mean_octaves());
  }
  laid_sector_ = AutoSea::kBearings;
  lay_offsets();
}

// By the law of the sea control, or by what the automatic one has learnt of the sector ahead.
void ViewReceiver::lay_offsets() {
  const std::uint32_t cells = model_.geometry.cells;
  const double constant = -steps_per_db_ * threshold_db(controls_.gain) -
                          static_cast<double>(scale_.per_octave) * noise_->scale_octaves();
  const auto in_turn = static_cast<std::uint32_t>(next_ % model_.geometry.spokes_per_turn);
  if (auto_sea_ && auto_sea_->knows(auto_sea_->sector_of(in_turn))) {
    std::vector<double> bins(auto_sea_->bins());
    auto_sea_->attenuation(auto_sea_->sector_of(in_turn), kTrimDb * (controls_.sea - 50.0) / 50.0,
                           kMaxStcDb, bins);
    lay_learnt(constant, bins);
  } else {
    for (std::uint32_t i = 0; i < cells; ++i) {
      offsets_[i] =
          static_cast<float>(constant - steps_per_db_ * stc_db(controls_.sea, (i + 0.5) * cell_m_));
    }
  }
  std::fill_n(offsets_.begin(), blind_cells_, kBlind);
  std::fill(offsets_.begin() + resampler_.reach(), offsets_.end(), kBlind);
}

// Straight lines between the middles of bins.
void ViewReceiver::lay_learnt(double constant, std::span<const double> bins) {
  const std::size_t half = kLevelCells / 2;
  const auto laid = [&](double db) { return static_cast<float>(constant - steps_per_db_ * db); };
  std::fill(offsets_.begin(), offsets_.begin() + half, laid(bins.front()));
  for (std::size_t b = 0; b + 1 < bins.size(); ++b) {
    const float here = laid(bins[b]);
    const float step = (laid(bins[b + 1]) - here) / static_cast<float>(kLevelCells);
    float* out = offsets_.data() + half + b * kLevelCells;
    for (std::size_t k = 0; k < kLevelCells; ++k)
      out[k] = here + step * (static_cast<float>(k) + 0.5f);
  }
  std::fill(offsets_.begin() + static_cast<std::ptrdiff_t>(bins.size() * kLevelCells - half),
            offsets_.end(), laid(bins.back()));
}

double ViewReceiver::lag_spokes() const {
  return 0.5 * (memory_.stages().integrated - 1) + memory_.stages().stretch;
}

double ViewReceiver::level_of(double power, std::uint32_t cell) const {
  return static_cast<double>(scale_.per_octave) * (exact_log2(power) + noise_->scale_octaves()) +
         static_cast<double>(offsets_[cell]);
}

NoiseRow ViewReceiver::noise_of(std::uint64_t seed, std::uint64_t spoke) const {
  const std::uint32_t turn = model_.geometry.spokes_per_turn;
  return noise_->row(noise_key(seed, model_.radar, static_cast<std::uint32_t>(spoke / turn),
                               static_cast<std::uint32_t>(spoke % turn)));
}

// The radar's row itself, or its view in a row of this thread's own.
std::span<const float> ViewReceiver::row_of(const Piece& piece, std::size_t k) const {
  const std::size_t cells = model_.geometry.cells;
  const std::span<const float> row = piece.rows.subspan(k * piece.pitch, cells);
  if (resampler_.keeps()) return row;
  thread_local std::vector<float> seen;
  seen.resize(cells);
  resampler_.resample(row, seen);
  return seen;
}

std::span<std::uint8_t> ViewReceiver::video_of(const Piece& piece, std::size_t k) const {
  return piece.video.subspan(k * model_.geometry.cells, model_.geometry.cells);
}

void ViewReceiver::finish(std::span<std::uint8_t> video) const {
  thread_local std::vector<std::uint8_t> scratch;
  differentiate_video(video, model_.geometry.cells, rain_octaves_, rain_weight_, scratch);
  stretch_video(video, model_.geometry.cells, stretch_cells_, scratch);
}

void ViewReceiver::receive(std::span<const float> rows, std::size_t pitch, std::uint64_t first,
                           std::uint32_t count, std::uint64_t seed, const ParallelFor& parallel,
                           std::span<std::uint8_t> video) {
  const std::uint32_t turn = model_.geometry.spokes_per_turn;
  if (first != next_) {
    memory_.forget();
    if (auto_sea_) auto_sea_->drop_sector();
    laid_sector_ = AutoSea::kBearings;
  }
  next_ = first;
  for (std::uint32_t done = 0; done < count;) {
    std::uint32_t step = std::min(count - done, kMaxPiece);
    std::uint32_t sector = 0;
    bool ends = false;
    if (auto_sea_) {
      const auto in_turn = static_cast<std::uint32_t>(next_ % turn);
      sector = auto_sea_->sector_of(in_turn);
      const std::uint32_t left = auto_sea_->first_spoke_of(sector + 1) - in_turn;
      step = std::min(step, left);
      ends = step == left;
      if (sector != laid_sector_) lay_offsets();
      laid_sector_ = sector;
    }
    const Piece piece{rows.subspan(std::size_t{done} * pitch),
                      pitch,
                      next_,
                      step,
                      seed,
                      video.subspan(std::size_t{done} * model_.geometry.cells,
                                    std::size_t{step} * model_.geometry.cells)};
    receive_piece(piece, parallel);
    next_ += step;
    if (ends) auto_sea_->finish_sector(sector);
    done += step;
  }
}

void ViewReceiver::receive_piece(const Piece& piece, const ParallelFor& parallel) {
  const std::size_t cells = model_.geometry.cells;
  if (auto_sea_) learn_sea(piece, parallel);
  if (!memory_.detects()) {
    parallel((piece.count + kTogether - 1) / kTogether, [&](std::size_t part) {
      const std::size_t begin = part * kTogether;
      const std::size_t end = std::min<std::size_t>(piece.count, begin + kTogether);
      for (std::size_t k = begin; k < end; ++k) {
        receive_video(row_of(piece, k), noise_->gain(), noise_of(piece.seed, piece.first + k),
                      offsets_, scale_, video_of(piece, k));
      }
      finish(piece.video.subspan(begin * cells, (end - begin) * cells));
    });
  } else {
    std::array<NoiseRow, kMaxPiece> noise;
    for (std::size_t k = 0; k < piece.count; ++k) noise[k] = noise_of(piece.seed, piece.first + k);
    std::span<const float> rows = piece.rows;
    std::size_t pitch = piece.pitch;
    if (!resampler_.keeps()) {
      pitch = cells + 16;
      seen_.resize(piece.count * pitch);
      const std::span<float> all = seen_;
      parallel(piece.count, [&](std::size_t k) {
        resampler_.resample(piece.rows.subspan(k * piece.pitch, cells),
                            all.subspan(k * pitch, cells));
      });
      rows = all;
    }
    parallel((cells + kColumns - 1) / kColumns, [&](std::size_t part) {
      const std::size_t begin = part * kColumns, size = std::min(kColumns, cells - begin);
      for (std::uint32_t k = 0; k < piece.count; ++k) {
        memory_.receive(piece.first + k, k, begin, rows.subspan(k * pitch + begin, size),
                        noise_->gain(), from_cell(noise[k], begin),
                        std::span(offsets_).subspan(begin, size), scale_,
                        video_of(piece, k).subspan(begin, size));
      }
    });
    memory_.end_spokes(piece.count);
    if (rain_weight_ > 0 || stretch_cells_ > 0) {
      parallel((piece.count + kTogether - 1) / kTogether, [&](std::size_t part) {
        const std::size_t begin = part * kTogether * cells;
        finish(piece.video.subspan(begin, std::min(kTogether * cells, piece.video.size() - begin)));
      });
    }
  }
  if (memory_.stretches()) {
    parallel((cells + kColumns - 1) / kColumns, [&](std::size_t part) {
      const std::size_t begin = part * kColumns;
      memory_.stretch(piece.video, piece.count, begin, std::min(kColumns, cells - begin));
    });
  }
  if (model_.geometry.bits == 4) halve_bits(piece.video);
}

// The noise it sees is the video's own.
void ViewReceiver::learn_sea(const Piece& piece, const ParallelFor& parallel) {
  std::array<std::uint32_t, kMaxPiece> sampled{};
  std::size_t count = 0;
  for (std::uint32_t k = 0; k < piece.count; ++k) {
    const auto in_turn =
        static_cast<std::uint32_t>((piece.first + k) % model_.geometry.spokes_per_turn);
    if (auto_sea_->samples(in_turn)) sampled[count++] = k;
  }
  const std::size_t bins = auto_sea_->bins();
  std::vector<std::int32_t> sums(count * bins);
  parallel(count, [&](std::size_t s) {
    sum_levels(row_of(piece, sampled[s]), noise_->gain(),
               noise_of(piece.seed, piece.first + sampled[s]),
               std::span(sums).subspan(s * bins, bins));
  });
  for (std::size_t s = 0; s < count; ++s) auto_sea_->add(std::span(sums).subspan(s * bins, bins));
}

}  // namespace skerry::echo
