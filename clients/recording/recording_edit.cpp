#include "clients/recording/recording_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "clients/recording/position.hpp"
#include "clients/recording/progress.hpp"
#include "clients/recording/radar_numbers.hpp"
#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/topics.hpp"

namespace skerry::client {
namespace {

using recording::EditRule;
using recording::Item;
using recording::ItemCursor;
using recording::Kind;
using recording::RecordingError;
using recording::RecordingReader;
using recording::RecordingWriter;
using recording::Topic;

EditRule rule_of(const Topic& topic) { return recording::row_of(topic.kind).edit; }

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

class Copier {
 public:
  Copier(RecordingWriter& writer, const RecordingReader::Progress& progress, UtcTime from,
         UtcTime to)
      : writer_(writer), progress_(progress), from_(from), length_s_(in_seconds(to - from)) {}

  void add(const Item& item) {
    writer_.add(item);
    ++report_.items;
    report_.spokes += item.topic.kind == Kind::spoke;
  }
  // False: given up.
  bool go_on(UtcTime time) {
    if (!progress_ || looks_++ % kLookEvery != 0) return true;
    const double share = length_s_ > 0.0 ? in_seconds(time - from_) / length_s_ : 0.0;
    return progress_(std::clamp(share, 0.0, 1.0));
  }
  EditReport& report() { return report_; }

 private:
  RecordingWriter& writer_;
  const RecordingReader::Progress& progress_;
  UtcTime from_;
  double length_s_;
  std::uint64_t looks_ = 0;
  EditReport report_;
};

void add_hello(Copier& copier, const wire::Hello& hello, UtcTime time) {
  copier.add(Item{{Kind::hello, 0, 0}, time, bytes_of(hello.SerializeAsString())});
}

}  // namespace

Result<EditReport, RecordingError> cut_recording(const RecordingReader& source, UtcTime from,
                                                 UtcTime to, RecordingWriter& writer,
                                                 const RecordingReader::Progress& progress) {
  const recording::Summary& summary = source.summary();
  Copier copier(writer, progress, from, std::min(to, summary.end));
  if (const auto hello = source.hello()) add_hello(copier, *hello, from);
  for (const recording::Attachment& each : summary.attachments) writer.attach(each);
  for (const auto& [topic, count] : summary.items) {
    if (rule_of(topic) != EditRule::state) continue;
    const auto last = source.last_before(topic, from);
    if (last) copier.add(Item{topic, from, last->bytes});
  }
  for (const auto& [topic, count] : summary.items) {
    if (rule_of(topic) != EditRule::cumulated) continue;
    ItemCursor cursor = source.items({topic});
    while (const auto item = cursor.next()) {
      if (item->time >= from) break;
      copier.add(Item{topic, from, item->bytes});
    }
  }
  const std::uint64_t before = copier.report().items;
  ItemCursor cursor = source.items();
  cursor.seek(from);
  while (const auto item = cursor.next()) {
    if (item->time >= to) break;
    // The state at `from` itself is written, and the Hello.
    const EditRule rule = rule_of(item->topic);
    if (rule == EditRule::once || (rule == EditRule::state && item->time == from)) continue;
    copier.add(*item);
    if (!copier.go_on(item->time)) return Failure{RecordingError{summary.file, 0, "given up"}};
  }
  if (copier.report().items == before) {
    return Failure{RecordingError{
        summary.file, 0,
        fmt::format("there is nothing from {} to {}; it ends at {}",
                    playing_time_text(from - summary.begin), playing_time_text(to - summary.begin),
                    playing_time_text(summary.end - summary.begin))}};
  }
  copier.report().chunks_damaged = cursor.chunks_damaged();
  return copier.report();
}

namespace {

// One source of several, and its next item.
struct Strand {
  std::size_t source;
  ItemCursor cursor;
  std::optional<Item> item;
};

// Passes each input once that several files of one exercise repeat.
class InputSieve {
 public:
  // Whether it is new.
  bool take(std::size_t source, const Item& item) {
    recording::Input input;
    if (!input.ParseFromArray(item.bytes.data(), static_cast<int>(item.bytes.size()))) return true;
    if (input.has_began()) {
      const std::string began = input.began().SerializeAsString();
      if (!began_) began_ = began;
      if (began != *began_) foreign_.insert(source);
    }
    if (foreign_.contains(source)) return false;
    return seen_.insert(std::hash<std::string>{}(input.SerializeAsString())).second;
  }
  bool left_out_any() const { return !foreign_.empty(); }

 private:
  std::optional<std::string> began_;
  std::set<std::size_t> foreign_;
  std::set<std::size_t> seen_;  // hashes
};

}  // namespace

Result<EditReport, RecordingError> join_recordings(std::span<const RecordingReader> sources,
                                                   RecordingWriter& writer,
                                                   const RecordingReader::Progress& progress) {
  UtcTime begin = UtcTime::max(), end = UtcTime::min();
  for (const RecordingReader& source : sources) {
    begin = std::min(begin, source.summary().begin);
    end = std::max(end, source.summary().end);
  }
  RadarNumbers numbers(sources);
  Copier copier(writer, progress, begin, end);
  add_hello(copier, numbers.hello(), begin);
  std::vector<Strand> strands;
  std::set<std::pair<std::string, std::string>> attached;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (const recording::Attachment& each : sources[i].summary().attachments) {
      if (attached.insert({each.name, each.bytes}).second) writer.attach(each);
    }
    strands.push_back({i, sources[i].items(), std::nullopt});
    strands.back().item = strands.back().cursor.next();
  }
  InputSieve sieve;
  for (;;) {
    Strand* first = nullptr;
    for (Strand& each : strands) {
      if (each.item && (!first || each.item->time < first->item->time)) first = &each;
    }
    if (!first) break;
    const Item& item = *first->item;
    const EditRule rule = rule_of(item.topic);
    const bool wanted =
        rule == EditRule::cumulated ? sieve.take(first->source, item) : rule != EditRule::once;
    if (wanted) copier.add(numbers.renamed(first->source, item));
    if (!copier.go_on(item.time)) {
      return Failure{RecordingError{sources[first->source].summary().file, 0, "given up"}};
    }
    first->item = first->cursor.next();
  }
  EditReport& report = copier.report();
  report.notes = numbers.changes();
  if (sieve.left_out_any()) {
    report.notes.push_back("the recordings are of several exercises: inputs of the first are kept");
  }
  for (const Strand& each : strands) report.chunks_damaged += each.cursor.chunks_damaged();
  return report;
}

}  // namespace skerry::client
