// wire_bench: what a spoke costs on the wire, per format, cells and bits.  Nothing is compressed:
// CAT240 is sent as it is, and the native protocol knows no compression.
#include <benchmark/benchmark.h>

#include <optional>
#include <string>

#include "protocol/asterix/cat240.hpp"
#include "protocol/wire/datagram.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/spoke_message.hpp"

namespace skerry {
namespace {

Spoke spoke_of(std::uint32_t cells, std::uint32_t bits) {
  Spoke spoke;
  spoke.header = {.radar = 1,
                  .view = 0,
                  .sequence = 123456789,
                  .scan = 30000,
                  .index = 2345,
                  .geometry = {4096, cells, bits},
                  .range_scale = *RangeScale::find(6.0),
                  .heading = TrueBearing::from(degrees(31.0)),
                  .own_ship = {60.27, 5.15},
                  .scenario_time = ScenarioTime(Duration(1234567890123)),
                  .utc = UtcTime(Duration(1795000000123456789))};
  spoke.cells.resize(cells);
  std::uint32_t state = 1;
  for (std::uint8_t& cell : spoke.cells) {
    state = state * 1664525u + 1013904223u;
    cell = static_cast<std::uint8_t>(state >> (32 - bits));
  }
  return spoke;
}

void report(benchmark::State& state, const Spoke& spoke, std::size_t bytes) {
  using benchmark::Counter;
  state.counters["s/cell"] = Counter(static_cast<double>(spoke.cells.size()),
                                     Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["bytes"] = static_cast<double>(bytes);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
}

void bench_encode_native(benchmark::State& state, const Spoke& spoke) {
  Bytes out;
  for (auto _ : state) {
    out.clear();
    append_spoke_frame(out, spoke);
    benchmark::DoNotOptimize(out.data());
  }
  report(state, spoke, out.size());
}

// Does what a client does: cuts frames out of the stream, parses and checks them.
void bench_decode_native(benchmark::State& state, const Spoke& spoke) {
  Bytes frame;
  append_spoke_frame(frame, spoke);
  FrameReader reader(kMaxServerFrame);
  wire::ServerMessage message;
  for (auto _ : state) {
    reader.feed(frame);
    const auto body = reader.next();
    if (!body.ok() || !body.value() ||
        !message.ParseFromArray((*body)->data(), static_cast<int>((*body)->size()))) {
      state.SkipWithError("the frame does not read back");
      break;
    }
    const auto read = from_message(message.spoke());
    if (!read.ok()) {
      state.SkipWithError(read.error().text.c_str());
      break;
    }
    benchmark::DoNotOptimize(read.value().cells.data());
    benchmark::DoNotOptimize(reader.next().ok());
  }
  report(state, spoke, frame.size());
}

void bench_split(benchmark::State& state, const Spoke& spoke, std::size_t max_datagram) {
  Bytes frame, scratch;
  append_spoke_frame(frame, spoke);
  std::size_t bytes = 0, datagrams = 0;
  for (auto _ : state) {
    bytes = datagrams = 0;
    for_each_datagram({1, 0, 123456789}, frame_body(frame), max_datagram, scratch,
                      [&](std::span<const std::uint8_t> datagram) {
                        benchmark::DoNotOptimize(datagram.data());
                        benchmark::ClobberMemory();
                        bytes += datagram.size();
                        ++datagrams;
                      });
  }
  report(state, spoke, bytes);
  state.SetLabel(std::to_string(datagrams) + " datagrams");
}

void bench_encode_cat240(benchmark::State& state, const Spoke& spoke) {
  Bytes out;
  std::uint32_t index = 0;
  for (auto _ : state) {
    out.clear();
    append_cat240_video(out, spoke, {25, 1}, index++);
    benchmark::DoNotOptimize(out.data());
  }
  report(state, spoke, out.size());
}

void bench_decode_cat240(benchmark::State& state, const Spoke& spoke) {
  const Bytes datagram = encode_cat240_video(spoke, {25, 1}, 7);
  for (auto _ : state) {
    const auto records = decode_cat240(datagram);
    if (!records.ok()) {
      state.SkipWithError(records.error().text.c_str());
      break;
    }
    benchmark::DoNotOptimize(records.value().data());
  }
  report(state, spoke, datagram.size());
}

void register_all() {
  for (const std::uint32_t cells : {1024u, 4096u}) {
    for (const std::uint32_t bits : {4u, 8u}) {
      const Spoke spoke = spoke_of(cells, bits);
      const std::string of = std::to_string(cells) + " cells/" + std::to_string(bits) + " bit";
      const auto add = [&](const std::string& name, auto bench) {
        benchmark::RegisterBenchmark((name + "/" + of).c_str(),
                                     [=](benchmark::State& state) { bench(state, spoke); });
      };
      add("encode native", bench_encode_native);
      add("decode native", bench_decode_native);
      add("split into 1472-byte datagrams",
          [](benchmark::State& state, const Spoke& s) { bench_split(state, s, kDefaultDatagram); });
      add("split into one datagram",
          [](benchmark::State& state, const Spoke& s) { bench_split(state, s, kMaxDatagram); });
      add("encode CAT240", bench_encode_cat240);
      add("decode CAT240", bench_decode_cat240);
    }
  }
}

}  // namespace
}  // namespace skerry

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  skerry::register_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
