#include "server/board/sweep_maker.hpp"

#include <algorithm>

#include "server/board/test_pattern.hpp"

namespace skerry::server {
namespace {

bool same(const echo::SweepEchoes::Grid& a, const echo::SweepEchoes::Grid& b) {
  return a.rows_per_turn == b.rows_per_turn && a.cells == b.cells && a.cell_m == b.cell_m &&
         a.pulse == b.pulse && a.video_range_db == b.video_range_db && a.blind_m == b.blind_m &&
         a.seed == b.seed && a.radar == b.radar;
}

echo::CodeDecimation mode_of(board::DecimationMode mode) {
  switch (mode) {
    case board::DecimationMode::peak:
      return echo::CodeDecimation::peak;
    case board::DecimationMode::mean:
      return echo::CodeDecimation::mean;
    case board::DecimationMode::sum:
      break;
  }
  return echo::CodeDecimation::sum;
}

}  // namespace

echo::SweepEchoes::Wish SweepMaker::wish_for(std::uint32_t source) const {
  echo::SweepEchoes::Wish wish;
  std::uint64_t ticks = 0;
  for (const ChannelSettings& channel : settings_.channels) {
    if (has_video(channel) && channel.source == source) ticks = std::max(ticks, channel.length());
  }
  wish.tick_m = 0.5 * echo::kLightSpeed / settings_.clock_hz;
  wish.reach_m = wish.tick_m * static_cast<double>(ticks + settings_.delay_ticks);
  wish.pulse_code = source == radar_ + 1 ? settings_.pulse_code : 0;
  wish.rpm = settings_.milli_rpm / 1000.0;
  return wish;
}

echo::SweepChannel SweepMaker::channel_for(const ChannelSettings& channel) const {
  echo::SweepChannel c;
  c.sample_clock_hz = settings_.clock_hz;
  c.delay_ticks = settings_.delay_ticks;
  c.samples = channel.format.samples;
  c.decimation = channel.format.decimation;
  c.mode = mode_of(channel.format.mode);
  c.detector = channel.format.detector == board::Detector::log ? echo::VideoDetector::log
                                                               : echo::VideoDetector::linear;
  c.bits = channel.format.bits;
  c.inverted = channel.format.inverted;
  c.gain_db = channel.gain_centibel / 100.0;
  c.offset = channel.offset;
  c.stc = channel.stc;
  return c;
}

void SweepMaker::prepare() {
  for (auto& [number, source] : sources_) source.has_rows = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const ChannelSettings& settings = settings_.channels[i];
    Channel& channel = channels_[i];
    channel.source = nullptr;
    if (!has_video(settings)) continue;
    const auto [found, is_new] = sources_.try_emplace(settings.source);
    Source& source = found->second;
    if (!source.echoes && find_) source.echoes = find_(settings.source - 1);
    if (!source.echoes) continue;
    const echo::SweepEchoes::Wish wish = wish_for(settings.source);
    if (source.wish != wish) {
      source.wish = wish;
      source.echoes->set(wish);
    }
    source.grid = source.echoes->grid();
    channel.source = &source;
    const echo::SweepChannel wanted = channel_for(settings);
    if (!channel.receiver || !(channel.receiver->channel() == wanted) ||
        !same(channel.grid, source.grid)) {
      channel.grid = source.grid;
      // The old one holds what both share (its noise) until the new one is made.
      channel.receiver = std::make_unique<echo::SweepReceiver>(wanted, source.grid);
    }
  }
}

float SweepMaker::find_rows(Source& source, Azimuth azimuth, ScenarioTime when) const {
  const std::uint64_t rows = source.grid.rows_per_turn;
  const auto place = static_cast<unsigned __int128>(azimuth.fraction) * rows;
  const std::uint64_t row = azimuth.turns * rows + static_cast<std::uint64_t>(place >> 64);
  if (!source.has_rows || source.row != row) {
    source.before = source.echoes->row(row, when);
    source.after = source.echoes->row(row + 1, when);
    source.row = row;
    source.has_rows = true;
  }
  return static_cast<float>(static_cast<double>(static_cast<std::uint64_t>(place)) * 0x1p-64);
}

void SweepMaker::make(Azimuth azimuth, ScenarioTime when, bool blanked, board::Sweep& sweep) {
  for (std::size_t i = 0; i < 2; ++i) {
    const ChannelSettings& settings = settings_.channels[i];
    if (!settings.is_on()) continue;
    const std::span<std::uint16_t> codes(sweep.samples[i]);
    if (blanked) {
      std::fill(codes.begin(), codes.end(), board::blank_code(settings.format));
    } else if (settings.test_mode != board::TestMode::off) {
      fill_test_pattern(settings, sweep.meta.trigger_count, board::azimuth_turns(sweep.meta),
                        codes);
    } else if (Source* source = channels_[i].source) {
      const float share = find_rows(*source, azimuth, when);
      channels_[i].receiver->receive(source->before, source->after, share, sweep.meta.trigger_tick,
                                     codes);
    } else {
      std::fill(codes.begin(), codes.end(), board::blank_code(settings.format));
    }
  }
}

}  // namespace skerry::server
