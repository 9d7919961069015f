#include "echo/chart/gdal/s57/s57_detail.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "echo/chart/gdal/polygons/land_polygon.hpp"

namespace skerry::echo {
namespace {

constexpr std::size_t kMostColours = 6;
constexpr double kDeepest_m = 12'000.0, kHighest_m = 100.0;

MarkKind lateral(int category) {
  constexpr std::array kKinds = {MarkKind::lateral_port, MarkKind::lateral_starboard,
                                 MarkKind::preferred_starboard, MarkKind::preferred_port};
  return category >= 1 && category <= 4 ? kKinds[static_cast<std::size_t>(category - 1)]
                                        : MarkKind::other;
}

MarkKind cardinal(int category) {
  constexpr std::array kKinds = {MarkKind::cardinal_north, MarkKind::cardinal_east,
                                 MarkKind::cardinal_south, MarkKind::cardinal_west};
  return category >= 1 && category <= 4 ? kKinds[static_cast<std::size_t>(category - 1)]
                                        : MarkKind::other;
}

// LITCHR of S-57.
std::string_view character_of(int code) {
  constexpr std::array<std::string_view, 30> kNames = {
      "",    "F",   "Fl", "LFl", "Q",     "VQ",   "UQ",    "Iso",   "Oc",    "IQ",
      "IVQ", "IUQ", "Mo", "FFl", "FlLFl", "OcFl", "FLFl",  "AlOc",  "AlLFl", "AlFl",
      "Al",  "",    "",   "",    "",      "QLFl", "VQLFl", "UQLFl", "Al",    "FAlFl"};
  return code >= 0 && code < static_cast<int>(kNames.size())
             ? kNames[static_cast<std::size_t>(code)]
             : std::string_view();
}

std::string_view letter_of(int colour) {
  switch (colour) {
    case 1:
      return "W";
    case 3:
      return "R";
    case 4:
      return "G";
    case 5:
      return "Bu";
    case 6:
      return "Y";
    case 11:
      return "Or";
    default:
      return "";
  }
}

// "Fl(2) R 5s".
std::string light_of(const S57Feature& feature) {
  std::string text(character_of(feature.integer("LITCHR").value_or(0)));
  if (text.empty()) text = "Lt";
  const std::string group = feature.text("SIGGRP");  // "(2)", "(2+1)", "(1)", "()(1)"
  if (group.size() > 2 && group.size() < 12 && group != "(1)" && group.front() == '(' &&
      group.find("()") == std::string::npos)
    text += group;
  std::string colours;
  for (const int colour : feature.integers("COLOUR")) colours += letter_of(colour);
  if (!colours.empty()) text += " " + colours;
  const double period_s = feature.real("SIGPER").value_or(0.0);
  if (period_s > 0.0 && period_s < 1000.0) text += fmt::format(" {:g}s", period_s);
  return text;
}

class DetailReader {
 public:
  DetailReader(const S57Cell& cell, bool depths_in_metres, ChartSheet& sheet)
      : cell_(cell), has_depths_(depths_in_metres), sheet_(sheet) {}

  void run() {
    if (has_depths_)
      cell_.for_each("DEPCNT", [&](const S57Feature& feature) { add_contour(feature); });
    add_class("BOYLAT", false, [](const S57Feature& f) { return lateral(category(f, "CATLAM")); });
    add_class("BCNLAT", true, [](const S57Feature& f) { return lateral(category(f, "CATLAM")); });
    add_class("BOYCAR", false, [](const S57Feature& f) { return cardinal(category(f, "CATCAM")); });
    add_class("BCNCAR", true, [](const S57Feature& f) { return cardinal(category(f, "CATCAM")); });
    add_class("BOYISD", false, always<MarkKind::isolated_danger>);
    add_class("BCNISD", true, always<MarkKind::isolated_danger>);
    add_class("BOYSAW", false, always<MarkKind::safe_water>);
    add_class("BCNSAW", true, always<MarkKind::safe_water>);
    add_class("BOYSPP", false, always<MarkKind::special>);
    add_class("BCNSPP", true, always<MarkKind::special>);
    add_class("BOYINB", false, always<MarkKind::other>);
    add_class("LITFLT", false, always<MarkKind::light_vessel>);
    add_class("LITVES", false, always<MarkKind::light_vessel>);
    // What lies at the bottom may lie at the same place: it bears no light.
    const std::size_t bearers = sheet_.marks.size();
    for (std::size_t i = 0; i < bearers; ++i)
      at_.try_emplace(identity_of(sheet_.marks[i].place), i);
    cell_.for_each("LIGHTS", [&](const S57Feature& feature) { add_light(feature); });
    cell_.for_each("RTPBCN", [&](const S57Feature& feature) { add_racon(feature); });
    add_class("WRECKS", true, always<MarkKind::wreck>);
    add_class("OBSTRN", true, always<MarkKind::obstruction>);
    add_class("UWTROC", true, always<MarkKind::rock>);
  }

 private:
  template <MarkKind kind>
  static MarkKind always(const S57Feature& /*feature*/) {
    return kind;
  }
  static int category(const S57Feature& feature, const char* attribute) {
    return feature.integer(attribute).value_or(0);
  }

