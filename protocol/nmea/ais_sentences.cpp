#include "protocol/nmea/ais_sentences.hpp"

#include <algorithm>
#include <utility>

#include "protocol/nmea/field_reader.hpp"

namespace skerry::nmea {

std::vector<std::string> encode_ais(const AisMessage& message, bool own, unsigned identifier,
                                    char channel) {
  const SixBitWriter bits = encode(message);
  const std::string payload = bits.armoured();
  const std::size_t total = (payload.size() + kAisPayload - 1) / kAisPayload;
  std::vector<std::string> lines;
  for (std::size_t number = 1; number <= total; ++number) {
    SentenceWriter out('!', "AI", own ? "VDO" : "VDM");
    out.whole(total).whole(number);
    if (total > 1) {
      out.whole(identifier % 10);
    } else {
      out.empty();
    }
    out.letter(own ? '\0' : channel);
    out.text(std::string_view(payload).substr((number - 1) * kAisPayload, kAisPayload));
    out.whole(number == total ? static_cast<unsigned>(bits.fill_bits()) : 0u);
    lines.push_back(out.finish());
  }
  return lines;
}

Result<std::optional<HeardAis>, WireError> AisAssembler::feed(const Sentence& sentence) {
  FieldReader in(sentence);
  const unsigned total = in.whole(0, 1, kMostParts).value_or(0);
  const unsigned number = in.whole(1, 1, kMostParts).value_or(0);
  const unsigned identifier = in.whole(2, 0, 9).value_or(0);
  const unsigned fill = in.whole(5, 0, 5).value_or(0);
  if (total == 0) in.fail(0, "how many sentences");
  if (number == 0 || number > total) in.fail(1, "which sentence of them");
  if (in.error()) return Failure{*in.error()};

  std::string payload(in.text(4));
  if (total > 1) {
    Begun& begun = begun_[identifier];
    const bool continues = begun.next == number && begun.total == total;
    if (begun.next != 0 && !continues) ++given_up_;
    if (number == 1) begun = {.total = total, .next = 1, .payload = {}};
    if (begun.next != number || begun.total != total) {
      begun = {};
      return Failure{WireError{WireErrorKind::truncated, 0, kNoBeginning}};
    }
    begun.payload += payload;
    ++begun.next;
    if (number < total) return std::optional<HeardAis>{};
    payload = std::exchange(begun, {}).payload;
  }
  auto bits = SixBitReader::of(payload, fill);
  if (!bits) {
    in.fail(4, "six-bit characters");
    return Failure{*in.error()};
  }
  auto message = decode_ais(std::move(*bits));
  if (!message) return Failure{message.error()};
  return std::optional(HeardAis{std::move(message).value(), sentence.formatter == "VDO"});
}

std::size_t AisAssembler::pending() const {
  return static_cast<std::size_t>(std::count_if(
      begun_.begin(), begun_.end(), [](const Begun& begun) { return begun.next != 0; }));
}

}  // namespace skerry::nmea
