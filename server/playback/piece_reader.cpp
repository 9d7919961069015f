#include "server/playback/piece_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/recording/topics.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::server {
namespace {

using recording::Kind;

}  // namespace

PieceReader::PieceReader(const recording::RecordingReader& reader, const RecordedRadars& radars)
    : played_(radars.played), cursor_(reader.items(played_topics(reader.summary(), radars))) {}

void PieceReader::seek(UtcTime time) {
  ready_.clear();
  pending_.clear();
  held_.reset();
  cursor_.seek(time);
}

std::optional<PieceReader::Read> PieceReader::read() {
  while (const auto item = cursor_.next()) {
    // Pace and place are those of the file's index, which a spoke's own time may contradict.
    Read read{item->time, item->topic, nullptr, {}};
    if (is_of_a_radar(item->topic.kind)) {
      const auto played = played_.find(item->topic.radar);
      if (played == played_.end()) continue;
      read.topic.radar = played->second;
    }
    if (item->topic.kind != Kind::spoke) {
      read.bytes.assign(item->bytes.begin(), item->bytes.end());
      return read;
    }
    const bool parsed =
        message_.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()));
    auto spoke = from_message(message_);
    if (!parsed || !spoke) {
      if (++unreadable_ == 1) first_unreadable_ = parsed ? spoke.error().text : "no wire::Spoke";
      continue;
    }
    read.spoke = std::make_shared<Spoke>(std::move(spoke).value());
    // The topic is what the reader was asked for.
    read.spoke->header.radar = read.topic.radar;
    read.spoke->header.view = read.topic.view;
    return read;
  }
  return std::nullopt;
}

void PieceReader::make_ready(Piece& gathered) {
  if (gathered.spokes.empty()) return;
  gathered.time = gathered.times.back();
  ready_.push_back(std::exchange(gathered, {}));
}

void PieceReader::make_all_ready() {
  const std::size_t before = ready_.size();
  for (auto& [view, gathered] : pending_) make_ready(gathered);
  std::stable_sort(ready_.begin() + static_cast<std::ptrdiff_t>(before), ready_.end(),
                   [](const Piece& a, const Piece& b) { return a.time < b.time; });
}

std::optional<Piece> PieceReader::next(std::optional<UtcTime> until) {
  for (;;) {
    if (!ready_.empty()) {
      Piece piece = std::move(ready_.front());
      ready_.pop_front();
      return piece;
    }
    if (!held_) held_ = read();
    if (!held_ || (until && held_->time >= *until)) {
      make_all_ready();
      if (ready_.empty()) return std::nullopt;
      continue;
    }
    for (auto& [view, gathered] : pending_) {
      const bool waits = !gathered.spokes.empty() && gathered.times.front() + span_ <= held_->time;
      if (waits) make_ready(gathered);
    }
    if (held_->topic.kind != Kind::spoke) {
      ready_.push_back({held_->time, held_->topic, {}, {}, std::move(held_->bytes)});
    } else {
      Piece& gathered = pending_[{held_->topic.radar, held_->topic.view}];
      if (gathered.spokes.empty()) {
        gathered.topic = held_->topic;
        gathered.spokes.reserve(kMostSpokes);
        gathered.times.reserve(kMostSpokes);
      }
      gathered.spokes.push_back(std::move(held_->spoke));
      gathered.times.push_back(held_->time);
      if (gathered.spokes.size() == kMostSpokes) make_ready(gathered);
    }
    held_.reset();
  }
}

std::string PieceReader::problem() const {
  std::string text;
  if (const std::uint64_t damaged = cursor_.chunks_damaged(); damaged > 0) {
    text = fmt::format("{} damaged parts passed over", damaged);
    if (const auto damage = cursor_.damage()) text += ", the last: " + damage->to_string();
  }
  if (unreadable_ > 0) {
    text += fmt::format("{}{} spokes cannot be read, the first: {}", text.empty() ? "" : "; ",
                        unreadable_, first_unreadable_);
  }
  return text;
}

}  // namespace skerry::server