  void add_contour(const S57Feature& feature) {
    const auto depth_m = feature.real("VALDCO");
    if (!depth_m || *depth_m < -kHighest_m || *depth_m > kDeepest_m) return;
    for (const OGRLineString* line : lines_in(*feature.geometry())) {
      std::string fault;
      std::vector<GeoPoint> places = places_on(*line, fault);
      if (!fault.empty())
        cell_.warnings().add(fmt::format("{}: {}; left out", feature.name(), fault));
      if (places.size() < 2) continue;
      if (places.size() > kMostContourVertices - vertices_) {
        cell_.warnings().add(fmt::format("{}: more than {} vertices of depth contours; left out",
                                         feature.name(), kMostContourVertices));
        continue;
      }
      vertices_ += places.size();
      sheet_.contours.push_back({static_cast<float>(*depth_m), std::move(places)});
    }
  }

  template <typename KindOf>
  void add_class(const char* object_class, bool fixed, const KindOf& kind_of) {
    cell_.for_each(object_class, [&](const S57Feature& feature) {
      ChartMark mark;
      mark.kind = kind_of(feature);
      mark.fixed = fixed;
      mark.name = feature.text("OBJNAM");
      mark.shape = static_cast<std::uint8_t>(std::clamp(category(feature, "BOYSHP"), 0, 255));
      for (const int colour : feature.integers("COLOUR")) {
        if (colour > 0 && colour < 256 && mark.colours.size() < kMostColours)
          mark.colours.push_back(static_cast<std::uint8_t>(colour));
      }
      const auto depth_m = feature.real("VALSOU");
      if (has_depths_ && depth_m && *depth_m >= -kHighest_m && *depth_m <= kDeepest_m)
        mark.depth_m = static_cast<float>(*depth_m);
      put(feature, mark);
    });
  }

  // A mark at each point of a feature, in the middle of its lines, or within its areas.
  void put(const S57Feature& feature, const ChartMark& mark) {
    const OGRGeometry& geometry = *feature.geometry();
    const auto type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPoint) return put_at(feature, *geometry.toPoint(), mark);
    if (type == wkbMultiPoint) {
      for (const OGRPoint* point : *geometry.toMultiPoint()) put_at(feature, *point, mark);
      return;
    }
    const auto lines = lines_in(geometry);
    if (!lines.empty()) {
      const OGRLineString& line = *lines[lines.size() / 2];
      OGRPoint middle;
      if (line.getNumPoints() == 0) return;
      line.getPoint(line.getNumPoints() / 2, &middle);
      return put_at(feature, middle, mark);
    }
    for (const OGRPolygon* polygon : polygons_in(geometry)) {
      GdalErrors errors;
      OGRPoint inside;
      if (polygon->PointOnSurface(&inside) == OGRERR_NONE) put_at(feature, inside, mark);
    }
  }

  void put_at(const S57Feature& feature, const OGRPoint& point, const ChartMark& mark) {
    const auto place = place_of(feature, point);
    if (!place) return;
    if (sheet_.marks.size() >= kMostMarks) {
      cell_.warnings().add(
          fmt::format("{}: more than {} marks; left out", feature.name(), kMostMarks));
      return;
    }
    sheet_.marks.push_back(mark);
    sheet_.marks.back().place = *place;
  }

  std::optional<GeoPoint> place_of(const S57Feature& feature, const OGRPoint& point) const {
    OGRLineString one;
    one.addPoint(point.getX(), point.getY());
    std::string fault;
    const std::vector<GeoPoint> places = places_on(one, fault);
    if (!fault.empty())
      cell_.warnings().add(fmt::format("{}: {}; left out", feature.name(), fault));
    return places.empty() ? std::nullopt : std::optional(places.front());
  }

  // The mark at the place of a point feature, put there now if there is none.
  ChartMark* mark_at(const S57Feature& feature, MarkKind kind) {
    if (wkbFlatten(feature.geometry()->getGeometryType()) != wkbPoint) return nullptr;
    const auto place = place_of(feature, *feature.geometry()->toPoint());
    if (!place) return nullptr;
    const auto found = at_.find(identity_of(*place));
    if (found != at_.end()) return &sheet_.marks[found->second];
    ChartMark mark;
    mark.kind = kind;
    mark.fixed = true;
    mark.name = feature.text("OBJNAM");
    const std::size_t before = sheet_.marks.size();
    put_at(feature, *feature.geometry()->toPoint(), mark);
    if (sheet_.marks.size() == before) return nullptr;
    at_.emplace(identity_of(*place), before);
    return &sheet_.marks.back();
  }

  // Of several lights at a place (sectors) the first is told.
  void add_light(const S57Feature& feature) {
    ChartMark* const mark = mark_at(feature, MarkKind::light);
    if (mark == nullptr || !mark->light.empty()) return;
    mark->light = light_of(feature);
    if (mark->kind != MarkKind::light) return;
    for (const int colour : feature.integers("COLOUR")) {
      if (colour > 0 && colour < 256 && mark->colours.size() < kMostColours)
        mark->colours.push_back(static_cast<std::uint8_t>(colour));
    }
  }

  // A ramark, which sends without being asked, is none; what it stands on is told without it.
  void add_racon(const S57Feature& feature) {
    if (is_ramark(feature)) return;
    if (ChartMark* const mark = mark_at(feature, MarkKind::racon)) mark->racon = true;
  }

  const S57Cell& cell_;
  bool has_depths_;
  ChartSheet& sheet_;
  std::unordered_map<std::uint64_t, std::size_t> at_;  // marks that may bear a light, by place
  std::size_t vertices_ = 0;
};

}  // namespace

void read_detail(const S57Cell& cell, bool depths_in_metres, ChartSheet& sheet) {
  if (!depths_in_metres)
    cell.warnings().add(
        fmt::format("{}: depths are not in metres (DUNI); depths are left out", cell.file()));
  DetailReader(cell, depths_in_metres, sheet).run();
}

}  // namespace skerry::echo
