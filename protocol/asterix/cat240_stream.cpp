#include "protocol/asterix/cat240_stream.hpp"

#include <fmt/format.h>

#include <string>

namespace skerry {
namespace {

std::string summary_text(const SpokeHeader& h) {
  return fmt::format("Skerry radar {} scan {}: {} NM, {} spokes, {} cells", h.radar, h.scan,
                     h.range_scale.in_nautical_miles(), h.geometry.spokes_per_turn,
                     h.geometry.cells);
}

}  // namespace

void Cat240Stream::add(const Spoke& spoke, const Sink& sink) {
  const ScanGeometry& geometry = spoke.header.geometry;
  const std::uint32_t turn_spokes =
      shape_.turn_spokes == 0 ? geometry.spokes_per_turn : shape_.turn_spokes;
  const std::uint32_t cells = shape_.cells == 0 ? geometry.cells : shape_.cells;
  if (turn_spokes == geometry.spokes_per_turn && cells == geometry.cells) {
    return add_record(spoke.header, spoke.cells, sink);
  }
  if (!resampler_ || !(resampled_ == geometry)) {
    resampler_.emplace(turn_spokes, cells);
    resampled_ = geometry;
  }
  resampler_->add(
      spoke, [&](const ResampledSpoke& given) { add_record(given.header, given.cells, sink); });
}

void Cat240Stream::add_record(const SpokeHeader& header, std::span<const std::uint8_t> cells,
                              const Sink& sink) {
  if (shape_.summaries && summarised_ != header.scan) {
    send_block(sink);
    scratch_.clear();
    append_cat240_summary(scratch_, summary_text(header), shape_.options.source, header.utc);
    sink(scratch_);
    summarised_ = header.scan;
  }
  scratch_.clear();
  append_cat240_video_record(scratch_, header, cells, shape_.options, message_index_++);
  if (held_ > 0 && block_.size() + scratch_.size() > shape_.max_datagram) send_block(sink);
  if (held_ == 0) begin_cat240_block(block_);
  block_.insert(block_.end(), scratch_.begin(), scratch_.end());
  if (++held_ >= shape_.records) send_block(sink);
}

void Cat240Stream::send_block(const Sink& sink) {
  if (held_ == 0) return;
  end_cat240_block(block_, 0);
  sink(block_);
  block_.clear();
  held_ = 0;
}

}  // namespace skerry
