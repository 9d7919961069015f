#include "server/relay/spoke_batch.hpp"

#include <fmt/format.h>

#include <utility>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "protocol/wire/varint.hpp"

namespace skerry::server {

bool SpokeBatch::follows(std::uint64_t sequence, std::uint32_t scan) const {
  if (sector_.spokes.empty()) return true;
  const SpokeHeader& last = sector_.spokes.back()->header;
  return sequence == last.sequence + 1 && scan == last.scan;
}

std::optional<std::string> SpokeBatch::fault_of(std::uint32_t radar, std::uint32_t view) const {
  if (radar == radar_ && view == view_) return std::nullopt;
  return fmt::format("a spoke of radar {} view {}; expected radar {} view {}", radar, view, radar_,
                     view_);
}

void SpokeBatch::begin(std::uint64_t sequence, std::uint32_t scan, std::size_t bytes) {
  if (encoded_ != nullptr) return;
  encoded_ = std::make_shared<EncodedSector>();
  encoded_->first_sequence = sequence;
  encoded_->scan = scan;
  encoded_->bytes.reserve(16 * (bytes + kMaxVarint32Octets));
}

void SpokeBatch::end_spoke(std::shared_ptr<const Spoke> spoke) {
  encoded_->spoke_ends.push_back(static_cast<std::uint32_t>(encoded_->bytes.size()));
  sector_.spokes.push_back(std::move(spoke));
}

std::optional<std::string> SpokeBatch::add(const wire::Spoke& spoke,
                                           std::span<const std::uint8_t> body) {
  if (auto fault = fault_of(spoke.radar(), spoke.view())) return fault;
  auto made = from_message(spoke);
  if (!made) return made.error().text;
  auto shared = std::make_shared<Spoke>(std::move(made).value());
  shared->header.view = local_view_;
  begin(spoke.sequence(), spoke.scan(), body.size());
  if (local_view_ == view_) {
    append_varint(encoded_->bytes, body.size());
    encoded_->bytes.insert(encoded_->bytes.end(), body.begin(), body.end());
  } else {
    append_spoke_frame(encoded_->bytes, *shared);
  }
  end_spoke(std::move(shared));
  return std::nullopt;
}

std::optional<std::string> SpokeBatch::add(Spoke spoke) {
  if (auto fault = fault_of(spoke.header.radar, spoke.header.view)) return fault;
  auto shared = std::make_shared<Spoke>(std::move(spoke));
  shared->header.view = local_view_;
  begin(shared->header.sequence, shared->header.scan, shared->cells.size());
  append_spoke_frame(encoded_->bytes, *shared);
  end_spoke(std::move(shared));
  return std::nullopt;
}

SpokeBatch::Spokes SpokeBatch::take() {
  return {std::exchange(sector_, {}), std::exchange(encoded_, nullptr)};
}

SpokeBatch::Spokes renumbered(const SpokeBatch::Spokes& spokes, std::uint64_t shift) {
  const SpokeHeader& first = spokes.sector.spokes.front()->header;
  SpokeBatch batch(first.radar, first.view, first.view);
  for (const SpokePtr& spoke : spokes.sector.spokes) {
    Spoke copy = *spoke;
    copy.header.sequence += shift;
    batch.add(std::move(copy));
  }
  return batch.take();
}

}  // namespace skerry::server
