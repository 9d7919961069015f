// Readers of NMEA 0183 and IEC 61162-450, the listener that obeys them, and the way there and back
// of AIS messages made from the input.
#include "protocol/nmea/ais_sentences.hpp"
#include "protocol/nmea/alert_sentences.hpp"
#include "protocol/nmea/con_command.hpp"
#include "protocol/nmea/depth_sentences.hpp"
#include "protocol/nmea/engine_sentences.hpp"
#include "protocol/nmea/gnss_sentences.hpp"
#include "protocol/nmea/heading_control_sentences.hpp"
#include "protocol/nmea/log_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/rudder_sentences.hpp"
#include "protocol/nmea/thruster_sentences.hpp"
#include "protocol/nmea/track_sentences.hpp"
#include "protocol/nmea/tracked_target_data.hpp"
#include "protocol/nmea/transducer_sentences.hpp"
#include "protocol/nmea/udp450.hpp"
#include "protocol/nmea/waypoint_sentences.hpp"
#include "protocol/nmea/wind_sentences.hpp"
#include "server/navigation/navigation_listener.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

template <typename T>
void check(const Result<T, WireError>& result, std::size_t most) {
  if (result) return;
  fuzz::require(!result.error().text.empty(), "a refusal says why");
  fuzz::require(result.error().offset <= most, "a refusal's place is in the line");
}

// What was read can be written within the standard's length, and read back.  Once rounded it stays
// the same.
template <typename Decode>
void check_reader(Decode decode, const nmea::Sentence& sentence, std::size_t size) {
  const auto written = [&](const auto& value) {
    const std::string line = encode(value, "II");
    fuzz::require(line.size() <= nmea::kMaxSentence, "a line is as long as it may be");
    return line;
  };
  const auto reread = [&](const std::string& line) {
    const auto again = nmea::parse_sentence(line);
    fuzz::require(again.ok(), "our own line is a sentence");
    auto back = decode(*again);
    fuzz::require(back.ok(), "and is understood");
    return back;
  };
  const auto value = decode(sentence);
  check(value, size);
  if (!value) return;
  const std::string rounded = written(*reread(written(*value)));
  fuzz::require(written(*reread(rounded)) == rounded, "it comes back the same");
}

void check_transducers(const nmea::Sentence& sentence, std::size_t size) {
  const auto transducers = nmea::decode_xdr(sentence);
  check(transducers, size);
  if (!transducers) return;
  fuzz::require(transducers->size() <= size, "transducers are bounded by the line");
  std::size_t back = 0;
  for (const std::string& line : nmea::encode_xdr(*transducers)) {
    fuzz::require(line.size() <= nmea::kMaxSentence, "a line is as long as it may be");
    const auto read = nmea::decode_xdr(*nmea::parse_sentence(line));
    fuzz::require(read.ok(), "our own transducers are understood");
    back += read->size();
  }
  fuzz::require(back == transducers->size(), "and all of them");
}

// What comes back of the parts of a list.
template <typename Decode>
auto lines_read(const std::vector<std::string>& lines, Decode decode) {
  std::vector<std::decay_t<decltype(*decode(nmea::Sentence{}))>> parts;
  for (const std::string& line : lines) {
    fuzz::require(line.size() <= nmea::kMaxSentence, "a line is as long as it may be");
    const auto sentence = nmea::parse_sentence(line);
    fuzz::require(sentence.ok(), "our own line is a sentence");
    auto part = decode(*sentence);
    fuzz::require(part.ok(), "our own list is understood");
    parts.push_back(std::move(*part));
  }
  return parts;
}

void check_lists(const nmea::Sentence& sentence, std::size_t size) {
  const auto labels = nmea::decode_tlb(sentence);
  check(labels, size);
  if (labels) {
    std::size_t back = 0;
    for (const auto& part : lines_read(nmea::encode_tlb(*labels), nmea::decode_tlb)) {
      back += part.size();
    }
    fuzz::require(back == labels->size() && back <= size, "and all of the labels");
  }
  const auto alerts = nmea::decode_alc(sentence);
  check(alerts, size);
  if (alerts) {
    std::size_t back = 0;
    for (const auto& part :
         lines_read(nmea::encode_alc(alerts->entries, alerts->sequence), nmea::decode_alc)) {
      back += part.entries.size();
    }
    fuzz::require(back == alerts->entries.size() && back <= size, "and all of the alerts");
  }
}

