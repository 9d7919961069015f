#include "echo/scene/coast_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>

#include "echo/scene/shore_guess.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kHighestFace = 1000.0;  // metres

[[noreturn]] void refuse(std::size_t ring, const std::string& what) {
  throw std::invalid_argument("coast chart: ring " + std::to_string(ring) + ": " + what);
}

void require_whole(const CoastChart& chart, std::size_t r) {
  const CoastRing& ring = chart.rings[r];
  const std::size_t n = ring.vertices.size();
  const auto same = [&](const char* what, std::size_t size) {
    if (size != n)
      refuse(r, std::to_string(size) + " " + what + " for " + std::to_string(n) + " vertices");
  };
  same("edge kinds", ring.edges.size());
  same("vertex identities", ring.vertex_ids.size());
  if (!ring.shores.empty()) same("shore indices", ring.shores.size());
  for (std::size_t i = 0; i < n; ++i) {
    const GeoPoint p = ring.vertices[i];
    if (!(std::fabs(p.latitude_deg) <= 90.0 && std::fabs(p.longitude_deg) <= 360.0))
      refuse(r, "vertex " + std::to_string(i) + " is at latitude " +
                    std::to_string(p.latitude_deg) + ", longitude " +
                    std::to_string(p.longitude_deg) + "; allowed: -90 to 90 and -360 to 360");
    if (!ring.shores.empty() && ring.shores[i] >= chart.shores.size())
      refuse(r, "edge " + std::to_string(i) + " has shore " + std::to_string(ring.shores[i]) +
                    " of " + std::to_string(chart.shores.size()));
  }
}

// At least the length of an edge on the Earth, metres.
double at_most_long(GeoPoint a, GeoPoint b) {
  constexpr double kEarth = 6.4e6;
  // The parallel nearer the equator is the longer one: cos(lat) <= 90 deg - lat, in radians.
  const double from_pole = 90.0 - std::min(std::fabs(a.latitude_deg), std::fabs(b.latitude_deg));
  const double shrink = std::min(1.0, from_pole * kRadiansPerDegree);
  const double east = std::fabs(wrapped_longitude(a.longitude_deg - b.longitude_deg)) * shrink;
  return kEarth * kRadiansPerDegree * (std::fabs(a.latitude_deg - b.latitude_deg) + east);
}

// The scenario's places, each with a plane of its own, so that none depends on the picture's.
class Places {
 public:
  explicit Places(const std::vector<CoastPlace>& places) : places_(places) {
    for (const CoastPlace& place : places) planes_.emplace_back(place.centre);
  }
  bool empty() const { return places_.empty(); }
  bool holds(std::size_t k, GeoPoint a, GeoPoint b) const {
    constexpr double kMetresPerDegree = 110e3;  // of latitude, at least
    const double off = std::min(std::fabs(a.latitude_deg - places_[k].centre.latitude_deg),
                                std::fabs(b.latitude_deg - places_[k].centre.latitude_deg));
    const double reach = places_[k].radius_m;
    if (off * kMetresPerDegree > reach + at_most_long(a, b)) return false;
    return length_of((planes_[k].to_plane(a) + planes_[k].to_plane(b)) * 0.5) <= reach;
  }

 private:
  const std::vector<CoastPlace>& places_;
  std::vector<LocalPlane> planes_;
};

// The chart's types, with the unknown ones guessed.
std::vector<CoastType> types_of(const CoastChart& chart, const CoastRing& ring, bool guess) {
  const std::size_t n = ring.vertices.size();
  std::vector<CoastType> types(n);
  for (std::size_t i = 0; i < n; ++i) types[i] = shore_of(chart, ring, i).type;
  if (!guess) return types;
  const auto open = [&](std::size_t i) {
    return ring.edges[i] == EdgeKind::shoreline && types[i] == CoastType::unknown;
  };
  std::vector<bool> unknown(n);
  std::size_t first = n;  // an edge that is not to be guessed, to begin behind
  for (std::size_t i = 0; i < n; ++i) {
    unknown[i] = open(i);
    if (!unknown[i] && first == n) first = i;
  }
  const bool closed = first == n;
  // The ring from behind that edge on, as it is walked.
  const std::size_t origin = closed ? 0 : first + 1;
  const auto at = [&](std::size_t k) {
    k += origin;
    while (k >= n) k -= n;
    return k;
  };
  std::vector<std::uint64_t> ids;
  std::vector<GeoPoint> line;
  for (std::size_t k = 0; k < n;) {
    std::size_t count = 0;  // of edges, from k on, that are a run
    while (k + count < n && unknown[at(k + count)]) ++count;
    if (count > 0) {
      ids.clear();
      for (std::size_t i = 0; i < count + (closed ? 0u : 1u); ++i)
        ids.push_back(ring.vertex_ids[at(k + i)]);
      const std::vector<std::uint32_t> starts = stretch_starts(ids, closed);
      for (std::size_t s = 0; s < starts.size(); ++s) {
        const std::size_t begin = starts[s];
        const std::size_t end = s + 1 < starts.size() ? starts[s + 1]
                                : closed              ? starts[0] + n
                                                      : count;
        line.clear();
        for (std::size_t i = begin; i <= end; ++i) line.push_back(ring.vertices[at(k + i)]);
        const CoastType type = guess_type(line);
        for (std::size_t i = begin; i < end; ++i) types[at(k + i)] = type;
      }
    }
    k += count + 1;
  }
  return types;
}

