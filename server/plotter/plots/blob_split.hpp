// Blobs of several ships, told apart by the valleys between them.
#pragma once

#include <cstdint>
#include <vector>

#include "server/plotter/plots/blob_builder.hpp"

namespace skerry::server {

// Memory that one split leaves to the next.
struct SplitScratch {
  std::vector<std::uint32_t> rows, cells, after;
};

// Cuts a blob across rows or across cells, wherever the sum of its levels over the threshold falls
// below `valley` of the lower one of two peaks beside it; the parts again, at most eight in all.
// An extended blob is not cut.  Cells keep their order; rows stay those of the blob.  Empty:
// nothing is cut, the blob is its only part.
std::vector<std::vector<BlobCell>> split(const Blob& blob, double valley, SplitScratch& scratch);

}  // namespace skerry::server
