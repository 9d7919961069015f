#include "echo/sweeps/sweep_receiver.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/receiver/log_video.hpp"
#include "echo/sweeps/code_groups.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint64_t kSweepNoise = 0x5EEB;  // tells it from that of spokes

double metres_per_tick(const SweepChannel& channel) {
  return 0.5 * kLightSpeed / channel.sample_clock_hz;
}

// Ticks of the sweep whose middle lies nearer than `range_m`.
std::uint64_t ticks_before(const SweepChannel& channel, double range_m, std::uint64_t ticks) {
  const double nearer = std::ceil(range_m / metres_per_tick(channel) - 0.5 - channel.delay_ticks);
  return static_cast<std::uint64_t>(std::clamp(nearer, 0.0, static_cast<double>(ticks)));
}

double amplitude_from_decibels(double db) { return exact_exp2(db / (2.0 * kDecibelsPerOctave)); }

}  // namespace

SweepReceiver::SweepReceiver(const SweepChannel& channel, const SweepEchoes::Grid& grid)
    : channel_(channel),
      grid_(grid),
      noise_(receiver_noise_for(std::min(1.0, grid.pulse.bandwidth_hz / channel.sample_clock_hz),
                                Decimation::peak)),
      cells_per_tick_(metres_per_tick(channel) / grid.cell_m),
      full_scale_(exact_exp2(channel.bits)),
      silence_(std::max(grid.cells, kPiece)),
      power_(kPiece),
      total_(kPiece),
      piece_(kPiece) {
  const std::uint64_t ticks = std::uint64_t{channel.samples} * channel.decimation;
  blind_ticks_ = ticks_before(channel, grid.blind_m, ticks);
  lit_ticks_ = ticks_before(channel, grid.cells * grid.cell_m, ticks);
  const double most = std::min(kPiece * cells_per_tick_, static_cast<double>(grid.cells));
  cells_.resize(static_cast<std::size_t>(most) + 8);
  const auto top = static_cast<std::uint32_t>(full_scale_) - 1;
  converter_ = {static_cast<float>(top), channel.inverted ? top : 0};
  const auto blind =
      static_cast<std::uint32_t>(std::clamp(channel.offset, 0.0, static_cast<double>(top)));
  blind_code_ = static_cast<std::uint16_t>(blind ^ converter_.flip);
  lay_gain(channel.stc);
}

// Metres to the middle of a tick of the sweep.
double SweepReceiver::range_of(std::uint64_t tick) const {
  return (static_cast<double>(channel_.delay_ticks + tick) + 0.5) * metres_per_tick(channel_);
}

void SweepReceiver::lay_gain(double stc) {
  const double range_db = grid_.video_range_db;
  const auto gain_at = [&](double stc_loss_db) {
    const double db = channel_.gain_db - stc_loss_db + kDecibelsBelowNoise * range_db;
    return static_cast<float>(channel_.detector == VideoDetector::log
                                  ? full_scale_ / range_db * db + channel_.offset
                                  : full_scale_ * amplitude_from_decibels(db - range_db));
  };
  flat_gain_.assign(kPiece, gain_at(0.0));
  const std::uint64_t ticks = std::uint64_t{channel_.samples} * channel_.decimation;
  std::uint64_t shaped = 0;
  while (shaped < ticks && stc_db(stc, range_of(shaped)) > 0.0) shaped += kPiece;
  gain_.resize(static_cast<std::size_t>(shaped));
  for (std::size_t i = 0; i < gain_.size(); ++i) gain_[i] = gain_at(stc_db(stc, range_of(i)));
}

double SweepReceiver::level_of(double power, std::uint32_t tick) const {
  const auto gain = static_cast<double>(tick < gain_.size() ? gain_[tick] : flat_gain_.front());
  if (channel_.detector == VideoDetector::linear) return gain * std::sqrt(power) + channel_.offset;
  return full_scale_ / grid_.video_range_db * kDecibelsPerOctave * exact_log2(power) + gain;
}

