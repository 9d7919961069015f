// Furuno DRS and FAR.
#include <algorithm>

#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/picture_decoder.hpp"
#include "protocol/furuno/spoke_frame.hpp"

namespace skerry::captures {
namespace {

constexpr std::uint32_t kAnglesPerPlace = furuno::kAnglesPerTurn / kFurunoSpokes;
// A sweep reaches so far back: at 60 turns a minute they are 16 angles apart.
constexpr std::uint32_t kMostFilled = 4;
constexpr Duration kLongestFrame = std::chrono::milliseconds(200);

class FurunoPicture : public PictureDecoder {
 public:
  using PictureDecoder::PictureDecoder;

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    const auto frame = furuno::decode_spoke_frame(datagram.payload);
    if (!frame) return frame.error();
    // The last sweep ends when the datagram leaves; the others lie in the time since the one
    // before.
    const Duration since = datagram.time - std::exchange(last_time_, datagram.time);
    const auto count = static_cast<std::int64_t>(frame->sweeps.size());
    const Duration step = since > Duration{} && since < kLongestFrame ? since / count : Duration{};
    for (std::int64_t i = 0; i < count; ++i) {
      add(*frame, frame->sweeps[static_cast<std::size_t>(i)],
          datagram.time - step * (count - 1 - i), out);
    }
    settings_.set_standby(false);
    return std::nullopt;
  }

  void hear(const pcap::Datagram&) override {}

 private:
  void add(const furuno::SpokeFrame& frame, const furuno::Sweep& sweep, UtcTime time,
           std::vector<CapturedSpoke>& out) {
    CapturedSpoke spoke;
    spoke.time = time;
    spoke.spokes_per_turn = kFurunoSpokes;
    spoke.index = sweep.angle / kAnglesPerPlace;
    // An antenna that stands, or begins to turn: one spoke for each place.
    if (last_index_ == spoke.index) return;
    last_index_ = spoke.index;
    spoke.bits = 8;
    if (frame.range_m) {
      spoke.nominal = metres(*frame.range_m);
      spoke.reach = metres(*frame.range_m * frame.cells / frame.scale);
    }
    if (frame.has_heading) {
      spoke.heading =
          TrueBearing::of_spoke(sweep.heading % furuno::kAnglesPerTurn, furuno::kAnglesPerTurn);
    }
    spoke.cells = sweep.cells;
    const std::uint32_t between = gap_.take(spoke.index, time, traits_.turn / 2);
    if (between >= kMostFilled) spoke.missing = between;
    for (std::uint32_t back = between < kMostFilled ? between : 0; back > 0; --back) {
      CapturedSpoke filled = spoke;
      filled.index = (spoke.index + kFurunoSpokes - back) % kFurunoSpokes;
      out.push_back(std::move(filled));
    }
    out.push_back(std::move(spoke));
  }

  CounterGap gap_{kFurunoSpokes, kFurunoSpokes / 2};
  std::optional<std::uint32_t> last_index_;
  UtcTime last_time_{};
};

}  // namespace

std::unique_ptr<PictureDecoder> make_furuno_picture(const PictureTraits& traits) {
  return std::make_unique<FurunoPicture>(traits);
}

}  // namespace skerry::captures
