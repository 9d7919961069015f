#include "protocol/nmea/tracked_target_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/six_bit.hpp"

namespace skerry::nmea {
namespace {

constexpr std::size_t kTargetBits = 90, kMostSentences = 255;
constexpr std::uint32_t kNoAngle = 4095, kNoTargetSpeed = 4095, kNoRange = 16383;

std::uint32_t tenths_bits(std::optional<double> degrees) {
  if (!degrees || !std::isfinite(*degrees)) return kNoAngle;
  double tenths = std::fmod(std::round(*degrees * 10.0), 3600.0);
  if (tenths < 0) tenths += 3600.0;
  return static_cast<std::uint32_t>(tenths);
}

std::uint32_t amount_bits(std::optional<double> amount, double scale, std::uint32_t none) {
  if (!amount || !(*amount >= 0.0) || *amount * scale >= none - 1) return none;
  return static_cast<std::uint32_t>(std::lround(*amount * scale));
}

std::optional<double> angle_of(std::uint32_t bits) {
  if (bits >= 3600) return std::nullopt;
  return bits / 10.0;
}

std::optional<double> amount_of(std::uint32_t bits, double scale, std::uint32_t none) {
  if (bits == none) return std::nullopt;
  return bits / scale;
}

void add(SixBitWriter& out, const TtdTarget& target) {
  out.add(0, 2);
  out.add(target.number, 10);
  out.add(tenths_bits(target.bearing_deg), 12);
  out.add(amount_bits(target.speed_kn, 10.0, kNoTargetSpeed), 12);
  out.add(tenths_bits(target.course_deg), 12);
  out.add(tenths_bits(target.heading_deg), 12);
  out.add(static_cast<std::uint32_t>(target.status), 3);
  out.add(0, 1);
  out.add(amount_bits(target.range_nm, 100.0, kNoRange), 14);
  out.add(0, 1);  // true speed
  out.add(0, 1);  // over ground
  out.add(0, 2);
  out.add(0, 8);
}

TtdTarget take(SixBitReader& in) {
  TtdTarget target;
  in.skip(2);
  target.number = in.take(10);
  target.bearing_deg = angle_of(in.take(12));
  target.speed_kn = amount_of(in.take(12), 10.0, kNoTargetSpeed);
  target.course_deg = angle_of(in.take(12));
  target.heading_deg = angle_of(in.take(12));
  target.status = static_cast<TtdStatus>(in.take(3));
  in.skip(1);
  target.range_nm = amount_of(in.take(14), 100.0, kNoRange);
  in.skip(12);
  return target;
}

}  // namespace

std::vector<std::string> encode_ttd(std::span<const TtdTarget> targets, unsigned identifier,
                                    std::string_view talker) {
  targets = targets.first(std::min(targets.size(), kMostSentences * kTtdTargetsPerSentence));
  const std::size_t total = (targets.size() + kTtdTargetsPerSentence - 1) / kTtdTargetsPerSentence;
  std::vector<std::string> lines;
  for (std::size_t number = 1; number <= total; ++number) {
    const auto mine = targets.first(std::min(targets.size(), kTtdTargetsPerSentence));
    targets = targets.subspan(mine.size());
    SixBitWriter bits;
    for (const TtdTarget& target : mine) add(bits, target);
    SentenceWriter out('!', talker, "TTD");
    out.text(fmt::format("{:02X}", total)).text(fmt::format("{:02X}", number));
    out.whole(identifier % 10).text(bits.armoured());
    lines.push_back(out.whole(static_cast<unsigned>(bits.fill_bits())).finish());
  }
  return lines;
}

Result<std::vector<TtdTarget>, WireError> decode_ttd(const Sentence& sentence) {
  FieldReader in(sentence);
  std::vector<TtdTarget> targets;
  const auto fill = in.whole(4, 0, 5);
  auto bits = SixBitReader::of(in.text(3), fill.value_or(0));
  if (!bits) {
    in.fail(3, "six-bit characters");
  } else if (bits->bits() % kTargetBits != 0) {
    in.fail(3, fmt::format("targets of {} bits", kTargetBits));
  } else {
    while (bits->left() > 0) targets.push_back(take(*bits));
  }
  return answer(in, std::move(targets));
}

}  // namespace skerry::nmea
