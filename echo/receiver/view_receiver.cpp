#include "echo/receiver/view_receiver.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/power_stages.hpp"
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

// The next row of noise lies far from this one, and the torus is larger than the nearest cache.
void fetch_noise(const NoiseRow& noise, std::size_t cells) {
  constexpr std::size_t kLineFloats = 16;
  for (const float* row :
       {noise.re_a, noise.im_a, noise.re_b, noise.im_b, noise.re_c, noise.im_c, noise.beside}) {
    if (row == nullptr) continue;
    for (std::size_t i = 0; i < cells; i += kLineFloats) __builtin_prefetch(row + i, 0, 2);
  }
}

// Exact where neither has an instrumented range.
double cell_ratio(const RadarModel& model, const ViewControls& controls) {
  if (controls.instrumented_range_m > 0.0)
    return reach_of(controls).in_metres() / model.scale.length().in_metres();
  return controls.range_scale.in_nautical_miles() / model.scale.in_nautical_miles();
}

}  // namespace

ViewReceiver::ViewReceiver(const RadarModel& model, const ViewControls& controls)
    : model_(model),
      row_cells_(model.geometry.cells),
      controls_(controls),
      in_force_(effective_controls(controls)),
      resampler_(resampler()),
      steps_per_db_(256.0 / model.set.video_range_db),
      scale_{static_cast<float>(steps_per_db_ * kDecibelsPerOctave), 255.0f},
      offsets_(model.geometry.cells),
      set_video_(model.set) {
  set_up();
}

RowResampler ViewReceiver::resampler() const {
  return {row_cells_, model_.geometry.cells, cell_ratio(model_, controls_), controls_.decimation};
}

void ViewReceiver::set_row_cells(std::uint32_t cells) {
  if (cells == row_cells_) return;
  row_cells_ = cells;
  resampler_ = resampler();
  lay_offsets();
}

void ViewReceiver::set_controls(const ViewControls& controls) {
  if (controls == controls_) return;
  const bool same_cells = cell_ratio(model_, controls) == cell_ratio(model_, controls_) &&
                          controls.decimation == controls_.decimation;
  controls_ = controls;
  in_force_ = effective_controls(controls);
  if (!same_cells) {
    resampler_ = resampler();
    powers_.forget();
    memory_.forget();
    auto_sea_.reset();
    auto_gain_.reset();
  }
  set_up();
}

void ViewReceiver::set_up() {
  const ScanGeometry& geometry = model_.geometry;
  cell_m_ = reach_of(controls_).in_metres() / geometry.cells;
  blind_cells_ = std::min(
      geometry.cells,
      static_cast<std::uint32_t>(std::ceil(model_.blind_cells * model_.cell_m / cell_m_ - 1e-9)));
  noise_ =
      receiver_noise_for(samples_in_cell(cell_m_, model_.pulse.bandwidth_hz), controls_.decimation);
  const double look_back = std::clamp(kDifferentiatorLength / cell_m_, 2.0, geometry.cells / 2.0);
  rain_octaves_ = static_cast<unsigned>(exact_log2(look_back) + 0.5);
  rain_weight_ = static_cast<unsigned>(in_force_.rain * 2.56 + 0.5);
  stretch_cells_ = static_cast<unsigned>(std::ceil(in_force_.echo_stretch * 0.03));
  powers_.set_up(power_stages(model_.set, geometry.spokes_per_turn, in_force_), geometry.cells,
                 geometry.spokes_per_turn);
  AzimuthStages stages = azimuth_stages(model_.set.beam_width_deg, geometry.spokes_per_turn,
                                        in_force_.interference_rejection,
                                        std::max(in_force_.integration, model_.set.integration),
                                        in_force_.stretch_bearing ? stretch_cells_ : 0);
  stages.smoothing = model_.set.video_smoothing;
  memory_.set_up(stages, geometry.cells, noise_->mean_power());
  if (!in_force_.gain_auto) {
    auto_gain_.reset();
  } else if (!auto_gain_) {
    auto_gain_.emplace();
  }
  if (!in_force_.sea_auto && !in_force_.gain_auto) {
    auto_sea_.reset();
  } else if (!auto_sea_) {
    auto_sea_.emplace(geometry.spokes_per_turn, geometry.cells, cell_m_, blind_cells_,
                      noise_->mean_octaves());
  }
  laid_sector_ = AutoSea::kBearings;
  lay_offsets();
}

