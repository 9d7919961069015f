// Sentences taken apart and put together.
#pragma once

#include <gtest/gtest.h>

#include <string>

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

}  // namespace skerry::nmea
