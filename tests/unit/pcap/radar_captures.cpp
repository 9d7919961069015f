#include "tests/unit/pcap/radar_captures.hpp"

#include <gtest/gtest.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "protocol/pcap/capture_reader.hpp"

namespace skerry {
namespace {

std::filesystem::path folder() {
  return std::filesystem::path(SKERRY_SOURCE_DIR) / "../shared/data/radar";
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

}  // namespace

std::string test_name_of(const std::string& file) {
  std::string name = file.substr(0, file.find('.'));
  std::erase(name, '-');
  return name;
}

bool have_radar_captures() { return std::filesystem::exists(folder() / "expected_decode.csv"); }

std::vector<std::uint8_t> unpack_radar_capture(const std::string& file) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen((folder() / file).c_str(), "rb"),
                                                      gzclose);
  if (!in) throw std::runtime_error("cannot open " + file);
  std::vector<std::uint8_t> bytes;
  std::array<std::uint8_t, 1 << 16> block;
  int got = 0;
  while ((got = gzread(in.get(), block.data(), block.size())) > 0) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + got);
  }
  if (got < 0) throw std::runtime_error("cannot unpack " + file);
  return bytes;
}

std::vector<CapturedDatagram> read_radar_capture(const std::string& file) {
  std::vector<CapturedDatagram> datagrams;
  const auto counts =
      pcap::read_capture(unpack_radar_capture(file), [&](const pcap::Datagram& each) {
        datagrams.push_back(
            {each.time, each.from, each.to, {each.payload.begin(), each.payload.end()}});
      });
  if (!counts.ok()) throw std::runtime_error(file + ": " + counts.error().text);
  return datagrams;
}

ExpectedDecode expected_decode(const std::string& file) {
  std::ifstream in(folder() / "expected_decode.csv");
  for (std::string line; std::getline(in, line);) {
    const auto field = split(line, ',');
    if (field.size() != 13 || field[0] != file) continue;
    ExpectedDecode expected;
    expected.spoke_packets = std::stoull(field[3]);
    expected.spokes = std::stoull(field[4]);
    expected.azimuth_wraps = std::stoull(field[6]);
    for (const std::string& range : split(field[8], ' ')) {
      const auto open = range.find('(');
      expected.spokes_at_range_m[range.substr(0, open)] = std::stoull(range.substr(open + 1));
    }
    expected.cell_value_sum = std::stoull(field[9]);
    expected.nonzero_cells = std::stoull(field[10]);
    expected.max_cell = static_cast<unsigned>(std::stoul(field[11]));
    expected.sha1_of_cells = field[12].substr(0, 40);
    return expected;
  }
  throw std::runtime_error("expected_decode.csv has no line for " + file);
}

DecodedCells::DecodedCells() : digest_(EVP_MD_CTX_new()) {
  EVP_DigestInit_ex(static_cast<EVP_MD_CTX*>(digest_), EVP_sha1(), nullptr);
}

DecodedCells::~DecodedCells() { EVP_MD_CTX_free(static_cast<EVP_MD_CTX*>(digest_)); }

void DecodedCells::add(std::span<const std::uint8_t> cells) {
  EVP_DigestUpdate(static_cast<EVP_MD_CTX*>(digest_), cells.data(), cells.size());
  ++spokes_;
  for (const std::uint8_t cell : cells) {
    value_sum_ += cell;
    nonzero_ += cell != 0;
    max_ = std::max<unsigned>(max_, cell);
  }
}

std::string DecodedCells::sha1() const {
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> copy(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  EVP_MD_CTX_copy_ex(copy.get(), static_cast<EVP_MD_CTX*>(digest_));
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes;
  unsigned count = 0;
  EVP_DigestFinal_ex(copy.get(), bytes.data(), &count);
  std::string text;
  for (unsigned i = 0; i < count; ++i) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", bytes[i]);
    text += digits;
  }
  return text;
}

void expect_cells(const DecodedCells& cells, const ExpectedDecode& expected) {
  EXPECT_EQ(cells.spokes(), expected.spokes);
  EXPECT_EQ(cells.value_sum(), expected.cell_value_sum);
  EXPECT_EQ(cells.nonzero(), expected.nonzero_cells);
  EXPECT_EQ(cells.max(), expected.max_cell);
  EXPECT_EQ(cells.sha1(), expected.sha1_of_cells);
}

}  // namespace skerry
