#include "server/displays/navico/navico_spokes.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

using navico::kSpokeCells;

constexpr double kMaxCutCells = 8192.0;

}  // namespace

std::uint32_t range_of_scale_dm(navico::Model model, RangeScale scale) {
  const auto dm = static_cast<std::uint32_t>(scale.length().in_metres() * 10.0 + 0.5);
  return std::clamp(dm, navico::kMinRangeDm, navico::max_range_dm(model));
}

NavicoSpokes::NavicoSpokes(navico::Model model, std::shared_ptr<const NavicoGate> gate)
    : model_(model),
      gate_(std::move(gate)),
      resampler_(navico::kTurnSpokes, static_cast<std::uint32_t>(kSpokeCells)) {
  frame_.reserve(navico::kFrameOctets);
}

void NavicoSpokes::begin_anew() {
  frame_.clear();
  frame_spokes_ = 0;
  next_index_ = navico::kTurnSpokes;
}

EncodedSectorPtr NavicoSpokes::encode(const Sector& sector) {
  auto out = std::make_shared<EncodedSector>();
  out->first_sequence = sector.spokes.front()->header.sequence;
  out->scan = sector.spokes.front()->header.scan;
  if (!gate_->is_open()) {
    begin_anew();
    return out;
  }
  for (const SpokePtr& spoke : sector.spokes) add(*spoke, *out);
  return out;
}

void NavicoSpokes::add(const Spoke& spoke, EncodedSector& out) {
  const RangeScale scale = spoke.header.range_scale;
  std::uint32_t range_dm = gate_->range_dm(scale);
  if (range_dm == 0) range_dm = range_of_scale_dm(model_, scale);
  if (range_dm != range_dm_) {
    range_dm_ = range_dm;
    range_ = navico::spoke_range(model_, range_dm);
    resampler_ = SpokeResampler(navico::kTurnSpokes, static_cast<std::uint32_t>(kSpokeCells));
  }
  resampler_.add(cut(spoke), [&](const ResampledSpoke& each) { append(each, out); });
}

const Spoke& NavicoSpokes::cut(const Spoke& spoke) {
  const double share = range_.reach / spoke.header.reach();
  const double wanted = std::floor(spoke.header.geometry.cells * share + 0.5);
  const auto cells = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, kMaxCutCells));
  if (cells == spoke.header.geometry.cells) return spoke;
  cut_ = spoke;
  cut_.header.geometry.cells = cells;
  cut_.cells.resize(cells);
  if (!cut_.doppler.empty()) cut_.doppler.resize(cells);
  return cut_;
}

void NavicoSpokes::append(const ResampledSpoke& spoke, EncodedSector& out) {
  navico::SpokeFields fields;
  if (navico::is_first_generation(model_) && next_index_ != navico::kTurnSpokes &&
      spoke.header.index != next_index_) {
    fields.status = navico::kSpokeAfterGap;
  }
  next_index_ = (spoke.header.index + 1) % navico::kTurnSpokes;
  fields.scan = scan_;
  fields.angle = static_cast<std::uint16_t>(spoke.header.index * 2);
  fields.heading = navico::heading_field(spoke.header.heading);
  fields.rotation = rotation_++;
  scan_ = static_cast<std::uint16_t>((scan_ + 1) % navico::kTurnUnits);

  std::array<std::uint8_t, kSpokeCells / 2> nibbles;
  const auto cells = std::span<const std::uint8_t, kSpokeCells>(spoke.cells);
  spoke.header.geometry.bits == 4 ? navico::pack_nibbles(cells, nibbles)
                                  : navico::pack_cells(cells, nibbles);
  if (navico::has_doppler(model_) && !spoke.doppler.empty()) {
    for (std::size_t i = 0; i < kSpokeCells; ++i) {
      const int shift = i % 2 == 0 ? 0 : 4;
      std::uint8_t& octet = nibbles[i / 2];
      std::uint8_t cell = std::min<std::uint8_t>(octet >> shift & 0x0F, navico::kMostBesideDoppler);
      if (cell > 0 && spoke.doppler[i] == DopplerClass::approaching) cell = navico::kApproaching;
      if (cell > 0 && spoke.doppler[i] == DopplerClass::receding) cell = navico::kReceding;
      octet = static_cast<std::uint8_t>((octet & (0xF0 >> shift)) | cell << shift);
    }
  }
  if (frame_spokes_ == 0) navico::append_frame_header(frame_, navico::kFrameSpokes);
  navico::append_spoke(frame_, fields, range_, model_, nibbles);
  if (++frame_spokes_ < navico::kFrameSpokes) return;
  out.bytes.insert(out.bytes.end(), frame_.begin(), frame_.end());
  out.spoke_ends.push_back(static_cast<std::uint32_t>(out.bytes.size()));
  frame_.clear();
  frame_spokes_ = 0;
}

}  // namespace skerry::server
