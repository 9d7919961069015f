#include "echo/scene/picture_memory.hpp"

#include <algorithm>
#include <utility>

namespace skerry::echo {
namespace {
constexpr std::size_t kMostPictures = 3;
constexpr std::size_t kMostVertices = 4'000'000;
}  // namespace

void PictureMemory::keep(CoastPicturePtr picture, const RadarResolution& resolution,
                         std::vector<Place> places) {
  std::erase_if(kept_, [&](const Kept& kept) { return kept.resolution == resolution; });
  kept_.insert(kept_.begin(), Kept{std::move(picture), resolution, std::move(places)});
  std::size_t vertices = 0, fit = 0;
  while (fit < std::min(kept_.size(), kMostPictures) &&
         (vertices += kept_[fit].picture->vertices.size()) <= kMostVertices) {
    ++fit;
  }
  kept_.resize(fit);
}

}  // namespace skerry::echo
