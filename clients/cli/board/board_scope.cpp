#include "clients/cli/board/board_scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clients/cli/board/board_words.hpp"
#include "protocol/picture/label_text.hpp"

namespace skerry::client {
namespace {

// Metres from one sample to the next, of a channel with samples.
double step_of(const board::SweepMeta& meta, std::size_t channel) {
  return board::sample_range_m(meta, channel, 1) - board::sample_range_m(meta, channel, 0);
}

}  // namespace

ScopeWindow whole_window(const board::SweepMeta& meta) {
  double end = 1.0;
  for (std::size_t channel = 0; channel < meta.channels.size(); ++channel) {
    const std::uint32_t samples = meta.channels[channel].samples;
    if (samples == 0) continue;
    end = std::max(
        end, board::sample_range_m(meta, channel, samples - 1) + 0.5 * step_of(meta, channel));
  }
  return {0.0, end};
}

std::vector<ScopeColumn> columns_of(const board::Sweep& sweep, std::size_t channel,
                                    const ScopeWindow& window, std::size_t columns) {
  std::vector<ScopeColumn> out(columns);
  const auto& samples = sweep.samples[channel];
  if (samples.empty()) return out;
  const double first =
      board::sample_range_m(sweep.meta, channel, 0) - 0.5 * step_of(sweep.meta, channel);
  const double step = step_of(sweep.meta, channel);
  const double width = (window.to_m - window.from_m) / static_cast<double>(columns);
  const auto last = static_cast<double>(samples.size() - 1);
  for (std::size_t column = 0; column < columns; ++column) {
    const double near = window.from_m + width * static_cast<double>(column);
    const double from = std::floor((near - first) / step);
    const double to = std::ceil((near + width - first) / step) - 1.0;
    if (to < 0.0 || from > last) continue;
    const auto begin = static_cast<std::size_t>(std::max(from, 0.0));
    const auto end = static_cast<std::size_t>(std::min(std::max(to, from), last));
    const auto [low, high] =
        std::minmax_element(samples.begin() + static_cast<std::ptrdiff_t>(begin),
                            samples.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    out[column] = {*low, *high, true};
  }
  return out;
}

std::vector<std::string> scope_lines(const board::SweepMeta& meta) {
  std::vector<std::string> lines;
  const UtcTime utc{std::chrono::nanoseconds(static_cast<std::int64_t>(meta.utc_ns))};
  lines.push_back(fmt::format("radar {}, trigger {} at tick {} of {:g} MHz, {}", meta.radar,
                              meta.trigger_count, meta.trigger_tick, meta.sample_clock_hz * 1e-6,
                              utc_text(utc)));
  lines.push_back(fmt::format("azimuth {:.3f} deg: ACP {} of {} and {}/{} ticks, ARP {}",
                              azimuth_deg(meta), meta.acp_count, meta.acp_per_turn,
                              meta.ticks_since_acp, meta.acp_period, meta.arp_count));
  std::string pulse =
      fmt::format("pulse {:g} us, PRF {:g} Hz, delay {} ticks, faults: {}", meta.pulse_ns * 1e-3,
                  meta.prf_millihertz * 1e-3, meta.delay_ticks, fault_words(meta.faults));
  if (meta.pulses > 1) pulse += fmt::format(", {} pulses integrated", meta.pulses);
  lines.push_back(std::move(pulse));
  for (std::size_t channel = 0; channel < meta.channels.size(); ++channel) {
    std::string words = channel_words(meta, channel);
    if (!words.empty()) lines.push_back(std::move(words));
  }
  return lines;
}

double mark_distance(double length, int marks) {
  const double least = length / marks;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= least * (1.0 - 1e-9)) return step * power;
  }
  return 10.0 * power;
}

std::string mark_text(double mark, double distance, bool with_sign) {
  if (std::abs(mark) < 0.5 * distance) return "0";
  return with_sign ? fmt::format("{:+g}", mark) : fmt::format("{:.4g}", mark);
}

}  // namespace skerry::client
