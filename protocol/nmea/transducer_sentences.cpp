#include "protocol/nmea/transducer_sentences.hpp"

#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr Range kMeasured{-99'999'999.99, 99'999'999.99};
constexpr std::size_t kFieldsEach = 4, kMostTransducerName = 15;
// ",A,-99999999.99,D," and the name.
constexpr std::size_t kLongestTransducer = 18 + kMostTransducerName;

}  // namespace

Transducer roll_transducer(double roll_deg) {
  return {.type = 'A', .value = roll_deg, .unit = 'D', .name = "ROLL"};
}

std::vector<std::string> encode_xdr(std::span<const Transducer> transducers,
                                    std::string_view talker) {
  std::vector<std::string> lines;
  while (!transducers.empty()) {
    SentenceWriter out('$', talker, "XDR");
    do {
      const Transducer& one = transducers.front();
      add_number(out.letter(one.type), one.value, 2, kMeasured);
      out.letter(one.unit).text(one.name, kMostTransducerName);
      transducers = transducers.subspan(1);
    } while (!transducers.empty() && out.room(0) >= kLongestTransducer);
    lines.push_back(out.finish());
  }
  return lines;
}

Result<std::vector<Transducer>, WireError> decode_xdr(const Sentence& sentence) {
  FieldReader in(sentence);
  std::vector<Transducer> transducers;
  const std::size_t fields = sentence.fields.size();
  if (fields == 0 || fields % kFieldsEach != 0) {
    in.fail(fields, "four fields for each transducer");
  }
  for (std::size_t at = 0; at + kFieldsEach <= fields; at += kFieldsEach) {
    transducers.push_back({.type = in.letter(at),
                           .value = read_number(in, at + 1, kMeasured),
                           .unit = in.letter(at + 2),
                           .name = std::string(in.text(at + 3))});
  }
  return answer(in, std::move(transducers));
}

}  // namespace skerry::nmea
