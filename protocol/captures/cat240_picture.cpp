// ASTERIX CAT240.  Its azimuths are from true north: there is no heading.
#include "protocol/asterix/cat240.hpp"
#include "protocol/captures/counter_gap.hpp"
#include "protocol/captures/picture_decoder.hpp"

namespace skerry::captures {
namespace {

// Nearest cells that a sender may leave out; they are filled with zeros.
constexpr std::uint32_t kMostLeftOut = 65'535;
constexpr std::uint64_t kMessageIndices = std::uint64_t{1} << 32;

std::uint16_t source_of(const Cat240Record& record) {
  return static_cast<std::uint16_t>(record.source.sac << 8 | record.source.sic);
}

// Cells of other sizes than 4 and 8 bits: 1 and 2 spread over 0 .. 15, of more the highest 8.
void fit_bits(Cat240Video& video, CapturedSpoke& spoke) {
  if (video.bits_per_cell > 8) {
    const int shift = video.bits_per_cell - 8;
    for (const std::uint32_t cell : video.wide_cells) {
      spoke.cells.push_back(static_cast<std::uint8_t>(cell >> shift));
    }
    return;
  }
  spoke.cells = std::move(video.cells);
  if (video.bits_per_cell == 8) return;
  spoke.bits = 4;
  const int factor = 15 / ((1 << video.bits_per_cell) - 1);
  for (std::uint8_t& cell : spoke.cells) cell = static_cast<std::uint8_t>(cell * factor);
}

// Records that cannot become spokes.
std::optional<WireError> refusal_of(const std::vector<Cat240Record>& records,
                                    std::uint16_t source) {
  for (const Cat240Record& each : records) {
    if (each.video && !each.video->foreign.empty()) {
      return WireError{WireErrorKind::unknown_kind, 0,
                       "CAT240: cells are compressed in a way only their sender knows"};
    }
    if (each.video && source_of(each) == source && each.video->cell_duration == 0) {
      return WireError{WireErrorKind::out_of_range, 0, "CAT240: the cells have no duration"};
    }
  }
  return std::nullopt;
}

class Cat240Picture : public PictureDecoder {
 public:
  using PictureDecoder::PictureDecoder;

  std::optional<WireError> decode(const pcap::Datagram& datagram,
                                  std::vector<CapturedSpoke>& out) override {
    auto records = decode_cat240(datagram.payload);
    if (!records) return records.error();
    if (auto refusal = refusal_of(*records, traits_.key.source)) return refusal;
    for (Cat240Record& record : *records) {
      if (!record.video || source_of(record) != traits_.key.source) continue;
      if (record.video->cell_count == 0 || record.video->start_range > kMostLeftOut) continue;
      out.push_back(spoke_of(*record.video, datagram.time));
    }
    return std::nullopt;
  }

  void hear(const pcap::Datagram&) override {}

 private:
  CapturedSpoke spoke_of(Cat240Video& video, UtcTime time) {
    CapturedSpoke spoke;
    spoke.time = time;
    spoke.spokes_per_turn = traits_.spokes_per_turn;
    spoke.from_north = true;
    const auto bearing = TrueBearing::from_units(std::uint32_t{video.start_azimuth} << 16);
    spoke.index = bearing.nearest_spoke(traits_.spokes_per_turn);
    spoke.beyond = bearing - TrueBearing::of_spoke(spoke.index, traits_.spokes_per_turn);
    spoke.missing = gap_.take(video.message_index, time, traits_.turn);
    const Length cell = video.cell_size();
    fit_bits(video, spoke);
    spoke.cells.insert(spoke.cells.begin(), video.start_range, 0);
    spoke.reach = cell * static_cast<double>(spoke.cells.size());
    return spoke;
  }

  CounterGap gap_{kMessageIndices, ScanGeometry::kMaxSpokes};
};

}  // namespace

std::unique_ptr<PictureDecoder> make_cat240_picture(const PictureTraits& traits) {
  return std::make_unique<Cat240Picture>(traits);
}

}  // namespace skerry::captures