// The echo of `count` ticks from `tick` on into power_; false where there is none.
bool SweepReceiver::lay_echo(std::span<const float> before, std::span<const float> after,
                             float share, std::uint64_t tick, std::uint32_t count) {
  if (tick >= lit_ticks_) return false;
  const auto lit = static_cast<std::uint32_t>(std::min<std::uint64_t>(count, lit_ticks_ - tick));
  // In cells from the middle of one before the first, of which there is another on each side.
  const double place = range_of(tick) / grid_.cell_m + 0.5;
  const double base = std::floor(place);
  const auto begin = static_cast<std::size_t>(base);
  const std::size_t wanted =
      std::min(cells_.size(), static_cast<std::size_t>(place - base + lit * cells_per_tick_) + 3);
  const std::size_t lead = begin == 0 ? 1 : 0;
  const std::size_t from = begin + lead - 1;
  const std::size_t held = std::min(wanted - lead, grid_.cells - from);
  blend_rows(before.subspan(from, held), after.subspan(from, held), share,
             std::span(cells_).subspan(lead, held));
  if (lead > 0) cells_[0] = cells_[1];
  for (std::size_t i = lead + held; i < wanted; ++i) cells_[i] = cells_[lead + held - 1];
  sample_row(std::span(cells_).first(wanted), static_cast<float>(place - base),
             static_cast<float>(cells_per_tick_), std::span(power_).first(lit));
  std::fill(power_.begin() + lit, power_.begin() + count, 0.0f);
  return true;
}

// total_, of ticks from `tick` on, to codes.
void SweepReceiver::convert(std::uint64_t tick, std::span<std::uint16_t> codes) {
  const std::size_t count = codes.size();
  const std::span<const float> gain = tick + count <= gain_.size()
                                          ? std::span<const float>(gain_).subspan(tick, count)
                                          : std::span<const float>(flat_gain_).first(count);
  const std::span<const float> total = std::span(total_).first(count);
  if (channel_.detector == VideoDetector::log) {
    const double per_octave = full_scale_ / grid_.video_range_db * kDecibelsPerOctave;
    convert_log(total, static_cast<float>(per_octave), gain, converter_, codes);
  } else {
    convert_linear(total, gain, static_cast<float>(channel_.offset), converter_, codes);
  }
  if (tick < blind_ticks_) {
    std::fill_n(codes.begin(), std::min<std::uint64_t>(count, blind_ticks_ - tick), blind_code_);
  }
}

void SweepReceiver::receive(std::span<const float> before, std::span<const float> after,
                            float share, std::uint64_t trigger, std::span<std::uint16_t> codes) {
  const auto seen = [&](std::span<const float> row) {
    return row.size() == grid_.cells ? row : std::span<const float>(silence_).first(grid_.cells);
  };
  const bool echoes = before.size() == grid_.cells || after.size() == grid_.cells;
  const std::uint64_t seed = mixed(grid_.seed, kSweepNoise, trigger >> 32);
  const bool decimates = channel_.decimation > 1;
  CodeGroups groups(channel_.mode, channel_.decimation, codes);
  const std::uint64_t ticks = std::uint64_t{channel_.samples} * channel_.decimation;
  for (std::uint64_t tick = 0; tick < ticks;) {
    const std::uint64_t after_trigger = channel_.delay_ticks + tick;
    const auto in_noise = static_cast<std::uint32_t>(after_trigger % ReceiverNoise::kPeriod);
    const auto count = static_cast<std::uint32_t>(std::min<std::uint64_t>(
        {ticks - tick, kPiece - tick % kPiece, ReceiverNoise::kPeriod - in_noise}));
    const NoiseRow noise =
        noise_->row(noise_key(seed, grid_.radar, static_cast<std::uint32_t>(trigger),
                              static_cast<std::uint32_t>(after_trigger / ReceiverNoise::kPeriod)),
                    in_noise);
    const bool seen_any = echoes && lay_echo(seen(before), seen(after), share, tick, count);
    receive_power(std::span<const float>(seen_any ? power_ : silence_).first(count), 1.0f, noise,
                  std::span(total_).first(count));
    if (decimates) {
      const std::span<std::uint16_t> made = std::span(piece_).first(count);
      convert(tick, made);
      groups.add(made);
    } else {
      convert(tick, codes.subspan(tick, count));
    }
    tick += count;
  }
}

}  // namespace skerry::echo
