#include "protocol/nmea/alert_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr std::size_t kManufacturerLetters = 3, kEntryFields = 4, kMostAlcSentences = 99;
constexpr unsigned kMostAlarmNumber = 999;
constexpr Range kHeartbeat{1.0, 999.0};  // s

// A whole number, or an empty field if it is out of range.
SentenceWriter& add_whole(SentenceWriter& out, std::optional<unsigned> value, unsigned most,
                          int digits = 1) {
  return value && *value <= most ? out.whole(*value, digits) : out.empty();
}

// A field without which the sentence says nothing.
unsigned needed_whole(FieldReader& in, std::size_t index, unsigned min, unsigned max) {
  const auto value = in.whole(index, min, max);
  if (!value) in.fail(index, fmt::format("a whole number from {} to {}", min, max));
  return value.value_or(min);
}

// Three fields.
SentenceWriter& add_key(SentenceWriter& out, const AlertKey& key) {
  out.text(key.manufacturer, kManufacturerLetters);
  add_whole(out, key.identifier, kMostAlertIdentifier);
  return add_whole(out, key.instance, kMostAlertInstance);
}

AlertKey read_key(FieldReader& in, std::size_t index) {
  AlertKey key;
  key.manufacturer = in.text(index);
  if (key.manufacturer.size() > kManufacturerLetters) in.fail(index, "at most three letters");
  key.identifier = needed_whole(in, index + 1, 0, kMostAlertIdentifier);
  key.instance = in.whole(index + 2, 0, kMostAlertInstance);
  return key;
}

SentenceWriter& add_revision(SentenceWriter& out, unsigned revision) {
  return out.whole(std::clamp(revision, 1u, kMostAlertRevision));
}

// Some equipment begins at 0.
unsigned read_revision(FieldReader& in, std::size_t index) {
  return needed_whole(in, index, 0, kMostAlertRevision);
}

AlertCommand read_command(FieldReader& in, std::size_t index) {
  const auto command = read_enum<AlertCommand>(in, index, "AQOS");
  if (!command) in.fail(index, "one of the letters AQOS");
  return command.value_or(AlertCommand::request);
}

std::string alc_line(const Alc& alc, std::string_view talker) {
  SentenceWriter out('$', talker, "ALC");
  out.whole(alc.total, 2).whole(alc.number, 2).whole(alc.sequence % 100, 2);
  out.whole(alc.entries.size());
  for (const AlertEntry& entry : alc.entries) add_revision(add_key(out, entry.key), entry.revision);
  return out.finish();
}

// Total, number and sequence, the first three fields of ALF and ALC.
template <typename Part>
void read_part(FieldReader& in, Part& part, unsigned most_total, unsigned most_sequence) {
  part.total = needed_whole(in, 0, 1, most_total);
  part.number = needed_whole(in, 1, 1, part.total);
  part.sequence = needed_whole(in, 2, 0, most_sequence);
}

}  // namespace

std::string encode(const Alf& alf, std::string_view talker) {
  SentenceWriter out('$', talker, "ALF");
  out.whole(std::clamp(alf.total, 1u, 2u)).whole(std::clamp(alf.number, 1u, 2u));
  out.whole(alf.sequence % 10);
  optional_time(out, alf.time_of_change);
  add_enum(out, alf.category);
  add_enum(out, alf.priority);
  add_enum(out, alf.state);
  add_revision(add_key(out, alf.key), alf.revision);
  out.whole(std::min(alf.escalation, kMostAlertEscalation));
  return out.text(alf.text, out.room(0)).finish();
}

Result<Alf, WireError> decode_alf(const Sentence& sentence) {
  FieldReader in(sentence);
  Alf alf;
  read_part(in, alf, 2, 9);
  alf.time_of_change = in.time(3);
  alf.category = read_enum<AlertCategory>(in, 4, "ABC");
  alf.priority = read_enum<AlertPriority>(in, 5, "EAWC");
  alf.state = read_enum<AlertState>(in, 6, "VSAOUN");
  alf.key = read_key(in, 7);
  alf.revision = read_revision(in, 10);
  alf.escalation = needed_whole(in, 11, 0, kMostAlertEscalation);
  alf.text = in.text(12);
  return answer(in, std::move(alf));
}

std::vector<std::string> encode_alert(const Alert& alert, unsigned sequence,
                                      std::string_view talker) {
  Alf alf{.total = alert.description.empty() ? 1u : 2u,
          .sequence = sequence,
          .time_of_change = alert.time_of_change,
          .category = alert.category,
          .priority = alert.priority,
          .state = alert.state,
          .key = alert.key,
          .revision = alert.revision,
          .escalation = alert.escalation,
          .text = alert.title.substr(0, kMostAlertTitle)};
  std::vector<std::string> lines{encode(alf, talker)};
  if (alf.total == 1) return lines;
  lines.push_back(encode(Alf{.total = 2,
                             .number = 2,
                             .sequence = sequence,
                             .key = alert.key,
                             .revision = alert.revision,
                             .escalation = alert.escalation,
                             .text = alert.description},
                         talker));
  return lines;
}

