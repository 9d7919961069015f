#include "server/replay/comparison.hpp"

#include <fmt/format.h>

#include "protocol/digest/digest.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::server {

struct Comparison::View {
  View(std::uint32_t radar_number, std::uint32_t view_number, recording::ItemCursor cursor)
      : radar(radar_number), number(view_number), items(std::move(cursor)) {
    advance();
  }
  void advance() {
    const auto item = items.next();
    recorded.reset();
    if (!item) return;
    recorded.emplace();
    if (!recorded->ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) {
      recorded->Clear();
    }
    bytes.assign(item->bytes.begin(), item->bytes.end());
  }

  std::uint32_t radar, number;
  recording::ItemCursor items;
  std::optional<wire::Spoke> recorded;  // the next; nothing at the end
  std::string bytes;                    // of it
  Sha256 all;
  Sha256 digest;               // under the checkpoint at hand
  std::size_t checkpoint = 0;  // among those of this view
  std::vector<const recording::Input::Checkpoint*> checkpoints;
};

Comparison::Comparison(const recording::RecordingReader& reader, const RecordedExercise& exercise)
    : reader_(reader) {
  for (const auto& [topic, count] : reader.summary().items) {
    if (topic.kind == recording::Kind::spoke) view_of(topic.radar, topic.view);
  }
  for (const recording::Input::Checkpoint& checkpoint : exercise.checkpoints) {
    view_of(checkpoint.radar(), checkpoint.view()).checkpoints.push_back(&checkpoint);
  }
}

Comparison::~Comparison() = default;

Comparison::View& Comparison::view_of(std::uint32_t radar, std::uint32_t number) {
  auto& view = views_[{radar, number}];
  if (!view) {
    view = std::make_unique<View>(radar, number,
                                  reader_.items({{recording::Kind::spoke, radar, number}}));
  }
  return *view;
}

void Comparison::note(const std::string& what) {
  if (result_.first_difference.empty()) result_.first_difference = what;
}

void Comparison::add(const Spoke& spoke) {
  View& view = view_of(spoke.header.radar, spoke.header.view);
  to_message(spoke, message_);
  bytes_ = message_.SerializeAsString();
  ++result_.made;
  view.all.add(bytes_);
  compare(view, bytes_, spoke.header.sequence);
  hash(view, bytes_, spoke.header.sequence);
}

void Comparison::compare(View& view, const std::string& bytes, std::uint64_t sequence) {
  while (view.recorded && view.recorded->sequence() < sequence) {
    ++result_.missing;
    note(fmt::format("radar {} view {} spoke {}: recorded, not made again", view.radar, view.number,
                     view.recorded->sequence()));
    view.advance();
  }
  if (!view.recorded || view.recorded->sequence() != sequence) return;
  ++result_.compared;
  if (view.bytes != bytes) {
    ++result_.different;
    note(fmt::format("radar {} view {} spoke {} (turn {}, index {})", view.radar, view.number,
                     sequence, view.recorded->scan(), view.recorded->index()));
  }
  view.advance();
}

void Comparison::hash(View& view, const std::string& bytes, std::uint64_t sequence) {
  if (view.checkpoint >= view.checkpoints.size()) return;
  const recording::Input::Checkpoint& at = *view.checkpoints[view.checkpoint];
  if (sequence < at.first_sequence()) return;
  const std::uint64_t number = sequence - at.first_sequence();
  view.digest.add(bytes);
  if (number + 1 < at.spokes()) return;
  ++view.checkpoint;
  ++result_.checkpoints;
  result_.hashed += at.spokes();
  if (view.digest.take() == at.sha256()) return;
  ++result_.checkpoints_wrong;
  note(fmt::format("radar {} view {}: SHA-256 of spokes {} to {}", view.radar, view.number,
                   at.first_sequence(), sequence));
}

ComparisonResult Comparison::finish() {
  std::string digests;
  for (const auto& [key, view] : views_) {
    while (view->recorded) {
      ++result_.missing;
      note(fmt::format("radar {} view {} spoke {}: recorded, not made again", view->radar,
                       view->number, view->recorded->sequence()));
      view->advance();
    }
    if (view->checkpoint < view->checkpoints.size()) {
      result_.checkpoints_wrong += view->checkpoints.size() - view->checkpoint;
      note(fmt::format("radar {} view {}: spokes from {} on were recorded, not made again",
                       view->radar, view->number,
                       view->checkpoints[view->checkpoint]->first_sequence()));
    }
    digests += view->all.take();
  }
  Sha256 all;
  all.add(digests);
  result_.sha256 = hexadecimal(all.take());
  return result_;
}

}  // namespace skerry::server
