#include "protocol/nmea/six_bit.hpp"

#include <algorithm>

namespace skerry::nmea {
namespace {

char armour(std::uint8_t six) { return static_cast<char>(six < 40 ? six + 48 : six + 56); }

std::optional<std::uint8_t> six_of(char c) {
  if (c >= '0' && c <= 'W') return static_cast<std::uint8_t>(c - 48);
  if (c >= '`' && c <= 'w') return static_cast<std::uint8_t>(c - 56);
  return std::nullopt;
}

// '@' .. '_' are 0 .. 31, ' ' .. '?' are 32 .. 63.
std::uint8_t text_six(char c) {
  if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  if (c >= '@' && c <= '_') return static_cast<std::uint8_t>(c - '@');
  if (c >= ' ' && c <= '?') return static_cast<std::uint8_t>(c);
  return static_cast<std::uint8_t>('?');
}

}  // namespace

void SixBitWriter::add(std::uint32_t value, int bits) {
  for (int bit = bits - 1; bit >= 0; --bit) {
    if (bits_ % 6 == 0) six_.push_back(0);
    if ((value >> bit & 1u) != 0) {
      six_.back() = static_cast<std::uint8_t>(six_.back() | 1u << (5 - bits_ % 6));
    }
    ++bits_;
  }
}

void SixBitWriter::add_text(std::string_view text, std::size_t characters) {
  for (std::size_t i = 0; i < characters; ++i) add(i < text.size() ? text_six(text[i]) : 0u, 6);
}

std::string SixBitWriter::armoured() const {
  std::string out;
  out.reserve(six_.size());
  for (const std::uint8_t six : six_) out += armour(six);
  return out;
}

std::optional<SixBitReader> SixBitReader::of(std::string_view armoured, unsigned fill_bits) {
  SixBitReader reader;
  reader.six_.reserve(armoured.size());
  for (const char c : armoured) {
    const auto six = six_of(c);
    if (!six) return std::nullopt;
    reader.six_.push_back(*six);
  }
  const std::size_t all = armoured.size() * 6;
  if (fill_bits > 5 || fill_bits > all) return std::nullopt;
  reader.bits_ = all - fill_bits;
  return reader;
}

std::uint32_t SixBitReader::take(int bits) {
  std::uint32_t value = 0;
  for (int i = 0; i < bits; ++i) {
    value <<= 1;
    if (at_ < bits_) {
      value |= six_[at_ / 6] >> (5 - at_ % 6) & 1u;
      ++at_;
    }
  }
  return value;
}

std::int32_t SixBitReader::take_signed(int bits) {
  const std::uint32_t value = take(bits);
  const std::uint32_t sign = 1u << (bits - 1);
  return static_cast<std::int32_t>((value ^ sign) - sign);
}

std::string SixBitReader::take_text(std::size_t characters) {
  std::string out;
  bool ended = false;
  for (std::size_t i = 0; i < characters; ++i) {
    const std::uint32_t six = take(6);
    ended = ended || six == 0;
    if (!ended) out += static_cast<char>(six < 32 ? six + '@' : six);
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace skerry::nmea
