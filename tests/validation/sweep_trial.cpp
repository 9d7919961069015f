#include "tests/validation/sweep_trial.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace skerry::validation {
namespace {

constexpr std::uint32_t kAround = 16;
constexpr std::uint32_t kAcpTicks = 1'000'000;  // so that an azimuth is exact to a millionth

board::SweepMeta meta_at(double azimuth_spokes, std::uint64_t trigger, std::uint32_t samples) {
  board::SweepMeta meta;
  const double acps = std::floor(azimuth_spokes);
  meta.trigger_count = trigger;
  meta.trigger_tick = static_cast<std::uint64_t>(azimuth_spokes * kAcpTicks);
  meta.sample_clock_hz = 20'000'000;
  meta.acp_count = static_cast<std::uint32_t>(static_cast<std::uint64_t>(acps) % kRows);
  meta.ticks_since_acp = static_cast<std::uint32_t>((azimuth_spokes - acps) * kAcpTicks + 0.5);
  meta.acp_period = kAcpTicks;
  meta.acp_per_turn = kRows;
  meta.channels[0].samples = samples;
  return meta;
}

}  // namespace

echo::SweepEchoes::Grid Site::grid() const {
  return {.rows_per_turn = kRows,
          .cells = model.geometry.cells,
          .cell_m = model.cell_m,
          .pulse = model.pulse,
          .blind_m = model.blind_cells * model.cell_m,
          .seed = scene->seed,
          .radar = model.radar};
}

const scenes::NamedScene& scene_named(const std::vector<scenes::NamedScene>& all,
                                      const std::string& name) {
  for (const scenes::NamedScene& one : all)
    if (one.name == name) return one;
  throw std::out_of_range(name);
}

Site site_of(std::string name, const scenes::NamedScene& named, std::uint32_t cells, double cell_m,
             echo::PulseChoice choice) {
  const echo::RadarModel model =
      echo::radar_model(named.set, {kRows, cells, 8}, named.controls.range_scale,
                        echo::SpokeClock(named.rpm, kRows), 0, choice);
  return {std::move(name), named.scene, echo::with_cells_of(model, cell_m)};
}

RowStore::RowStore(const Site& site, std::uint32_t first, std::uint32_t count)
    : cells_(site.model.geometry.cells), first_(first - kAround) {
  echo::SpokeReturns returns(site.model, echo::serial_for);
  for (std::uint32_t done = 0; done < count + 2 * kAround; done += kAround) {
    const echo::PowerRows made = returns.make(*site.scene, first_ + done, kAround);
    for (std::size_t k = 0; k < kAround; ++k) {
      const auto row = made.cells.subspan(k * made.pitch, cells_);
      rows_.insert(rows_.end(), row.begin(), row.end());
    }
  }
}

std::span<const float> RowStore::row(std::uint64_t spoke) const {
  return std::span(rows_).subspan(static_cast<std::size_t>(spoke - first_) * cells_, cells_);
}

echo::SweepChannel channel_on(const Site& site, echo::VideoDetector detector, unsigned bits) {
  echo::SweepChannel channel;
  channel.sample_clock_hz = 0.5 * echo::kLightSpeed / site.model.cell_m;
  channel.samples = site.model.geometry.cells;
  channel.detector = detector;
  channel.bits = bits;
  return channel;
}

std::vector<FormedSpoke> formed_spokes(const RowStore& rows, const echo::SweepEchoes::Grid& grid,
                                       const echo::SweepChannel& channel, double pulses_per_spoke,
                                       std::uint32_t first, std::uint32_t count,
                                       ChangeOfSamples change) {
  echo::SweepReceiver receiver(channel, grid);
  board::SpokeFormer former(kRows);
  std::vector<FormedSpoke> spokes;
  const auto keep = [&](const board::Sweep& made) {
    const std::uint64_t turn = first / kRows * kRows;
    spokes.push_back({turn + made.meta.spoke, made.meta.pulses, made.samples[0]});
  };
  board::Sweep sweep;
  for (std::uint64_t trigger = 0;; ++trigger) {
    const double azimuth = first - 0.5 + (static_cast<double>(trigger) + 0.5) / pulses_per_spoke;
    if (azimuth > first + count - 0.5) break;
    const double row = std::floor(azimuth);
    const auto before = static_cast<std::uint64_t>(row);
    sweep.meta = meta_at(azimuth, trigger, channel.samples);
    sweep.samples[0].resize(channel.samples);
    receiver.receive(rows.row(before), rows.row(before + 1), static_cast<float>(azimuth - row),
                     trigger, sweep.samples[0]);
    if (change != nullptr) change(sweep.samples[0]);
    former.add(sweep, keep);
  }
  former.finish(keep);
  return spokes;
}

}  // namespace skerry::validation
