// Six-bit payloads: bit fields packed from the highest bit on, six bits to a printable character.
// Source: IEC 61162-1:2010 7.2.2.8 (valid characters), ITU-R M.1371-5 annex 8 table 47 (text).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::nmea {

class SixBitWriter {
 public:
  // The `bits` lowest of value, 1 .. 32.
  void add(std::uint32_t value, int bits);
  void add_signed(std::int32_t value, int bits) { add(static_cast<std::uint32_t>(value), bits); }
  // Six bits a character: capitals, digits and what else lies in ' ' .. '_'; small letters become
  // capitals, all else '?'.  Filled with '@'.
  void add_text(std::string_view text, std::size_t characters);

  std::size_t bits() const { return bits_; }
  // With zeros up to whole characters.
  std::string armoured() const;
  int fill_bits() const { return static_cast<int>((6 - bits_ % 6) % 6); }

 private:
  std::vector<std::uint8_t> six_;
  std::size_t bits_ = 0;
};

class SixBitReader {
 public:
  // nullopt if a character is not one of the 64.  Memory is bounded by the payload.
  static std::optional<SixBitReader> of(std::string_view armoured, unsigned fill_bits);

  std::size_t bits() const { return bits_; }
  std::size_t left() const { return bits_ - at_; }
  // Beyond the end there are zeros.  Requires 1 <= bits <= 32.
  std::uint32_t take(int bits);
  std::int32_t take_signed(int bits);
  // Up to the first '@', without spaces at the end.
  std::string take_text(std::size_t characters);
  void skip(std::size_t bits) { at_ += bits < left() ? bits : left(); }

 private:
  std::vector<std::uint8_t> six_;
  std::size_t bits_ = 0;
  std::size_t at_ = 0;
};

}  // namespace skerry::nmea
