#include "tests/unit/picture_tool/picture_kit.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <span>

#include "echo/kernel/hash.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::echo::test {
namespace {

constexpr std::uint32_t kSpokes = 512, kCells = 384;
constexpr double kCell_m = 5.0;

double chance(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return static_cast<double>(mixed(mixed(seed, a), b) >> 11) / 9007199254740992.0;
}

// Smooth between points of a lattice that is `round` points round the turn; about 0.5 in the mean.
double smooth(std::uint64_t seed, double s, double c, std::uint64_t round) {
  const auto i = static_cast<std::uint64_t>(s), k = static_cast<std::uint64_t>(c);
  const std::uint64_t j = (i + 1) % round;
  const auto eased = [](double x) { return x * x * (3.0 - 2.0 * x); };
  const double u = eased(s - static_cast<double>(i)), v = eased(c - static_cast<double>(k));
  const double low = chance(seed, i, k) * (1 - u) + chance(seed, j, k) * u;
  const double high = chance(seed, i, k + 1) * (1 - u) + chance(seed, j, k + 1) * u;
  return low * (1 - v) + high * v;
}

}  // namespace

TurnsOfPicture blobs(std::uint64_t place, const BlobLook& look, std::uint32_t turns) {
  TurnsOfPicture picture;
  picture.file = "blobs";
  picture.reach_m = kCells * kCell_m;
  picture.spokes = kSpokes, picture.cells = kCells;
  picture.full_scale = 15;
  const double round = std::round(kSpokes / look.across);
  for (std::uint32_t t = 0; t < turns; ++t) {
    std::vector<std::uint8_t> video;
    for (std::uint32_t s = 0; s < kSpokes; ++s) {
      for (std::uint32_t c = 0; c < kCells; ++c) {
        const double over =
            smooth(place, s * round / kSpokes, c / look.along, static_cast<std::uint64_t>(round)) -
            0.62;
        const bool hole = chance(mixed(place, 99 + t), s, c) < look.holes;
        const double level = std::ceil(over * 60.0);
        video.push_back(static_cast<std::uint8_t>(
            hole ? 0.0 : std::clamp(level, 0.0, static_cast<double>(look.top))));
      }
    }
    picture.turns.push_back(std::move(video));
    picture.follows.push_back(t > 0);
  }
  return picture;
}

std::vector<TurnsOfPicture> places_of_blobs(std::uint64_t from, std::uint64_t count,
                                            const BlobLook& look, std::uint32_t turns) {
  std::vector<TurnsOfPicture> places;
  for (std::uint64_t place = from; place < from + count; ++place)
    places.push_back(blobs(place, look, turns));
  return places;
}

std::string recording_of(const TurnsOfPicture& picture) {
  std::string bytes;
  recording::RecordingWriter writer(
      [&](std::span<const std::uint8_t> more) {
        bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
        return true;
      },
      {});
  std::uint64_t sequence = 0;
  for (std::uint32_t t = 0; t < picture.turns.size(); ++t) {
    for (std::uint32_t s = 0; s < picture.spokes; ++s) {
      Spoke spoke;
      spoke.header.sequence = sequence;
      spoke.header.scan = t, spoke.header.index = s;
      spoke.header.geometry = {picture.spokes, picture.cells, picture.full_scale == 15 ? 4u : 8u};
      spoke.header.range_scale = *RangeScale::find(1.5);
      spoke.header.instrumented_range = metres(picture.reach_m);
      spoke.header.utc = UtcTime(std::chrono::milliseconds(1'700'000'000'000 + 5 * sequence++));
      const auto* cells = picture.turns[t].data() + std::size_t{s} * picture.cells;
      spoke.cells.assign(cells, cells + picture.cells);
      writer.add(spoke);
    }
  }
  writer.finish();
  return bytes;
}

std::string put(const std::string& folder, const std::string& name, const std::string& bytes) {
  const std::string path = folder + "/" + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

}  // namespace skerry::echo::test
