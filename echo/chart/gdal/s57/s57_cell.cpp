#include "echo/chart/gdal/s57/s57_cell.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <memory>

namespace skerry::echo {

std::optional<int> S57Feature::integer(const char* attribute) const {
  const int index = feature_.GetFieldIndex(attribute);
  if (index < 0 || !feature_.IsFieldSetAndNotNull(index)) return std::nullopt;
  if (feature_.GetFieldDefnRef(index)->GetType() != OFTStringList)
    return feature_.GetFieldAsInteger(index);
  char** const list = feature_.GetFieldAsStringList(index);
  if (list == nullptr || list[0] == nullptr || list[0][0] == '\0') return std::nullopt;
  return std::atoi(list[0]);
}

std::vector<int> S57Feature::integers(const char* attribute) const {
  const int index = feature_.GetFieldIndex(attribute);
  if (index < 0 || !feature_.IsFieldSetAndNotNull(index)) return {};
  if (feature_.GetFieldDefnRef(index)->GetType() != OFTStringList)
    return {feature_.GetFieldAsInteger(index)};
  std::vector<int> all;
  char** const list = feature_.GetFieldAsStringList(index);
  for (int i = 0; list != nullptr && list[i] != nullptr; ++i) all.push_back(std::atoi(list[i]));
  return all;
}

std::optional<double> S57Feature::real(const char* attribute) const {
  const int index = feature_.GetFieldIndex(attribute);
  if (index < 0 || !feature_.IsFieldSetAndNotNull(index)) return std::nullopt;
  const double value = feature_.GetFieldAsDouble(index);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string S57Feature::text(const char* attribute) const {
  const int index = feature_.GetFieldIndex(attribute);
  if (index < 0 || !feature_.IsFieldSetAndNotNull(index)) return {};
  return feature_.GetFieldAsString(index);
}

bool is_ramark(const S57Feature& feature) {
  constexpr int kRamark = 1;
  return feature.integer("CATRTB") == kRamark;
}

void S57Cell::for_each(const char* object_class,
                       const std::function<void(const S57Feature&)>& visit) const {
  GdalErrors errors;
  OGRLayer* const layer = dataset_.GetLayerByName(object_class);
  if (layer == nullptr) return;
  layer->ResetReading();
  while (true) {
    errors.forget();
    const OGRFeatureUniquePtr feature(layer->GetNextFeature());
    if (!feature) break;
    const std::string name =
        fmt::format("{}: {} {}", file_, object_class, feature->GetFieldAsString("LNAM"));
    const OGRGeometry* geometry = feature->GetGeometryRef();
    const bool whole = geometry != nullptr && !geometry->IsEmpty() &&
                       (errors.count() == 0 || errors.only_of_attributes());
    if (errors.count() > 0 || !whole)
      warnings_.add(fmt::format("{}: {}{}", name,
                                errors.count() > 0 ? errors.text() : "has no geometry",
                                whole ? "" : "; left out"));
    if (!whole) continue;
    visit(S57Feature(*feature, name));
  }
  if (errors.count() > 0)
    warnings_.add(fmt::format("{}: {}: {}", file_, object_class, errors.text()));
}

}  // namespace skerry::echo
