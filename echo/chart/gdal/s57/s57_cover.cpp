#include "echo/chart/gdal/s57/s57_cover.hpp"

#include <array>
#include <string_view>

#include "echo/chart/gdal/cover_areas.hpp"

namespace skerry::echo {
namespace {

LandCover cover_of_vegetation(int catveg) {
  switch (catveg) {
    case 1:  // grassland
      return LandCover::grass;
    case 3:  // bush
      return LandCover::scrub;
    case 7:   // mangroves
    case 17:  // nipa palm
    case 21:  // mangrove tree
      return LandCover::mangrove;
    case 10:  // mixed crops
      return LandCover::farmland;
    case 11:  // reed
    case 12:  // moss
      return LandCover::marsh;
    case 4:   // deciduous wood
    case 5:   // coniferous wood
    case 6:   // wood in general
    case 13:  // trees: in general,
    case 14:  // evergreen,
    case 15:  // coniferous,
    case 16:  // palm,
    case 18:  // casuarina,
    case 19:  // eucalypt,
    case 20:  // deciduous,
    case 22:  // filao
      return LandCover::forest;
    default:
      return LandCover::none;
  }
}

LandCover cover_of_region(int catlnd) {
  switch (catlnd) {
    case 1:   // fen
    case 2:   // marsh
    case 3:   // moor, bog
    case 12:  // swamp
    case 15:  // salt pan
      return LandCover::marsh;
    case 4:  // heathland
      return LandCover::scrub;
    case 8:  // paddy field
    case 9:  // agricultural land
      return LandCover::farmland;
    case 10:  // savanna, grassland
    case 11:  // parkland
      return LandCover::grass;
    case 14:  // lava flow
    case 16:  // moraine
    case 19:  // rock column or pinnacle
      return LandCover::rock;
    default:
      return LandCover::none;
  }
}

LandCover cover_of_slope(int catslo) {
  constexpr int kDune = 3, kCliff = 6, kScree = 7;
  if (catslo == kDune) return LandCover::sand;
  return catslo == kCliff || catslo == kScree ? LandCover::rock : LandCover::none;
}

LandCover cover_of(std::string_view object_class, const S57Feature& feature) {
  const auto category = [&](const char* name) { return feature.integer(name).value_or(0); };
  if (object_class == "BUAARE") return LandCover::built_up;
  if (object_class == "PRDARE") return LandCover::industrial;
  if (object_class == "VEGATN") return cover_of_vegetation(category("CATVEG"));
  if (object_class == "LNDRGN") return cover_of_region(category("CATLND"));
  if (object_class == "SLOGRD") return cover_of_slope(category("CATSLO"));
  if (object_class == "ICEARE") return LandCover::ice;
  if (object_class == "AIRARE") return LandCover::grass;
  return LandCover::paved;
}

}  // namespace

void read_cover(const S57Cell& cell, ChartSheet& sheet) {
  TangleBudget budget;
  CoverAreas areas(sheet, cell.warnings(), budget);
  constexpr std::array kClasses = {"LNDRGN", "SLOGRD", "ICEARE", "VEGATN",
                                   "BUAARE", "PRDARE", "AIRARE", "RUNWAY"};
  for (const char* object_class : kClasses) {
    cell.for_each(object_class, [&](const S57Feature& feature) {
      const LandCover cover = cover_of(object_class, feature);
      if (cover != LandCover::none) areas.add(*feature.geometry(), cover, feature.name());
    });
  }
}

}  // namespace skerry::echo
