#include "server/recorder/view_readers.hpp"

#include <algorithm>
#include <utility>

namespace skerry::server {

ViewReaders::ViewReaders(RadarHost& host, Wanted wanted, std::function<void()> wake)
    : host_(host), wanted_(std::move(wanted)), wake_(std::move(wake)) {
  look({});
}

void ViewReaders::look(const Changes& changes) {
  const std::uint64_t version = host_.views_version();
  if (version == version_) return;
  version_ = version;
  for (const std::uint32_t radar : wanted_.radars) look_at(radar, changes);
}

void ViewReaders::look_at(std::uint32_t radar, const Changes& changes) {
  const std::vector<RadarHost::View> views = host_.views(radar);
  // A number that has come back is another view: its channel tells.
  const auto is_gone = [&](const std::unique_ptr<RingReader>& reader) {
    return reader->radar() == radar &&
           std::none_of(views.begin(), views.end(),
                        [&](const RadarHost::View& view) { return reader->is_of(*view.channel); });
  };
  for (const auto& reader : readers_) {
    if (is_gone(reader)) changes.closed(*reader);
  }
  std::erase_if(readers_, is_gone);
  for (const RadarHost::View& view : views) {
    if (view.number != 0 && !wanted_.all_views) continue;
    const bool is_read = std::any_of(readers_.begin(), readers_.end(), [&](const auto& reader) {
      return reader->is_of(*view.channel);
    });
    if (is_read || view.channel->find_format(wanted_.format) == nullptr) continue;
    if (in_file_ >= kMaxInFile) {
      if (!std::exchange(is_full_, true) && changes.left_out) changes.left_out(radar, view.number);
      continue;
    }
    ++in_file_;
    readers_.push_back(
        std::make_unique<RingReader>(radar, view.number, view.channel, wanted_.format, wake_));
    if (changes.opened) changes.opened(*readers_.back());
  }
}

void ViewReaders::file_begins() {
  in_file_ = readers_.size();
  if (std::exchange(is_full_, false)) version_ = 0;
}

}  // namespace skerry::server