std::vector<std::string> encode_alc(std::span<const AlertEntry> entries, unsigned sequence,
                                    std::string_view talker) {
  std::vector<Alc> parts{{.sequence = sequence}};
  for (const AlertEntry& entry : entries) {
    parts.back().entries.push_back(entry);
    if (alc_line(parts.back(), talker).size() <= kMaxSentence) continue;
    parts.back().entries.pop_back();
    if (parts.size() == kMostAlcSentences) break;
    parts.push_back({.sequence = sequence, .entries = {entry}});
  }
  std::vector<std::string> lines;
  for (Alc& part : parts) {
    part.total = static_cast<unsigned>(parts.size());
    part.number = static_cast<unsigned>(lines.size() + 1);
    lines.push_back(alc_line(part, talker));
  }
  return lines;
}

Result<Alc, WireError> decode_alc(const Sentence& sentence) {
  FieldReader in(sentence);
  Alc alc;
  read_part(in, alc, kMostAlcSentences, 99);
  // No sentence that is read has room for so many.
  const unsigned count = needed_whole(in, 3, 0, kMaxReadSentence / kEntryFields);
  for (std::size_t at = 4; !in.error() && alc.entries.size() < count; at += kEntryFields) {
    alc.entries.push_back({read_key(in, at), read_revision(in, at + 3)});
  }
  return answer(in, std::move(alc));
}

std::string encode(const Acn& acn, std::string_view talker) {
  SentenceWriter out('$', talker, "ACN");
  optional_time(out, acn.time_of_day);
  return add_key(out, acn.key).letter(static_cast<char>(acn.command)).letter('C').finish();
}

Result<Acn, WireError> decode_acn(const Sentence& sentence) {
  FieldReader in(sentence);
  Acn acn;
  acn.time_of_day = in.time(0);
  acn.key = read_key(in, 1);
  acn.command = read_command(in, 4);
  if (in.letter(5) != 'C') in.fail(5, "C for a command");
  return answer(in, std::move(acn));
}

std::string encode(const Arc& arc, std::string_view talker) {
  SentenceWriter out('$', talker, "ARC");
  optional_time(out, arc.time_of_day);
  return add_key(out, arc.key).letter(static_cast<char>(arc.refused)).finish();
}

Result<Arc, WireError> decode_arc(const Sentence& sentence) {
  FieldReader in(sentence);
  Arc arc;
  arc.time_of_day = in.time(0);
  arc.key = read_key(in, 1);
  arc.refused = read_command(in, 4);
  return answer(in, std::move(arc));
}

std::string encode(const Alr& alr, std::string_view talker) {
  SentenceWriter out('$', talker, "ALR");
  optional_time(out, alr.time_of_change);
  add_whole(out, alr.number, kMostAlarmNumber, 3);
  add_status(add_status(out, alr.is_exceeded), alr.is_acknowledged);
  return out.text(alr.text, out.room(0)).finish();
}

Result<Alr, WireError> decode_alr(const Sentence& sentence) {
  FieldReader in(sentence);
  Alr alr;
  alr.time_of_change = in.time(0);
  alr.number = needed_whole(in, 1, 0, kMostAlarmNumber);
  alr.is_exceeded = read_status(in, 2);
  alr.is_acknowledged = read_status(in, 3);
  alr.text = in.text(4);
  return answer(in, std::move(alr));
}

std::string encode(const Ack& ack, std::string_view talker) {
  SentenceWriter out('$', talker, "ACK");
  return add_whole(out, ack.number, kMostAlarmNumber, 3).finish();
}

Result<Ack, WireError> decode_ack(const Sentence& sentence) {
  FieldReader in(sentence);
  const Ack ack{needed_whole(in, 0, 0, kMostAlarmNumber)};
  return answer(in, ack);
}

std::string encode(const Hbt& hbt, std::string_view talker) {
  SentenceWriter out('$', talker, "HBT");
  add_status(add_number(out, hbt.interval_s, 1, kHeartbeat), hbt.is_well);
  return out.whole(hbt.sequence % 10).finish();
}

Result<Hbt, WireError> decode_hbt(const Sentence& sentence) {
  FieldReader in(sentence);
  Hbt hbt;
  hbt.interval_s = read_number(in, 0, kHeartbeat);
  hbt.is_well = read_status(in, 1);
  hbt.sequence = needed_whole(in, 2, 0, 9);
  return answer(in, hbt);
}

}  // namespace skerry::nmea
