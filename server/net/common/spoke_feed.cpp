#include "server/net/common/spoke_feed.hpp"

#include <algorithm>

namespace skerry::server {

Cursor SpokeFeed::add(FeedReader& reader) {
  readers_.push_back(&reader);
  takers_.push_back(&reader);
  if (registration_ == nullptr) registration_ = ring_->on_publish([this] { wake(); });
  return ring_->cursor_at_end();
}

void SpokeFeed::remove(FeedReader& reader) {
  std::erase(readers_, &reader);
  std::erase(takers_, &reader);
  if (takers_.empty()) registration_.reset();
}

void SpokeFeed::retire(std::unique_ptr<SpokeFeed> feed) {
  asio::io_context& io = feed->io_;
  asio::post(io, [feed = std::move(feed)] {});
}

void SpokeFeed::wake() {
  if (wake_posted_.exchange(true)) return;
  asio::post(io_, [this] {
    wake_posted_.store(false);
    for (FeedReader* reader : takers_) reader->on_sector();
  });
}

}  // namespace skerry::server
