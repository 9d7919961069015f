// encode_bench: what a spoke costs in every format a display can be sent, resampling included.
//
// Each line encodes sectors of 16 spokes of 1024 cells, as the radar's thread does, 2048 or 4096 to
// the turn; "s/spoke" is the time by spoke of the radar, "B/turn" what leaves for the network.
#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "protocol/asterix/cat240_stream.hpp"
#include "protocol/signalk/radar_message.hpp"
#include "protocol/wire/frame.hpp"
#include "server/displays/emulated_radars.hpp"
#include "tests/unit/displays/fake_display_port.hpp"

namespace skerry {
namespace {

constexpr std::uint32_t kCells = 1024, kSectorSpokes = 16;

// A turn as a coast has it: runs of strong cells, noise, and much empty sea.
std::vector<Sector> turn_of(std::uint32_t turn_spokes, double reach_of_scale) {
  std::vector<Sector> turn(turn_spokes / kSectorSpokes);
  std::uint32_t random = 1;
  for (std::uint32_t i = 0; i < turn_spokes; ++i) {
    Spoke spoke;
    spoke.header.sequence = i;
    spoke.header.index = i;
    spoke.header.geometry = {turn_spokes, kCells, 8};
    spoke.header.range_scale = *RangeScale::find(3.0);
    spoke.header.instrumented_range = reach_of_scale * spoke.header.range_scale.length();
    spoke.header.heading = TrueBearing::from(degrees(31.0));
    spoke.cells.resize(kCells);
    for (std::uint32_t c = 0; c < kCells; ++c) {
      random = random * 1664525u + 1013904223u;
      const bool coast = c > 400 + (i / 7) % 90 && c < 560 + (i / 3) % 50;
      const std::uint32_t noise = random >> 24;
      spoke.cells[c] = static_cast<std::uint8_t>(coast ? 128 + noise / 2 : noise > 245 ? 20 : 0);
    }
    turn[i / kSectorSpokes].spokes.push_back(std::make_shared<Spoke>(std::move(spoke)));
  }
  return turn;
}

// Encodes sectors round and round; `encode` gives the bytes of one.
void run(benchmark::State& state, const std::vector<Sector>& source,
         const std::function<std::size_t(const Sector&)>& encode) {
  std::vector<Sector> turn = source;
  const auto turn_spokes = static_cast<std::uint32_t>(turn.size()) * kSectorSpokes;
  std::size_t next = 0;
  std::uint64_t bytes = 0, spokes = 0;
  for (auto _ : state) {
    bytes += encode(turn[next]);
    spokes += kSectorSpokes;
    if (++next < turn.size()) continue;
    state.PauseTiming();  // the next turn's numbers
    next = 0;
    for (Sector& sector : turn) {
      for (SpokePtr& spoke : sector.spokes) {
        Spoke later = *spoke;
        later.header.sequence += turn_spokes;
        ++later.header.scan;
        spoke = std::make_shared<Spoke>(std::move(later));
      }
    }
    state.ResumeTiming();
  }
  using benchmark::Counter;
  state.counters["s/spoke"] =
      Counter(kSectorSpokes, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["B/turn"] = static_cast<double>(bytes) / static_cast<double>(spokes) * turn_spokes;
}

void add(const std::string& name, const std::vector<Sector>& turn,
         const std::function<std::function<std::size_t(const Sector&)>()>& make) {
  std::string title = name;
  title.append("/").append(std::to_string(turn.size() * kSectorSpokes)).append(" spokes");
  benchmark::RegisterBenchmark(title.c_str(),
                               [turn, make](benchmark::State& state) { run(state, turn, make()); });
}

void add_emulation(const server::EmulatedRadar& row, std::uint32_t turn_spokes) {
  // The real radar's spokes reach so far beyond its range.
  const auto emulation = row.make({});
  wire::Settings settings;
  settings.set_range_nm(3.0);
  const double reach =
      emulation->instrumented_range_m(server::RangeChannel::a, settings) / (3.0 * 1852.0);
  add(row.identity({}).family, turn_of(turn_spokes, reach), [&row] {
    const std::shared_ptr<server::RadarEmulation> radar = row.make({});
    server::FakeDisplayPort port;
    port.at(server::RangeChannel::a).set_range_nm(3.0);
    port.at(server::RangeChannel::a).set_standby(false);
    const std::vector<std::uint16_t> ports(radar->listens().size(), std::uint16_t{7000});
    radar->begin(ipv4(127, 0, 0, 1), ports, ScenarioTime{}, port);
    auto encoder = radar->spoke_encoder(server::RangeChannel::a);
    return [radar, encoder](const Sector& sector) -> std::size_t {
      const server::EncodedSectorPtr encoded = encoder(sector);
      return encoded ? encoded->bytes.size() : 0;
    };
  });
}

void add_cat240(const std::string& name, std::uint32_t turn_spokes,
                const Cat240StreamShape& shape) {
  add(name, turn_of(turn_spokes, 1.0), [shape] {
    return [stream = std::make_shared<Cat240Stream>(shape)](const Sector& sector) {
      std::size_t bytes = 0;
      for (const SpokePtr& spoke : sector.spokes) {
        stream->add(*spoke, [&](std::span<const std::uint8_t> datagram) {
          benchmark::DoNotOptimize(datagram.data());
          bytes += datagram.size();
        });
      }
      return bytes;
    };
  });
}

void register_all() {
  for (const std::uint32_t turn_spokes : {2048u, 4096u}) {
    add("native", turn_of(turn_spokes, 1.0), [] {
      return [out = Bytes()](const Sector& sector) mutable {
        out.clear();
        for (const SpokePtr& spoke : sector.spokes) append_spoke_frame(out, *spoke);
        return out.size();
      };
    });
    for (const unsigned bits : {1u, 2u, 4u, 8u, 16u, 32u}) {
      Cat240StreamShape shape;
      shape.options.bits = static_cast<std::uint8_t>(bits);
      add_cat240("CAT240 " + std::to_string(bits) + " bit", turn_spokes, shape);
    }
    Cat240StreamShape fewer;
    fewer.turn_spokes = 720;
    fewer.cells = 512;
    fewer.records = 8;
    add_cat240("CAT240 720 x 512, 8 records", turn_spokes, fewer);
    Cat240StreamShape compressed;
    compressed.options.compressed = true;
    add_cat240("CAT240 zlib", turn_spokes, compressed);
    for (const server::EmulatedRadar& row : server::emulated_radars()) {
      add_emulation(row, turn_spokes);
    }
    add("Signal K", turn_of(turn_spokes, 1.0), [] {
      return [out = Bytes()](const Sector& sector) mutable {
        out.clear();
        for (const SpokePtr& spoke : sector.spokes) {
          signalk::RadarSpoke given = signalk::radar_spoke(spoke->header);
          given.cells = spoke->cells;
          signalk::append_radar_spoke(out, given);
        }
        return out.size();
      };
    });
  }
}

}  // namespace
}  // namespace skerry

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  skerry::register_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
