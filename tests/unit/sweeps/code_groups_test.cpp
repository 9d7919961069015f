#include "echo/sweeps/code_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace skerry::echo {
namespace {

std::vector<std::uint16_t> naive(const std::vector<std::uint16_t>& codes, CodeDecimation mode,
                                 std::uint32_t group) {
  std::vector<std::uint16_t> out;
  for (std::size_t at = 0; at + group <= codes.size(); at += group) {
    double largest = 0.0, sum = 0.0;
    for (std::size_t k = at; k < at + group; ++k) {
      largest = std::max<double>(largest, codes[k]);
      sum += codes[k];
    }
    const double value = mode == CodeDecimation::peak   ? largest
                         : mode == CodeDecimation::mean ? std::floor(sum / group + 0.5)
                                                        : std::min(sum, 65535.0);
    out.push_back(static_cast<std::uint16_t>(value));
  }
  return out;
}

TEST(CodeGroups, AreTheSameHoweverTheCodesCome) {
  std::mt19937 random(3);
  for (const CodeDecimation mode :
       {CodeDecimation::peak, CodeDecimation::mean, CodeDecimation::sum}) {
    for (const std::uint32_t group : {1u, 2u, 3u, 4u, 7u, 8u, 13u, 100u, 1500u}) {
      std::vector<std::uint16_t> codes(group * 23);
      for (auto& c : codes) c = static_cast<std::uint16_t>(random() % 4096);
      for (const std::size_t most : {1u, 5u, 64u, 1024u, 100000u}) {
        std::vector<std::uint16_t> out(23, 0xABCD);
        CodeGroups groups(mode, group, out);
        for (std::size_t at = 0; at < codes.size();) {
          const std::size_t n = std::min<std::size_t>(codes.size() - at, 1 + random() % most);
          groups.add(std::span(codes).subspan(at, n));
          at += n;
        }
        ASSERT_EQ(out, naive(codes, mode, group)) << group << " in pieces of up to " << most;
      }
    }
  }
}

TEST(CodeGroups, DropWhatDoesNotFit) {
  const std::vector<std::uint16_t> codes(100, 9);
  std::vector<std::uint16_t> out(3, 0);
  CodeGroups groups(CodeDecimation::sum, 7, std::span(out).first(2));
  groups.add(codes);
  groups.add(codes);
  EXPECT_EQ(out, (std::vector<std::uint16_t>{63, 63, 0}));
}

}  // namespace
}  // namespace skerry::echo
