#include "protocol/nmea/depth_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr Range kDepth{0.0, 12'000.0};
constexpr Range kTransducerOffset{-100.0, 100.0};
constexpr double kMetresPerFoot = 0.3048;  // exactly
constexpr double kMetresPerFathom = 6.0 * kMetresPerFoot;

std::optional<double> depth_in(FieldReader& in, std::size_t index, char unit, double metres) {
  const auto value = in.number_in(index, unit, kDepth.min, kDepth.max / metres + 1.0);
  if (!value) return std::nullopt;
  return std::min(*value * metres, kDepth.max);
}

}  // namespace

std::string encode(const Dpt& dpt, std::string_view talker) {
  SentenceWriter out('$', talker, "DPT");
  add_number(out, dpt.depth_m, 1, kDepth);
  add_number(out, dpt.offset_m, 1, kTransducerOffset);
  return add_number(out, dpt.range_m, 1, kDepth).finish();
}

Result<Dpt, WireError> decode_dpt(const Sentence& sentence) {
  FieldReader in(sentence);
  Dpt dpt;
  dpt.depth_m = read_number(in, 0, kDepth);
  dpt.offset_m = read_number(in, 1, kTransducerOffset);
  dpt.range_m = read_number(in, 2, kDepth);
  return answer(in, dpt);
}

std::string encode(const Dbt& dbt, std::string_view talker) {
  SentenceWriter out('$', talker, "DBT");
  const auto depth = within(dbt.depth_m, kDepth);
  const auto add = [&](double metres, char unit) {
    if (depth) {
      out.number(*depth / metres, 1).letter(unit);
    } else {
      out.empty().letter(unit);
    }
  };
  add(kMetresPerFoot, 'f');
  add(1.0, 'M');
  add(kMetresPerFathom, 'F');
  return out.finish();
}

Result<Dbt, WireError> decode_dbt(const Sentence& sentence) {
  FieldReader in(sentence);
  const auto feet = depth_in(in, 0, 'f', kMetresPerFoot);
  const auto metres = depth_in(in, 2, 'M', 1.0);
  const auto fathoms = depth_in(in, 4, 'F', kMetresPerFathom);
  return answer(in, Dbt{metres ? metres : feet ? feet : fathoms});
}

}  // namespace skerry::nmea
