#include "tests/bench/recorded_turn.hpp"

#include <algorithm>

#include "echo/spoke_renderer.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/scenes/full_scene.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::bench {
namespace {

constexpr std::uint32_t kSector = 16;
constexpr std::int64_t kBegin = 1'790'000'000'000'000'000;  // ns since 1970

void add(RecordedTurn& turn, const Spoke& spoke) {
  wire::Spoke message;
  to_message(spoke, message);
  const std::string bytes = message.SerializeAsString();
  // Behind it are scenario_ns and the cells, of more than 127 octets.
  const std::size_t behind = 9 + 4 + message.cells().size();
  turn.spokes.push_back(
      {spoke.header.utc, {bytes.begin(), bytes.end()}, bytes.size() - behind - 8});
}

// The smallest range scale that a spoke of that reach may have.
RangeScale scale_for(Length reach) {
  for (int i = 0; i < 12; ++i) {
    const auto scale = RangeScale::from_index(i);
    if (scale && scale->length().in_metres() * 2 >= reach.in_metres()) return *scale;
  }
  return *RangeScale::from_index(11);
}

RecordedTurn halo20() {
  RecordedTurn turn{"HALO20", {}, {}};
  Spoke spoke;
  SpokeHeader& header = spoke.header;
  header.geometry = {2048, navico::kSpokeCells, 4};
  for (const CapturedDatagram& datagram : read_radar_capture("halo20-ranges.pcap.gz")) {
    if (datagram.payload.size() != navico::kFrameOctets) continue;
    const auto frame = navico::decode_frame(navico::Model::halo20, datagram.payload);
    if (!frame) continue;
    auto time = datagram.time - std::chrono::milliseconds(40);
    for (const navico::FrameSpoke& each : *frame) {
      const std::uint32_t index = each.fields.angle / 2;
      if (index < header.index) ++header.scan;
      header.index = index;
      ++header.sequence;
      header.range_scale = scale_for(each.fields.reach);
      header.instrumented_range = each.fields.reach;
      if (const auto heading = navico::heading_of(each.fields.heading)) {
        header.heading = TrueBearing::from_units(std::uint32_t{heading->units} << 20);
      }
      header.utc = time = std::max(time, header.utc);
      header.scenario_time = ScenarioTime(time.time_since_epoch());
      time += std::chrono::microseconds(1250);
      spoke.cells.assign(each.cells.begin(), each.cells.end());
      add(turn, spoke);
    }
  }
  turn.duration = turn.spokes.back().time - turn.spokes.front().time + std::chrono::milliseconds(1);
  return turn;
}

}  // namespace

void delay(RecordedTurn::Spoke& spoke, Duration by) {
  spoke.time += by;
  auto ns = static_cast<std::uint64_t>(spoke.time.time_since_epoch().count());
  for (std::size_t i = 0; i < 8; ++i, ns >>= 8) {
    spoke.bytes[spoke.utc_at + i] = static_cast<std::uint8_t>(ns);
  }
}

RecordedTurn simulated_turn() {
  RecordedTurn turn{"full scene", {}, std::chrono::milliseconds(2500)};
  const auto found = scenes::full_scene();
  if (!found) turn.name = "pulses of noise";
  Spoke spoke;
  SpokeHeader& header = spoke.header;
  header.geometry = found ? found->geometry : ScanGeometry{4096, 1024, 8};
  header.range_scale = found ? found->controls.range_scale : *RangeScale::find(6.0);
  const std::uint32_t spokes = header.geometry.spokes_per_turn, cells = header.geometry.cells;
  const echo::SpokeClock clock(24.0, spokes);
  std::optional<echo::SpokeRenderer> renderer;
  std::optional<scenes::MovingScene> scene;
  if (found) {
    renderer.emplace(found->set, found->geometry, clock, 0);
    renderer->set_controls(found->controls);
    scene.emplace(found->scene);
  }
  std::vector<std::uint8_t> video(std::size_t{kSector} * cells);
  std::uint32_t noise = 1;
  // The second turn: the first fills what is kept.
  for (std::uint64_t first = 0; first < 2 * spokes; first += kSector) {
    if (renderer) {
      renderer->render(*scene->at(clock.time_of(first)), first, kSector, video);
    } else {
      for (std::uint8_t& cell : video) {
        noise = noise * 1664525U + 1013904223U;
        cell = noise >> 30 == 0 ? static_cast<std::uint8_t>(noise >> 24) : std::uint8_t{0};
      }
    }
    for (std::uint64_t k = first; k < first + kSector && first >= spokes; ++k) {
      header.sequence = k;
      header.scan = static_cast<std::uint32_t>(k / spokes);
      header.index = static_cast<std::uint32_t>(k % spokes);
      header.scenario_time = clock.time_of(k);
      header.utc = UtcTime(Duration(kBegin)) + header.scenario_time.time_since_epoch();
      header.heading = TrueBearing::from_units(1'000'000'000 + static_cast<std::uint32_t>(37 * k));
      header.own_ship = {60.4 + 2e-8 * static_cast<double>(k), 5.3 + 4e-8 * static_cast<double>(k)};
      const auto begin = video.begin() + static_cast<std::ptrdiff_t>((k - first) * cells);
      spoke.cells.assign(begin, begin + cells);
      add(turn, spoke);
    }
  }
  return turn;
}

std::vector<RecordedTurn> recorded_turns() {
  std::vector<RecordedTurn> turns{simulated_turn()};
  if (have_radar_captures()) turns.push_back(halo20());
  return turns;
}

}  // namespace skerry::bench
