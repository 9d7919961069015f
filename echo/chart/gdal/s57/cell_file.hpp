// The records of an S-57 file, checked before GDAL sees them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace skerry::echo {

// The facts that a file holds about itself.
struct CellFacts {
  std::string name;                   // DSNM, "US5WA22M.000"
  std::string edition;                // EDTN
  int update = 0;                     // UPDN
  std::uint32_t feature_records = 0;  // found in the file
  std::uint32_t vector_records = 0;
};

// Reads the whole file.
// Error: std::runtime_error if it cannot be read or is larger than 64 MB (S-57 allows cells 5 MB).
std::vector<std::uint8_t> read_cell_file(const std::filesystem::path& file);

// Checks the chain of ISO/IEC 8211 records: lengths, leaders, directories and fields of every
// record lie within the record, records follow one another to the end of the file without a gap,
// the subfields of fields that GDAL 3.6 indexes without a check are complete, and there are no
// fewer records of each kind than field DSSI states.  So a file cut anywhere is refused, and every
// length GDAL is given is true.
//
// Source: IHO S-57 edition 3.1, part 3, chapter 7; ISO/IEC 8211:1994.
// Error: std::runtime_error that names `file`, the record and its byte offset.
CellFacts check_cell(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace skerry::echo
