#include "clients/recording/recorded_turns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/recording/progress.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::client {
namespace {

using recording::Item;
using recording::Kind;
using recording::RecordingReader;
using recording::Topic;

template <typename Message>
std::optional<Message> parsed(std::span<const std::uint8_t> bytes) {
  Message message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return std::nullopt;
  return message;
}

// At the time of its item: what else the recording has goes by that, also where UTC of spokes
// steps.
std::optional<Spoke> spoke_of(const Item& item) {
  const auto message = parsed<wire::Spoke>(item.bytes);
  if (!message) return std::nullopt;
  auto spoke = from_message(*message);
  if (!spoke) return std::nullopt;
  spoke->header.utc = item.time;
  return *std::move(spoke);
}

double share_of(const recording::Summary& summary, const RecordedPart& part, UtcTime time) {
  const UtcTime from = part.from.value_or(summary.begin);
  const double length = in_seconds(std::min(part.to.value_or(summary.end), summary.end) - from);
  return length > 0.0 ? std::clamp(in_seconds(time - from) / length, 0.0, 1.0) : 0.0;
}

std::string counted(std::uint64_t count, const char* what) {
  return count == 0 ? "" : fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string NotRead::text() const {
  const std::string of_spokes = counted(spokes, "spoke"), of_chunks = counted(chunks, "chunk");
  const char* both = spokes > 0 && chunks > 0 ? " and " : "";
  return spokes + chunks == 0 ? "" : of_spokes + both + of_chunks + " could not be read whole";
}

RecordedTurns::RecordedTurns(const RecordingReader& reader, const RecordedPart& part,
                             const RecordingReader::Progress& progress)
    : reader_(reader),
      part_(part),
      progress_(progress),
      cursor_(reader.items({{Kind::spoke, part.radar, part.view},
                            {Kind::settings, part.radar, part.view},
                            {Kind::own_ship, part.radar, 0}})) {
  if (const auto hello = reader.hello()) {
    for (const auto& info : hello->radars()) {
      if (info.radar() == part.radar) labels_.radar = info.name();
    }
  }
  if (!part.from) return;
  cursor_.seek(*part.from);
  if (const auto last = reader.last_before({Kind::settings, part.radar, part.view}, *part.from)) {
    labels_.settings = parsed<wire::Settings>(last->bytes);
  }
  if (const auto last = reader.last_before({Kind::own_ship, part.radar, 0}, *part.from)) {
    labels_.own_ship = parsed<wire::OwnShip>(last->bytes);
  }
}

// A turn that a spoke finished; nothing if none was, or at the end.
std::optional<Scan> RecordedTurns::read_one() {
  const auto item = cursor_.next();
  if (!item || (part_.to && item->time >= *part_.to)) {
    ended_ = true;
    return std::nullopt;
  }
  if (progress_ && items_++ % kLookEvery == 0 &&
      !progress_(share_of(reader_.summary(), part_, item->time))) {
    ended_ = given_up_ = true;
    return std::nullopt;
  }
  switch (item->topic.kind) {
    case Kind::settings:
      if (auto message = parsed<wire::Settings>(item->bytes)) labels_.settings = *message;
      break;
    case Kind::own_ship:
      if (auto message = parsed<wire::OwnShip>(item->bytes)) labels_.own_ship = *message;
      break;
    case Kind::spoke:
      if (auto spoke = spoke_of(*item)) return assembler_.feed(*std::move(spoke));
      ++refused_;
      break;
    default:
      break;
  }
  return std::nullopt;
}

std::optional<RecordedTurn> RecordedTurns::next() {
  while (!ended_) {
    if (auto scan = read_one()) return RecordedTurn{++number_, *std::move(scan), labels_};
  }
  if (given_up_ || assembler_.unfinished().received == 0) return std::nullopt;
  Scan last = assembler_.unfinished();
  assembler_ = {};
  return RecordedTurn{++number_, std::move(last), labels_};
}

Result<SpokesRead, recording::RecordingError> each_spoke(
    const RecordingReader& reader, const RecordedPart& part, const std::function<void(Spoke)>& line,
    const RecordingReader::Progress& progress) {
  const recording::Summary& summary = reader.summary();
  recording::ItemCursor cursor = reader.items({{Kind::spoke, part.radar, part.view}});
  if (part.from) cursor.seek(*part.from);
  SpokesRead read;
  std::uint64_t items = 0;
  while (const auto item = cursor.next()) {
    if (part.to && item->time >= *part.to) break;
    if (progress && items++ % kLookEvery == 0 && !progress(share_of(summary, part, item->time))) {
      return Failure{recording::RecordingError{summary.file, 0, "given up"}};
    }
    if (auto spoke = spoke_of(*item)) {
      line(*std::move(spoke));
      ++read.spokes;
    } else {
      ++read.not_read.spokes;
    }
  }
  read.not_read.chunks = cursor.chunks_damaged();
  if (read.spokes > 0) return read;
  std::string why = no_spokes_text(summary, part);
  if (const std::string lost = read.not_read.text(); !lost.empty()) why += "; " + lost;
  return Failure{recording::RecordingError{summary.file, 0, std::move(why)}};
}

std::string no_spokes_text(const recording::Summary& summary, const RecordedPart& part) {
  std::string there;
  for (const auto& [topic, count] : summary.items) {
    if (topic.kind != Kind::spoke || count == 0) continue;
    if (topic.radar == part.radar && topic.view == part.view) {
      return fmt::format("there are no spokes of radar {} view {} in that part", part.radar,
                         part.view);
    }
    there += fmt::format("{} radar {} view {}", there.empty() ? "" : ",", topic.radar, topic.view);
  }
  return fmt::format("it has no spokes of radar {} view {}; there are{}", part.radar, part.view,
                     there.empty() ? " none of any" : there);
}

}  // namespace skerry::client
