#include "server/relay/spoke_batch.hpp"

#include <fmt/format.h>

#include <utility>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "protocol/wire/varint.hpp"

namespace skerry::server {

bool SpokeBatch::follows(const wire::Spoke& spoke) const {
  if (sector_.spokes.empty()) return true;
  const SpokeHeader& last = sector_.spokes.back()->header;
  return spoke.sequence() == last.sequence + 1 && spoke.scan() == last.scan;
}

std::optional<std::string> SpokeBatch::add(const wire::Spoke& spoke,
                                           std::span<const std::uint8_t> body) {
  if (spoke.radar() != radar_ || spoke.view() != view_) {
    return fmt::format("a spoke of radar {} view {}; expected radar {} view {}", spoke.radar(),
                       spoke.view(), radar_, view_);
  }
  auto made = from_message(spoke);
  if (!made) return made.error().text;
  auto shared = std::make_shared<Spoke>(std::move(made).value());
  shared->header.view = local_view_;
  if (encoded_ == nullptr) {
    encoded_ = std::make_shared<EncodedSector>();
    encoded_->first_sequence = spoke.sequence();
    encoded_->scan = spoke.scan();
    encoded_->bytes.reserve(16 * (body.size() + kMaxVarint32Octets));
  }
  if (local_view_ == view_) {
    append_varint(encoded_->bytes, body.size());
    encoded_->bytes.insert(encoded_->bytes.end(), body.begin(), body.end());
  } else {
    append_spoke_frame(encoded_->bytes, *shared);
  }
  encoded_->spoke_ends.push_back(static_cast<std::uint32_t>(encoded_->bytes.size()));
  sector_.spokes.push_back(std::move(shared));
  return std::nullopt;
}

SpokeBatch::Spokes SpokeBatch::take() {
  return {std::exchange(sector_, {}), std::exchange(encoded_, nullptr)};
}

}  // namespace skerry::server