void check_in(std::optional<double> value, double least, double most) {
  fuzz::require(!value || (*value >= least && *value <= most), "a command in its range");
}

void check_command(const nmea::Sentence& sentence, std::size_t size) {
  const auto command = nmea::decode_con_command(sentence);
  check(command, size);
  if (!command) return;
  check_in(command->rudder_deg, -90, 90);
  check_in(command->rudder_limit_deg, 0, 90);
  for (const auto& angle : {command->heading_deg, command->track_deg}) {
    check_in(angle, 0, 360);
    fuzz::require(angle != 360.0, "north is 0");
  }
  check_in(command->turn_radius_nm, 0, 100);
  check_in(command->turn_rate_deg_min, 0, 1000);
  check_in(command->revolutions, -10'000, 10'000);
  for (const auto& percent : {command->lever_percent, command->pitch_percent,
                              command->bow_thruster_percent, command->stern_thruster_percent}) {
    check_in(percent, -100, 100);
  }
  fuzz::require(!command->shaft || *command->shaft <= 99, "a shaft");
}

// The command of a sentence of another name, so that each reader is reached.
void check_commands(nmea::Sentence sentence, std::size_t size) {
  check_command(sentence, size);
  for (const char* name : {"HTC", "HSC", "ROR", "PRC", "ETL", "TRC"}) {
    sentence.formatter = name;
    check_command(sentence, size);
  }
}

// Every reader, whatever the sentence calls itself.
void check_readers(const nmea::Sentence& sentence, std::size_t size) {
  check_reader(nmea::decode_rmc, sentence, size);
  check_reader(nmea::decode_gga, sentence, size);
  check_reader(nmea::decode_gll, sentence, size);
  check_reader(nmea::decode_vtg, sentence, size);
  check_reader(nmea::decode_zda, sentence, size);
  check_reader(nmea::decode_hdt, sentence, size);
  check_reader(nmea::decode_ths, sentence, size);
  check_reader(nmea::decode_hdg, sentence, size);
  check_reader(nmea::decode_rot, sentence, size);
  check_reader(nmea::decode_vhw, sentence, size);
  check_reader(nmea::decode_vbw, sentence, size);
  check_reader(nmea::decode_rsa, sentence, size);
  check_reader(nmea::decode_ror, sentence, size);
  check_reader(nmea::decode_rpm, sentence, size);
  check_reader(nmea::decode_prc, sentence, size);
  check_reader(nmea::decode_etl, sentence, size);
  check_reader(nmea::decode_trc, sentence, size);
  check_reader(nmea::decode_trd, sentence, size);
  check_reader(nmea::decode_htc, sentence, size);
  check_reader(nmea::decode_htd, sentence, size);
  check_reader(nmea::decode_hsc, sentence, size);
  check_reader(nmea::decode_vlw, sentence, size);
  check_reader(nmea::decode_vdr, sentence, size);
  check_reader(nmea::decode_dpt, sentence, size);
  check_reader(nmea::decode_dbt, sentence, size);
  check_reader(nmea::decode_mwv, sentence, size);
  check_reader(nmea::decode_mwd, sentence, size);
  check_reader(nmea::decode_gns, sentence, size);
  check_reader(nmea::decode_dtm, sentence, size);
  check_reader(nmea::decode_xte, sentence, size);
  check_reader(nmea::decode_apb, sentence, size);
  check_reader(nmea::decode_rmb, sentence, size);
  check_reader(nmea::decode_bwc, sentence, size);
  check_reader(nmea::decode_bod, sentence, size);
  check(nmea::decode_rsd(sentence), size);
  check(nmea::decode_osd(sentence), size);
  check_reader(nmea::decode_ttm, sentence, size);
  check_reader(nmea::decode_tll, sentence, size);
  check_reader(nmea::decode_alf, sentence, size);
  check_reader(nmea::decode_acn, sentence, size);
  check_reader(nmea::decode_arc, sentence, size);
  check_reader(nmea::decode_alr, sentence, size);
  check_reader(nmea::decode_ack, sentence, size);
  check_reader(nmea::decode_hbt, sentence, size);
  check_lists(sentence, size);
  const auto targets = nmea::decode_ttd(sentence);
  check(targets, size);
  if (targets) fuzz::require(targets->size() <= size / 15, "targets are bounded by the line");
  check_transducers(sentence, size);
  check_commands(sentence, size);
}