using KindKey = std::tuple<bool, CoastType, float>;

// Rounds heights until there are few enough kinds; `edges` holds the kind of every edge.
void number_kinds(const std::vector<PictureShore>& of_edges, CoastEdges& out) {
  std::map<KindKey, std::uint8_t> number;
  const auto key_of = [](const PictureShore& s, double step) {
    const double height = step > 0.0 ? std::floor(s.height_m / step + 0.5) * step : s.height_m;
    return KindKey{s.seam, s.type, static_cast<float>(height)};
  };
  double step = 0.0;
  for (bool fits = false; !fits; step = fits ? step : std::max(0.25, 2.0 * step)) {
    number.clear();
    number[key_of({}, step)] = 0;
    PictureShore last;
    for (const PictureShore& s : of_edges) {
      if (s == last) continue;
      number[key_of(s, step)] = 0;
      last = s;
      if (number.size() > 256) break;
    }
    fits = number.size() <= 256;
  }
  // PictureShore{} is the least key of all.
  for (auto& [key, k] : number) {
    k = static_cast<std::uint8_t>(out.kinds.size());
    out.kinds.push_back({std::get<1>(key), std::get<0>(key), std::get<2>(key)});
  }
  PictureShore last;
  std::uint8_t last_number = 0;
  out.shores.reserve(of_edges.size());
  for (const PictureShore& s : of_edges) {
    if (!(s == last)) {
      last = s;
      last_number = number.at(key_of(s, step));
    }
    out.shores.push_back(last_number);
  }
}

std::uint16_t number_of(const CoastStyle& style, std::vector<CoastStyle>& all) {
  auto it = std::find(all.begin(), all.end(), style);
  if (it == all.end()) {
    if (all.size() > 65535)
      throw std::invalid_argument("coast rules: more than 65535 different styles");
    it = all.insert(all.end(), style);
  }
  return static_cast<std::uint16_t>(it - all.begin());
}

}  // namespace

CoastEdges lay_edges(const CoastChart& chart, const LocalPlane& plane, const CoastRules& rules) {
  CoastEdges out;
  std::vector<std::uint16_t> style_of_type, style_of_place;
  for (const CoastStyle& s : rules.styles) style_of_type.push_back(number_of(s, out.all_styles));
  for (const CoastPlace& p : rules.places)
    style_of_place.push_back(p.style ? number_of(*p.style, out.all_styles) : std::uint16_t{0});
  const Places places(rules.places);
  const double kept = chart.radius_m + kKeptBeyond;
  std::vector<PlanePoint> laid;
  std::vector<PictureShore> of_edges;
  std::size_t most = 0;
  for (const CoastRing& ring : chart.rings) most += ring.edges.size();
  most = std::min<std::size_t>(most, 1u << 18);  // not for what is mostly left out
  out.edges.reserve(most);
  out.styles.reserve(most);
  of_edges.reserve(most);
  for (std::size_t r = 0; r < chart.rings.size(); ++r) {
    require_whole(chart, r);
    const CoastRing& ring = chart.rings[r];
    const std::size_t n = ring.vertices.size();
    if (n < 3) continue;  // bounds nothing
    laid.resize(n);
    for (std::size_t i = 0; i < n; ++i) laid[i] = plane.to_plane(ring.vertices[i]);
    const auto far_off = [&](std::size_t i, std::size_t j) {
      const double nearest = std::min(length_of(laid[i]), length_of(laid[j]));
      return nearest > kept && nearest - at_most_long(ring.vertices[i], ring.vertices[j]) > kept;
    };
    std::vector<CoastType> types;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if (ring.edges[i] == EdgeKind::bin_border || ring.vertex_ids[i] == ring.vertex_ids[j] ||
          far_off(i, j))
        continue;
      if (types.empty()) types = types_of(chart, ring, rules.guess_types);
      out.edges.push_back({laid[i], laid[j], ring.vertex_ids[i], ring.vertex_ids[j]});
      if (ring.edges[i] == EdgeKind::seam) {
        of_edges.push_back({CoastType::unknown, true, 0.0f});
        out.styles.push_back(style_of_type[0]);
        continue;
      }
      const float charted = shore_of(chart, ring, i).height_m;
      PictureShore shore{types[i], false,
                         charted > 0.0f && charted <= kHighestFace ? charted : 0.0f};
      // A later place wins: from the last one on, until both are known.
      std::optional<std::uint16_t> style;
      bool typed = false;
      for (std::size_t k = rules.places.size(); k-- > 0 && !(typed && style);) {
        const CoastPlace& place = rules.places[k];
        if ((typed || !place.type) && (style || !place.style)) continue;
        if (!places.holds(k, ring.vertices[i], ring.vertices[j])) continue;
        if (place.type && !typed) {
          shore.type = *place.type;
          typed = true;
        }
        if (place.style && !style) style = style_of_place[k];
      }
      out.styles.push_back(style ? *style : style_of_type[static_cast<std::size_t>(shore.type)]);
      of_edges.push_back(shore);
    }
  }
  number_kinds(of_edges, out);
  return out;
}

}  // namespace skerry::echo
