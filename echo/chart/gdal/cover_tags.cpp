#include "echo/chart/gdal/cover_tags.hpp"

#include <algorithm>

namespace skerry::echo {
namespace {

struct Name {
  std::string_view name;
  LandCover is;
};
constexpr std::array kNames = {
    Name{"built_up", LandCover::built_up}, Name{"industrial", LandCover::industrial},
    Name{"forest", LandCover::forest},     Name{"scrub", LandCover::scrub},
    Name{"grass", LandCover::grass},       Name{"farmland", LandCover::farmland},
    Name{"marsh", LandCover::marsh},       Name{"mangrove", LandCover::mangrove},
    Name{"rock", LandCover::rock},         Name{"sand", LandCover::sand},
    Name{"ice", LandCover::ice},           Name{"paved", LandCover::paved},
};

struct Tag {
  std::string_view key, value;  // value empty: any
  LandCover is;                 // none: land of no stated cover
};
// In the order of their keys' rank.
constexpr std::array kTags = {
    Tag{"aeroway", "runway", LandCover::paved},
    Tag{"aeroway", "taxiway", LandCover::paved},
    Tag{"aeroway", "apron", LandCover::paved},
    Tag{"aeroway", "aerodrome", LandCover::grass},
    Tag{"building", "industrial", LandCover::industrial},
    Tag{"building", "warehouse", LandCover::industrial},
    Tag{"building", "", LandCover::built_up},
    Tag{"natural", "wood", LandCover::forest},
    Tag{"natural", "scrub", LandCover::scrub},
    Tag{"natural", "heath", LandCover::scrub},
    Tag{"natural", "grassland", LandCover::grass},
    Tag{"natural", "wetland", LandCover::marsh},
    Tag{"natural", "mud", LandCover::marsh},
    Tag{"natural", "bare_rock", LandCover::rock},
    Tag{"natural", "scree", LandCover::rock},
    Tag{"natural", "shingle", LandCover::sand},
    Tag{"natural", "beach", LandCover::sand},
    Tag{"natural", "sand", LandCover::sand},
    Tag{"natural", "dune", LandCover::sand},
    Tag{"natural", "glacier", LandCover::ice},
    Tag{"natural", "coastline", LandCover::none},
    Tag{"natural", "land", LandCover::none},
    Tag{"landuse", "residential", LandCover::built_up},
    Tag{"landuse", "commercial", LandCover::built_up},
    Tag{"landuse", "retail", LandCover::built_up},
    Tag{"landuse", "industrial", LandCover::industrial},
    Tag{"landuse", "port", LandCover::industrial},
    Tag{"landuse", "harbour", LandCover::industrial},
    Tag{"landuse", "railway", LandCover::industrial},
    Tag{"landuse", "forest", LandCover::forest},
    Tag{"landuse", "meadow", LandCover::grass},
    Tag{"landuse", "grass", LandCover::grass},
    Tag{"landuse", "recreation_ground", LandCover::grass},
    Tag{"landuse", "farmland", LandCover::farmland},
    Tag{"landuse", "orchard", LandCover::farmland},
    Tag{"landuse", "vineyard", LandCover::farmland},
    Tag{"landuse", "quarry", LandCover::rock},
    Tag{"leisure", "park", LandCover::grass},
    Tag{"leisure", "golf_course", LandCover::grass},
    Tag{"leisure", "pitch", LandCover::grass},
};
constexpr std::array kKeys = {"aeroway", "building", "natural", "landuse", "leisure"};

}  // namespace

std::optional<LandCover> cover_named(std::string_view name) {
  const auto found =
      std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.name == name; });
  return found == kNames.end() ? std::nullopt : std::optional(found->is);
}

TaggedCover cover_tagged(const std::function<std::string(const char*)>& value) {
  TaggedCover result;
  for (const char* key : kKeys) {
    const std::string stated = value(key);
    if (stated.empty() || stated == "no") continue;
    if (result.tag.empty()) result.tag = std::string(key) + "=" + stated;
    const auto fits = [&](const Tag& t) {
      return t.key == key && (t.value.empty() || t.value == stated);
    };
    const auto found = std::find_if(kTags.begin(), kTags.end(), fits);
    if (found == kTags.end()) continue;
    result = {found->is, std::string(key) + "=" + stated, found->is == LandCover::none, true};
    if (stated == "wetland") {
      const std::string kind = value("wetland");
      if (kind == "mangrove") result.cover = LandCover::mangrove;
    }
    return result;
  }
  return result;
}

}  // namespace skerry::echo
