// A reader of an interface board's records, one after another; and the way there and back of what
// it read.
#include "protocol/board/spoke_former.hpp"
#include "protocol/board/sweep_record.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::board;

void check_meaning(const Sweep& sweep) {
  const double turns = azimuth_turns(sweep.meta);
  fuzz::require(turns >= 0.0 && turns < 1.0, "an azimuth is a part of a turn");
  for (std::size_t c = 0; c < 2; ++c) {
    const std::size_t count = sweep.samples[c].size();
    fuzz::require(count == sweep.meta.channels[c].samples, "samples are as many as stated");
    fuzz::require(count <= kMaxSamples, "the output is bounded");
    const double first = sample_range_m(sweep.meta, c, 0);
    fuzz::require(first > 0.0 && first < 1e18, "a range is a number");
  }
}

void check_meaning(const Edges& edges) {
  std::uint64_t earliest = edges.from_tick;
  for (const Edge& edge : edges.edges) {
    fuzz::require(edge.tick >= earliest && edge.tick < edges.to_tick, "edges are in order");
    earliest = edge.tick;
  }
}

void check_meaning(const Event& event) {
  fuzz::require(event.event != 0 && (event.event & (event.event - 1)) == 0, "one event at a time");
}

// A former must take whatever can be decoded.
class Former {
 public:
  void add(const Sweep& sweep) {
    former_.add(sweep, [this](const Sweep& spoke) { took_ += spoke.meta.pulses; });
    ++gave_;
  }
  void finish() {
    former_.finish([this](const Sweep& spoke) { took_ += spoke.meta.pulses; });
    fuzz::require(took_ == gave_, "every pulse is in one spoke");
  }

 private:
  SpokeFormer former_{256};
  std::uint64_t gave_ = 0, took_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::span<const std::uint8_t> rest(data, size);
  Former former;
  while (!rest.empty()) {
    const auto decoded = decode_record(rest);
    const auto prefix = record_prefix(rest);
    if (!decoded.ok()) {
      fuzz::require(!decoded.error().text.empty(), "a refusal says why");
      fuzz::require(decoded.error().offset <= rest.size(), "a refusal's place is in the bytes");
      // One of a kind to come is passed over by its size.
      if (decoded.error().kind != WireErrorKind::unknown_kind) break;
      fuzz::require(prefix.has_value(), "its size is known");
      rest = rest.subspan(std::min(prefix->size, rest.size()));
      continue;
    }
    fuzz::require(prefix && prefix->size == decoded->size, "a record's prefix has its size");
    fuzz::require(prefix->sequence == decoded->sequence, "and its sequence");
    fuzz::require(decoded->size <= rest.size() && decoded->size <= kMaxRecordBytes,
                  "a record lies in what came");
    Bytes again;
    std::visit(
        [&](const auto& record) {
          check_meaning(record);
          append_record(again, decoded->sequence, record);
        },
        decoded->record);
    fuzz::require(again.size() == decoded->size, "a record is written as long as it was read");
    const auto twice = decode_record(again);
    fuzz::require(twice.ok() && twice->record == decoded->record, "and reads the same again");
    if (const auto* sweep = std::get_if<Sweep>(&decoded->record)) former.add(*sweep);
    rest = rest.subspan(decoded->size);
  }
  former.finish();
  return 0;
}
