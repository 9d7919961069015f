#include "server/app/contour_join.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace skerry::server {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// Ends are numbered: 2 i is the first point of piece i, 2 i + 1 its last.
std::size_t piece_of(std::size_t end) { return end / 2; }
std::size_t other_end(std::size_t end) { return end ^ 1u; }

// Of each end the one that it is to be joined to.
std::vector<std::size_t> partners_of(const std::vector<echo::DepthContour>& pieces) {
  struct Place {
    float depth_m;
    GeoPoint at;
    std::size_t end;
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const echo::DepthContour& piece = pieces[i];
    if (piece.line.size() < 2) continue;
    places.push_back({piece.depth_m, piece.line.front(), 2 * i});
    places.push_back({piece.depth_m, piece.line.back(), 2 * i + 1});
  }
  const auto key = [](const Place& place) {
    return std::tuple(place.depth_m, place.at.latitude_deg, place.at.longitude_deg);
  };
  std::sort(places.begin(), places.end(),
            [&](const Place& a, const Place& b) { return key(a) < key(b); });
  std::vector<std::size_t> partners(2 * pieces.size(), kNone);
  for (std::size_t i = 0, next = 0; i < places.size(); i = next) {
    for (next = i + 1; next < places.size() && key(places[next]) == key(places[i]);) ++next;
    if (next - i != 2 || piece_of(places[i].end) == piece_of(places[i + 1].end)) continue;
    partners[places[i].end] = places[i + 1].end;
    partners[places[i + 1].end] = places[i].end;
  }
  return partners;
}

void append(const std::vector<GeoPoint>& piece, bool backwards, std::vector<GeoPoint>& line) {
  const std::ptrdiff_t shared = line.empty() ? 0 : 1;
  if (backwards)
    line.insert(line.end(), piece.rbegin() + shared, piece.rend());
  else
    line.insert(line.end(), piece.begin() + shared, piece.end());
}

}  // namespace

std::vector<echo::DepthContour> joined(const std::vector<echo::DepthContour>& pieces) {
  const std::vector<std::size_t> partners = partners_of(pieces);
  std::vector<echo::DepthContour> lines;
  std::vector<bool> used(pieces.size(), false);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (used[i] || pieces[i].line.size() < 2) continue;
    // Back to where the line begins; one that is closed begins anywhere.
    std::size_t begin = 2 * i;
    while (partners[begin] != kNone && piece_of(partners[begin]) != i)
      begin = other_end(partners[begin]);
    echo::DepthContour line{pieces[i].depth_m, {}};
    for (std::size_t end = begin; end != kNone && !used[piece_of(end)];
         end = partners[other_end(end)]) {
      used[piece_of(end)] = true;
      append(pieces[piece_of(end)].line, end % 2 == 1, line.line);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace skerry::server