// From the sea control's law, or from what automatic sea has learnt in the sector ahead.
void ViewReceiver::lay_offsets() {
  const std::uint32_t cells = model_.geometry.cells;
  const double threshold =
      auto_gain_ ? auto_gain_->threshold_db() : threshold_db(in_force_.gain) - noise_db_;
  const double constant =
      -steps_per_db_ * threshold - static_cast<double>(scale_.per_octave) * noise_->scale_octaves();
  const auto in_turn = static_cast<std::uint32_t>(next_ % model_.geometry.spokes_per_turn);
  if (in_force_.sea_auto && auto_sea_->knows(auto_sea_->sector_of(in_turn))) {
    std::vector<double> bins(auto_sea_->bins());
    auto_sea_->attenuation(auto_sea_->sector_of(in_turn), kTrimDb * (in_force_.sea - 50.0) / 50.0,
                           kMaxStcDb, bins);
    lay_learnt(constant, bins);
  } else {
    for (std::uint32_t i = 0; i < cells; ++i) {
      offsets_[i] =
          static_cast<float>(constant - steps_per_db_ * stc_db(in_force_.sea, (i + 0.5) * cell_m_));
    }
  }
  std::fill_n(offsets_.begin(), blind_cells_, kBlind);
  std::fill(offsets_.begin() + resampler_.reach(), offsets_.end(), kBlind);
  lay_gates();
}

// Reading of noise of so many decibels over its mean, with the STC there.
void ViewReceiver::lay_gates() {
  gates_.clear();
  if (in_force_.noise_rejection <= 0.0) return;
  const double least =
      ratio_from_decibels(kMostNoiseDb * in_force_.noise_rejection / 100.0) * noise_->mean_power();
  const auto steps = static_cast<float>(static_cast<double>(scale_.per_octave) * exact_log2(least));
  gates_.resize(offsets_.size());
  for (std::size_t i = 0; i < gates_.size(); ++i)
    gates_[i] = static_cast<std::uint8_t>(std::clamp(steps + offsets_[i], 0.0f, scale_.top));
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
  if (piece.in_view_cells) return piece.rows.subspan(k * piece.pitch, model_.geometry.cells);
  const std::span<const float> row = piece.rows.subspan(k * piece.pitch, row_cells_);
  if (resampler_.keeps()) return row.first(model_.geometry.cells);
  thread_local std::vector<float> seen;
  seen.resize(model_.geometry.cells);
  resampler_.resample(row, seen);
  return seen;
}

std::span<std::uint8_t> ViewReceiver::video_of(const Piece& piece, std::size_t k) const {
  return piece.video.subspan(k * model_.geometry.cells, model_.geometry.cells);
}

void ViewReceiver::finish(std::span<std::uint8_t> video) const {
  thread_local std::vector<std::uint8_t> scratch;
  if (!gates_.empty()) {
    for (std::size_t s = 0; s < video.size(); s += gates_.size())
      gate_video(video.subspan(s, gates_.size()), gates_);
  }
  differentiate_video(video, model_.geometry.cells, rain_octaves_, rain_weight_, scratch);
  stretch_video(video, model_.geometry.cells, stretch_cells_, scratch);
  if (set_video_.smooths())
    set_video_.smooth(video, model_.geometry.cells, blind_cells_, resampler_.reach(), scratch);
}

void ViewReceiver::receive(std::span<const float> rows, std::size_t pitch, std::uint64_t first,
                           std::uint32_t count, std::uint64_t seed, const ParallelFor& parallel,
                           std::span<std::uint8_t> video, std::uint32_t ahead) {
  const std::uint32_t turn = model_.geometry.spokes_per_turn;
  if (first != next_) {
    powers_.forget();
    memory_.forget();
    if (auto_sea_) auto_sea_->drop_sector();
    if (auto_gain_) auto_gain_->drop_turn();
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
    Piece piece{rows.subspan(std::size_t{done} * pitch),
                pitch,
                next_,
                step,
                seed,
                video.subspan(std::size_t{done} * model_.geometry.cells,
                              std::size_t{step} * model_.geometry.cells),
                count - done - step + ahead};
    if (memory_.lag() > 0 && memory_.is_empty()) look_ahead(piece, ahead, parallel);
    const std::uint32_t lead = memory_.lag() > 0 ? std::min(lead_, piece.ahead) : 0;
    piece.rows = piece.rows.subspan(std::size_t{lead} * pitch);
    piece.first += lead;
    piece.ahead -= lead;
    receive_piece(piece, parallel);
    next_ += step;
    if (ends) auto_sea_->finish_sector(sector);
    if (ends && auto_gain_ && sector + 1 == AutoSea::kBearings) auto_gain_->finish_turn();
    done += step;
  }
}

void ViewReceiver::see_rows(Piece& piece, std::uint32_t count, const ParallelFor& parallel) {
  const std::size_t cells = model_.geometry.cells, pitch = cells + 16;
  if (!piece.in_view_cells && !resampler_.keeps()) {
    seen_.resize(count * pitch);
    const std::span<float> all = seen_;
    parallel(count, [&](std::size_t k) {
      resampler_.resample(piece.rows.subspan(k * piece.pitch, row_cells_),
                          all.subspan(k * pitch, cells));
    });
    piece.rows = all;
    piece.pitch = pitch;
  }
  piece.in_view_cells = true;
}

