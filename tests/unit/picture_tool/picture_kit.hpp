// Pictures made for tests of the picture tool.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "echo/picture_tool/picture_source.hpp"

namespace skerry::echo::test {

// How blobs of echo look.
struct BlobLook {
  double across = 12.0, along = 9.0;  // of a blob, spokes and cells
  double holes = 0.0;                 // share of echoing cells that are silent, anew each turn
  int top = 15;                       // level in the middle of a blob
};

// Turns of 512 spokes of 384 cells of 5 m, 4 bits: blobs that depend on `place`, on a quarter of
// the cells.
TurnsOfPicture blobs(std::uint64_t place, const BlobLook& look = {}, std::uint32_t turns = 1);
// Of the places from .. from + count - 1.
std::vector<TurnsOfPicture> places_of_blobs(std::uint64_t from, std::uint64_t count,
                                            const BlobLook& look = {}, std::uint32_t turns = 1);

// The bytes of a recording of it, by radar 0.
std::string recording_of(const TurnsOfPicture& picture);
// Writes a file; its path.
std::string put(const std::string& folder, const std::string& name, const std::string& bytes);

}  // namespace skerry::echo::test
