// Sentences taken apart and put together.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Without checksum and end, which are checked here.
inline std::string body(const std::string& line) {
  EXPECT_LE(line.size(), kMaxSentence) << line;
  EXPECT_TRUE(line.ends_with("\r\n")) << line;
  const auto sentence = parse_sentence(line);
  EXPECT_TRUE(sentence) << (sentence ? line : sentence.error().text);
  return line.substr(0, line.find('*'));
}

inline std::string with_checksum(const std::string& between) {
  return "$" + between + "*" + checksum_text(between);
}

// Decodes a line with `decode`; an exception where it cannot.
template <typename Decode>
auto decoded(const std::string& line, Decode decode) {
  const auto sentence = parse_sentence(line);
  if (!sentence) throw std::runtime_error(sentence.error().text);
  auto result = decode(*sentence);
  if (!result) throw std::runtime_error(result.error().text);
  return std::move(result).value();
}

// Whether what is between start and checksum is refused by `decode`, saying why.
template <typename Decode>
bool is_refused(const std::string& between, Decode decode) {
  const std::string line = with_checksum(between);
  const auto sentence = parse_sentence(line);
  if (!sentence) return false;
  const auto result = decode(*sentence);
  if (result) return false;
  EXPECT_FALSE(result.error().text.empty()) << line;
  EXPECT_LE(result.error().offset, line.size()) << line;
  return true;
}

}  // namespace skerry::nmea
