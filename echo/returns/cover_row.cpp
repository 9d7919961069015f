#include "echo/returns/cover_row.hpp"

#include <algorithm>

#include "echo/returns/cover_echo.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kCoverSeed = 0xC07E5;
constexpr float kEdgeOfObjects = 5.0f;  // 1 / the noise over which an object rises to its height

}  // namespace

CoverRow::CoverRow(const ChartedCover& charted, const LandModel& model, const LatticePath& path,
                   std::size_t cells)
    : charted_(charted),
      model_(model),
      path_(path),
      covers_((cells + kLandChunk - 1) / kLandChunk * kLandChunk, LandCover::none),
      read_(covers_.size() / kLandChunk, false) {}

bool CoverRow::read(std::size_t first, std::size_t count) {
  const auto place = [&](std::size_t chunk) {
    return charted_.track.at((static_cast<double>(chunk * kLandChunk) + 0.5) * model_.cell_m);
  };
  for (std::size_t chunk = first / kLandChunk; chunk <= (first + count - 1) / kLandChunk; ++chunk) {
    if (read_[chunk]) continue;
    read_[chunk] = true;
    const GeoPoint from = chunk == known_chunk_ ? known_ : place(chunk);
    known_chunk_ = chunk + 1;
    known_ = place(known_chunk_);
    constexpr double kPart = 1.0 / static_cast<double>(kLandChunk);
    const GeoPoint step{(known_.latitude_deg - from.latitude_deg) * kPart,
                        (known_.longitude_deg - from.longitude_deg) * kPart};
    charted_.grid.along(from, step, {covers_.data() + chunk * kLandChunk, kLandChunk});
  }
  const auto begin = covers_.begin() + static_cast<std::ptrdiff_t>(first);
  return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(count),
                     [](LandCover c) { return c != LandCover::none; });
}

void CoverRow::objects(std::size_t first, std::span<float> out) const {
  std::fill(out.begin(), out.end(), 0.0f);
  float noise[kLandChunk];
  std::uint32_t done = 0;  // a bit for each cover
  for (std::size_t k = 0; k < out.size(); ++k) {
    const LandCover cover = at(first + k);
    const auto index = static_cast<std::uint32_t>(cover);
    const CoverEcho& echo = echo_of(cover);
    if (done >> index & 1u || echo.objects_m == 0.0f) continue;
    done |= 1u << index;
    const bool even = static_cast<double>(echo.grain_m) < 2.0 * model_.cell_m;
    if (!even) {
      const NoiseOctave grain{static_cast<double>(echo.grain_m), 1.0f};
      relief_noise(path_, {&grain, 1}, model_.seed ^ kCoverSeed,
                   static_cast<std::uint32_t>(first + k), {noise + k, out.size() - k}, index);
    }
    for (std::size_t i = k; i < out.size(); ++i) {
      if (at(first + i) != cover) continue;
      const float stands =
          even ? echo.share
               : std::clamp(0.5f + (noise[i] - echo.above) * kEdgeOfObjects, 0.0f, 1.0f);
      out[i] = echo.objects_m * stands;
    }
  }
}

double CoverRow::most_objects(std::size_t first, std::size_t count) const {
  float most = 0.0f;
  for (std::size_t k = 0; k < count; ++k) most = std::max(most, echo_of(at(first + k)).objects_m);
  return static_cast<double>(most);
}

}  // namespace skerry::echo