void ViewReceiver::condition_rows(Piece& piece, const ParallelFor& parallel) {
  const std::size_t cells = model_.geometry.cells, pitch = cells + 16;
  const std::uint32_t rows = piece.count + std::min(piece.ahead, rows_ahead());
  see_rows(piece, rows, parallel);
  conditioned_.resize(piece.count * pitch);
  parallel((cells + kColumns - 1) / kColumns, [&](std::size_t part) {
    const std::size_t begin = part * kColumns;
    powers_.condition(piece.first, piece.count, {piece.rows, piece.pitch, rows}, begin,
                      std::min(kColumns, cells - begin), conditioned_, pitch);
  });
  powers_.end_spokes(piece.count);
  piece.rows = conditioned_;
  piece.pitch = pitch;
}

void ViewReceiver::look_ahead(const Piece& piece, std::uint32_t ahead,
                              const ParallelFor& parallel) {
  if (lead_ > 0) powers_.forget();
  lead_ = std::min(memory_.lag(), ahead);
  thread_local std::vector<std::uint8_t> unseen;
  for (std::uint32_t taken = 0; taken < lead_;) {
    Piece part = piece;
    part.count = std::min(lead_ - taken, kMaxPiece);
    unseen.resize(std::size_t{part.count} * model_.geometry.cells);
    part.rows = piece.rows.subspan(std::size_t{taken} * piece.pitch);
    part.first += taken;
    part.video = unseen;
    part.ahead = piece.count + piece.ahead - taken - part.count;
    receive_piece(part, parallel);
    taken += part.count;
  }
}

void ViewReceiver::receive_piece(Piece piece, const ParallelFor& parallel) {
  const std::size_t cells = model_.geometry.cells;
  if (powers_.any()) condition_rows(piece, parallel);
  if (auto_sea_) learn_levels(piece, parallel);
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
    see_rows(piece, piece.count, parallel);
    parallel((cells + kColumns - 1) / kColumns, [&](std::size_t part) {
      const std::size_t begin = part * kColumns, size = std::min(kColumns, cells - begin);
      for (std::uint32_t k = 0; k < piece.count; ++k) {
        if (k + 1 < piece.count) fetch_noise(from_cell(noise[k + 1], begin), size);
        memory_.receive(piece.first + k, k, begin,
                        piece.rows.subspan(k * piece.pitch + begin, size), noise_->gain(),
                        from_cell(noise[k], begin), std::span(offsets_).subspan(begin, size),
                        scale_, video_of(piece, k).subspan(begin, size));
      }
    });
    if (rain_weight_ > 0 || stretch_cells_ > 0 || set_video_.smooths() || !gates_.empty()) {
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
  if (memory_.smooths()) {
    parallel((cells + kColumns - 1) / kColumns, [&](std::size_t part) {
      const std::size_t begin = part * kColumns;
      memory_.smooth(piece.video, piece.count, begin, std::min(kColumns, cells - begin));
    });
  }
  memory_.end_spokes(piece.count);
  set_video_.level(piece.video);
  if (model_.geometry.bits == 4) halve_bits(piece.video);
}

void ViewReceiver::colour(std::span<const float> rows, std::span<const float> closing,
                          std::size_t pitch, std::uint32_t count,
                          std::span<const std::uint8_t> video,
                          std::span<DopplerClass> colours) const {
  const std::size_t cells = model_.geometry.cells;
  const ColourRule rule{in_force_.doppler, in_force_.doppler_threshold_mps, stretch_cells_};
  for (std::uint32_t k = 0; k < count; ++k) {
    lay_colours(resampler_, rule, rows.subspan(k * pitch, row_cells_),
                closing.subspan(k * pitch, row_cells_), video.subspan(k * cells, cells),
                colours.subspan(k * cells, cells));
  }
}

// The noise it sees is the video's own.
void ViewReceiver::learn_levels(const Piece& piece, const ParallelFor& parallel) {
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
  if (!auto_gain_) return;
  const double threshold =
      auto_gain_->threshold_db() + kDecibelsPerOctave * noise_->scale_octaves();
  const std::size_t end = resampler_.reach() / kLevelCells;
  for (std::size_t b = blind_cells_ / kLevelCells + 1; b < end; ++b) {
    const double stc_db =
        -static_cast<double>(offsets_[b * kLevelCells + kLevelCells / 2]) / steps_per_db_ -
        threshold;
    for (std::size_t s = 0; s < count; ++s) {
      const double octaves = sums[s * bins + b] / (256.0 * kLevelCells) - noise_->mean_octaves();
      auto_gain_->add(octaves * kDecibelsPerOctave - stc_db);
    }
  }
}

}  // namespace skerry::echo