void check_position(const std::optional<GeoPoint>& point) {
  if (!point) return;
  fuzz::require(point->latitude_deg >= -90 && point->latitude_deg <= 90, "a latitude");
  fuzz::require(point->longitude_deg >= -180 && point->longitude_deg < 180, "a longitude");
}

// Lines as they are, and with their checksum put right: otherwise few would be read any further.
void check_lines(std::string_view text, server::NavigationListener& listener,
                 nmea::AisAssembler& assembler) {
  int time = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string between = line.substr(line.empty() ? 0 : 1, line.find('*') - 1);
    const std::string good =
        (line.empty() ? '$' : line[0]) + between + "*" + nmea::checksum_text(between);
    for (const std::string& one : {line, good}) {
      const auto sentence = nmea::parse_sentence(one);
      check(sentence, one.size());
      if (sentence) {
        check_readers(*sentence, one.size());
        check(assembler.feed(*sentence), one.size());
      }
      const auto heard = listener.hear(one, ScenarioTime(std::chrono::milliseconds(700) * ++time));
      fuzz::require(heard.fault.empty() || !heard.fix, "what cannot be read moves nothing");
      if (!heard.fix) continue;
      check_position(heard.fix->position);
      fuzz::require(!heard.fix->speed_mps ||
                        (*heard.fix->speed_mps >= 0 &&
                         *heard.fix->speed_mps <= server::NavigationListener::kMostSpeedMps),
                    "a ship's speed");
      for (const auto& angle : {heard.fix->heading_deg, heard.fix->course_over_ground_deg}) {
        fuzz::require(!angle || (*angle >= 0 && *angle < 360), "an angle");
      }
    }
  }
}

void check_ais(std::span<const std::uint8_t> input) {
  fuzz::Choices choices(input);
  nmea::AisVoyage voyage;
  voyage.mmsi = static_cast<std::uint32_t>(choices.below(1'000'000'000));
  voyage.name.assign(input.begin(), input.begin() + std::min<std::size_t>(input.size(), 20));
  voyage.size = nmea::ais_size(static_cast<double>(choices.below(2000)), 30);
  nmea::AisAssembler assembler;
  std::optional<nmea::HeardAis> heard;
  for (const std::string& line : nmea::encode_ais(voyage, false, 3, 'A')) {
    fuzz::require(line.size() <= nmea::kMaxSentence, "a line is as long as it may be");
    const auto sentence = nmea::parse_sentence(line);
    fuzz::require(sentence.ok(), "our own line is read");
    const auto result = assembler.feed(*sentence);
    fuzz::require(result.ok(), "and understood");
    heard = *result;
  }
  fuzz::require(heard.has_value(), "the last line ends the message");
  const auto* back = std::get_if<nmea::AisVoyage>(&heard->message);
  fuzz::require(back != nullptr && back->mmsi == voyage.mmsi && back->size == voyage.size,
                "it comes back the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  server::NavigationListener listener(std::chrono::seconds(10));
  nmea::AisAssembler assembler;
  check_lines({reinterpret_cast<const char*>(data), size}, listener, assembler);
  const auto lines = nmea::decode_udp450(input);
  check(lines, size);
  if (lines) {
    std::size_t bytes = 0;
    for (const nmea::TaggedLine& line : *lines) bytes += line.sentence.size() + line.source.size();
    fuzz::require(bytes <= size && lines->size() <= size, "the output is bounded by the input");
  }
  check_ais(input);
  return 0;
}
