#include "clients/cli/board/board_signals_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "clients/signals/sigmf_writer.hpp"
#include "clients/signals/signal_gatherer.hpp"
#include "clients/signals/vcd_writer.hpp"
#include "clients/signals/wav_writer.hpp"

namespace skerry::client {
namespace {

using board::Reg;

// More is not for a bench: it would take a fast disk an hour.
constexpr std::uint64_t kMostBytes = 256'000'000'000;
// The fastest a marine radar's pulse is repeated.
constexpr double kFastestPrf = 4000.0;

constexpr std::array kRead = {Reg::sample_clock_hz, Reg::rotation_millirpm, Reg::prf_millihertz,
                              Reg::acp_per_turn,    Reg::spokes_per_turn,   Reg::clocks_low,
                              Reg::clocks_high,     Reg::utc_ns_low,        Reg::utc_ns_high,
                              Reg::source_a,        Reg::samples_a,         Reg::source_b};

std::optional<SignalChannel> channel_off(const std::vector<SignalChannel>& channels,
                                         const BoardFacts& facts) {
  for (const SignalChannel channel : channels) {
    const auto video = video_channel(channel);
    if (video && facts.samples[*video] == 0) return channel;
  }
  return std::nullopt;
}

}  // namespace

ClientResult<BoardFacts> read_facts(BoardClient& client, const BoardPlace& place) {
  std::vector<BoardClient::Operation> operations;
  for (const Reg reg : kRead) operations.push_back({.address = board::address_of(reg)});
  operations.push_back({.address = board::channel_address(Reg::samples_a, 1)});
  const auto values = client.access(operations, place.timeout());
  if (!values) return Failure{values.error()};
  const auto at = [&](std::size_t i) { return (*values)[i].value; };
  BoardFacts facts;
  facts.sample_clock_hz = at(0);
  facts.turns_per_second = (at(1) > 0 ? at(1) / 1000.0 : client.radar().rpm()) / 60.0;
  facts.triggers_per_second = at(2) > 0 ? at(2) / 1000.0 : kFastestPrf;
  facts.acp_per_turn = at(3);
  facts.spokes_per_turn = at(4);
  facts.clocks = at(5) | std::uint64_t{at(6)} << 32;
  facts.utc_ns = at(7) | std::uint64_t{at(8)} << 32;
  facts.samples = {at(9) > 0 ? at(10) : 0, at(11) > 0 ? at(12) : 0};
  facts.source =
      fmt::format("{}, {}, radar {} {} ({})", client.hello().server(), client.hello().scenario(),
                  place.radar, client.radar().name(), client.radar().set());
  if (facts.sample_clock_hz == 0 || !(facts.turns_per_second > 0)) {
    return Failure{ClientError{ClientErrorKind::malformed,
                               fmt::format("the board of radar {} of {} has no sample clock or "
                                           "does not turn",
                                           place.radar, client.name())}};
  }
  return facts;
}

Result<SignalPlan, std::string> make_plan(const SignalOptions& options, const BoardFacts& facts) {
  SignalPlan plan;
  if (options.rate_hz > facts.sample_clock_hz) {
    return Failure{
        fmt::format("a rate of {:.0f} samples/s is above the board's sample clock of "
                    "{} Hz, and would show nothing more",
                    options.rate_hz, facts.sample_clock_hz)};
  }
  plan.rate_hz = options.rate_hz > 0 ? static_cast<std::uint32_t>(std::llround(options.rate_hz))
                                     : facts.sample_clock_hz;
  for (const std::string& name : options.channels) {
    const auto channel = channel_named(name);
    if (channel && std::count(plan.channels.begin(), plan.channels.end(), *channel) == 0) {
      plan.channels.push_back(*channel);
    }
  }
  if (plan.channels.empty()) {
    for (const SignalChannel channel : kAllSignalChannels) {
      if (!channel_off({channel}, facts)) plan.channels.push_back(channel);
    }
  }
  if (const auto off = channel_off(plan.channels, facts)) {
    return Failure{fmt::format("{} is off; skerry board set SOURCE_{}=1 switches it on",
                               channel_name(*off), *off == SignalChannel::video_a ? 'A' : 'B')};
  }
  const bool sampled = !options.wav.empty() || !options.sigmf.empty();
  plan.sweeps = options.vcd_video ||
                (sampled && std::any_of(plan.channels.begin(), plan.channels.end(),
                                        [](SignalChannel c) { return video_channel(c); }));
  if (plan.sweeps && facts.spokes_per_turn != 0) {
    return Failure{
        fmt::format("the board integrates its sweeps to {} spokes a turn, so triggers "
                    "have no video of their own; skerry board set SPOKES_PER_TURN=0 "
                    "changes that",
                    facts.spokes_per_turn)};
  }
  if (sampled) {
    plan.lead_ticks = (std::uint64_t{facts.sample_clock_hz} + plan.rate_hz - 1) / plan.rate_hz;
  }
  plan.seconds = options.seconds > 0 ? options.seconds : options.turns / facts.turns_per_second;
  const double samples = facts.samples[0] + facts.samples[1];
  const double memory =
      plan.seconds * (plan.sweeps ? facts.triggers_per_second * samples * 2 : 0.0) +
      plan.seconds * 24 * (facts.triggers_per_second + facts.turns_per_second * facts.acp_per_turn);
  if (memory > static_cast<double>(SignalWish{}.max_bytes)) {
    return Failure{fmt::format(
        "{:.1f} s of signals take {} of memory, at most {} are used; record less, without video "
        "(--channels), or fewer SAMPLES_A",
        plan.seconds, size_text(static_cast<std::uint64_t>(memory)),
        size_text(SignalWish{}.max_bytes))};
  }
  return plan;
}

std::string size_text(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (size >= 1e9) return fmt::format("{:.1f} GB", size / 1e9);
  if (size >= 1e6) return fmt::format("{:.1f} MB", size / 1e6);
  return fmt::format("{:.1f} kB", size / 1e3);
}

FileSizes file_sizes(const SignalOptions& options, const SignalPlan& plan, std::uint64_t ticks,
                     std::uint32_t sample_clock_hz, std::uint64_t edges,
                     std::uint64_t video_samples) {
  const std::uint64_t samples = SampleGrid(sample_clock_hz, plan.rate_hz, ticks).samples();
  FileSizes sizes;
  std::uint64_t all = 0;
  std::map<std::string, std::uint64_t> by_folder;
  const auto add = [&](const std::string& path, const char* suffix, std::uint64_t bytes) {
    if (path.empty()) return;
    all += bytes;
    const std::string folder = std::filesystem::path(path).parent_path().string();
    by_folder[folder.empty() ? "." : folder] += bytes;
    sizes.text +=
        fmt::format("{}{}{} {}", sizes.text.empty() ? "" : ", ", path, suffix, size_text(bytes));
  };
  add(options.vcd, "", vcd_bytes(edges, options.vcd_video ? video_samples : 0));
  add(options.wav, "", wav_bytes(samples, plan.channels.size()));
  add(options.sigmf, "-*", sigmf_bytes(samples, plan.channels.size()));
  if (all > kMostBytes) {
    sizes.no_room = fmt::format("{} are more than the {} that are written at most", size_text(all),
                                size_text(kMostBytes));
  }
  for (const auto& [folder, bytes] : by_folder) {
    std::error_code unknown;
    if (!std::filesystem::is_directory(folder, unknown)) {
      sizes.no_room = fmt::format("there is no folder {}", folder);
    }
    const auto space = std::filesystem::space(folder, unknown);
    if (unknown || space.available >= bytes || !sizes.no_room.empty()) continue;
    sizes.no_room = fmt::format("{} are needed in {}, {} are free", size_text(bytes), folder,
                                size_text(space.available));
  }
  return sizes;
}

}  // namespace skerry::client
