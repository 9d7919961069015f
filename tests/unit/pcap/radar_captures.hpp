// The captures of real radars that may stand beside the repository, and what an independent
// decoder makes of them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"

namespace skerry {

// Whether the recordings are there; tests that need them GTEST_SKIP otherwise.
bool have_radar_captures();
inline constexpr const char* kNoRadarCaptures = "no captures of real radars beside the repository";

// The bytes of a .pcap.gz, unpacked.  Error: std::runtime_error.
std::vector<std::uint8_t> unpack_radar_capture(const std::string& file);

struct CapturedDatagram {
  UtcTime time;
  Ipv4Endpoint from, to;
  std::vector<std::uint8_t> payload;
};
// All whole UDP datagrams of it, in order.  Error: std::runtime_error.
std::vector<CapturedDatagram> read_radar_capture(const std::string& file);

// A name for the test of that file: its name without ending and dashes.
std::string test_name_of(const std::string& file);

// One line of expected_decode.csv.
struct ExpectedDecode {
  std::uint64_t spoke_packets = 0;
  std::uint64_t spokes = 0;
  std::uint64_t azimuth_wraps = 0;
  std::map<std::string, std::uint64_t> spokes_at_range_m;  // by range as printed there
  std::uint64_t cell_value_sum = 0;
  std::uint64_t nonzero_cells = 0;
  unsigned max_cell = 0;
  std::string sha1_of_cells;
};
// Error: std::runtime_error.
ExpectedDecode expected_decode(const std::string& file);

// Sums up decoded cells as expected_decode.csv does.
class DecodedCells {
 public:
  DecodedCells();
  ~DecodedCells();
  DecodedCells(const DecodedCells&) = delete;
  DecodedCells& operator=(const DecodedCells&) = delete;

  void add(std::span<const std::uint8_t> cells);
  std::uint64_t spokes() const { return spokes_; }
  std::uint64_t value_sum() const { return value_sum_; }
  std::uint64_t nonzero() const { return nonzero_; }
  unsigned max() const { return max_; }
  // SHA-1 of all cells added so far, in hexadecimal digits.
  std::string sha1() const;

 private:
  void* digest_;  // EVP_MD_CTX
  std::uint64_t spokes_ = 0, value_sum_ = 0, nonzero_ = 0;
  unsigned max_ = 0;
};

// EXPECTs their number, sum, largest and SHA-1.
void expect_cells(const DecodedCells& cells, const ExpectedDecode& expected);

}  // namespace skerry
