#include "server/traffic_logs/nmea_log.hpp"

#include <algorithm>
#include <optional>
#include <variant>

#include "protocol/nmea/log_line.hpp"
#include "protocol/nmea/log_time.hpp"
#include "protocol/nmea/position_sentences.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kBaseStationReport = 4, kAircraftReport = 9;

std::uint32_t message_type_of(std::string_view payload) {
  const auto bits = nmea::SixBitReader::of(payload.substr(0, 1), 0);
  return bits ? nmea::SixBitReader(*bits).take(6) : 0;
}

LeftOut kind_of(const WireError& error) {
  switch (error.kind) {
    case WireErrorKind::oversized:
      return LeftOut::too_long;
    case WireErrorKind::truncated:
      return LeftOut::cut_short;
    default:
      return LeftOut::bad_checksum;
  }
}

bool is_plausible(const std::optional<UtcTime>& utc) {
  return utc && *utc >= nmea::kFirstLogTime && *utc < nmea::kAfterLogTimes;
}

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

HeardIdentity identity_of(std::uint32_t mmsi, const nmea::AisSize& size) {
  HeardIdentity identity{.mmsi = mmsi};
  identity.length_m = size.to_bow_m + size.to_stern_m;
  identity.beam_m = size.to_port_m + size.to_starboard_m;
  return identity;
}

}  // namespace

NmeaLog::Source& NmeaLog::source_of(std::string_view name) {
  const auto found = sources_.find(name);
  if (found != sources_.end()) return found->second;
  return sources_[sources_.size() < kMostSources ? std::string(name) : std::string()];
}

void NmeaLog::take(std::string_view line, std::optional<UtcTime> heard) {
  if (is_blank(line)) return;
  LeftOutCounts& left_out = book_.left_out();
  const auto read = nmea::parse_log_line(line);
  if (!read) {
    return left_out.add(read.error().kind == WireErrorKind::unknown_kind ? LeftOut::no_sentence
                                                                         : kind_of(read.error()));
  }
  const auto sentence = nmea::parse_sentence(read->sentence);
  if (!sentence) return left_out.add(kind_of(sentence.error()));
  const auto utc = read->utc ? read->utc : heard ? heard : clock_;
  if (sentence->formatter == "VDM" || sentence->formatter == "VDO") {
    return take_vdm(*sentence, source_of(read->source), utc);
  }
  left_out.add(LeftOut::other_sentence);
  if (sentence->formatter == "ZDA") {
    if (const auto zda = nmea::decode_zda(*sentence); zda && is_plausible(zda->utc))
      clock_ = zda->utc;
  } else if (sentence->formatter == "RMC") {
    if (const auto rmc = nmea::decode_rmc(*sentence); rmc && rmc->valid && is_plausible(rmc->utc))
      clock_ = rmc->utc;
  }
}

void NmeaLog::take_vdm(const nmea::Sentence& sentence, Source& source, std::optional<UtcTime> utc) {
  LeftOutCounts& left_out = book_.left_out();
  const auto heard = source.assembler.feed(sentence);
  left_out.add(LeftOut::incomplete, source.assembler.given_up() - source.given_up);
  source.given_up = source.assembler.given_up();
  if (!heard) {
    const WireError& error = heard.error();
    if (error.text == nmea::AisAssembler::kNoBeginning) return left_out.add(LeftOut::incomplete);
    if (error.kind != WireErrorKind::unknown_kind) return left_out.add(LeftOut::malformed);
    // Reports of base stations and aircraft are of one sentence.
    const bool alone = sentence.fields.size() > 4 && sentence.fields[0] == "1";
    const std::uint32_t type = alone ? message_type_of(sentence.fields[4]) : 0;
    return left_out.add(type == kBaseStationReport ? LeftOut::base_station
                        : type == kAircraftReport  ? LeftOut::aircraft
                                                   : LeftOut::unknown_type);
  }
  // From here on the sentence has its fields.
  const bool several = sentence.fields[0] != "1";
  if (several && sentence.fields[1] == "1") source.begun = utc;
  if (several && source.begun) utc = source.begun;
  if (!heard->has_value()) return;
  sentences_ += several ? static_cast<std::uint64_t>(sentence.fields[0][0] - '0') : 1;
  take((*heard)->message, utc);
}

void NmeaLog::take(const nmea::AisPosition& report, std::optional<UtcTime> utc) {
  book_.take(HeardFix{.mmsi = report.mmsi,
                      .utc = utc,
                      .position = report.position,
                      .heading_deg = report.heading_deg,
                      .course_deg = report.course_deg,
                      .class_b = report.class_b});
}

void NmeaLog::take(const nmea::AisMessage& message, std::optional<UtcTime> utc) {
  if (const auto* report = std::get_if<nmea::AisPosition>(&message)) return take(*report, utc);
  if (std::holds_alternative<nmea::AisAid>(message)) return book_.left_out().add(LeftOut::aid);
  if (const auto* voyage = std::get_if<nmea::AisVoyage>(&message)) {
    HeardIdentity identity = identity_of(voyage->mmsi, voyage->size);
    identity.name = voyage->name;
    identity.ship_type = voyage->ship_type;
    identity.class_b = false;
    return book_.take(identity);
  }
  if (const auto* said = std::get_if<nmea::AisStatic>(&message)) {
    // A craft of a mother ship (98...) tells that ship's number in place of its size.
    const bool sized = said->part_b && said->mmsi / 10'000'000 != 98;
    HeardIdentity identity = identity_of(said->mmsi, sized ? said->size : nmea::AisSize{});
    identity.name = said->name;
    identity.ship_type = said->ship_type;
    return book_.take(identity);
  }
  const auto& extended = std::get<nmea::AisExtended>(message);
  HeardIdentity identity = identity_of(extended.position.mmsi, extended.size);
  identity.name = extended.name;
  identity.ship_type = extended.ship_type;
  book_.take(identity);
  take(extended.position, utc);
}

void NmeaLog::finish() {
  for (const auto& [name, source] : sources_) {
    book_.left_out().add(LeftOut::incomplete, source.assembler.pending());
  }
  sources_.clear();
}

}  // namespace skerry::server
