#include "tests/unit/chart_gdal/made_cell.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace skerry::echo {
namespace {

constexpr int kIsolatedNode = 110, kConnectedNode = 120, kEdge = 130;

void put(OGRLayer& layer, OGRFeature& feature) {
  if (layer.CreateFeature(&feature) != OGRERR_NONE)
    throw std::logic_error("the test's cell cannot be written");
}

OGRLayer& layer_of(GDALDataset& dataset, const char* name) {
  OGRLayer* layer = dataset.GetLayerByName(name);
  if (layer == nullptr) throw std::logic_error(std::string("no S-57 layer ") + name);
  return *layer;
}

void put_node(OGRLayer& layer, int kind, std::size_t number, GeoPoint place) {
  OGRFeature feature(layer.GetLayerDefn());
  feature.SetField("RCNM", kind);
  feature.SetField("RCID", static_cast<int>(number));
  OGRPoint point(place.longitude_deg, place.latitude_deg);
  feature.SetGeometry(&point);
  put(layer, feature);
}

}  // namespace

std::size_t MadeCell::node_at(GeoPoint place) {
  const auto found = std::find(nodes_.begin(), nodes_.end(), place);
  if (found != nodes_.end()) return static_cast<std::size_t>(found - nodes_.begin());
  nodes_.push_back(place);
  return nodes_.size() - 1;
}

MadeCell::Use MadeCell::edge_between(GeoPoint a, GeoPoint b) {
  const std::size_t from = node_at(a), to = node_at(b);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].from == from && edges_[i].to == to) return {i, true, false};
    if (edges_[i].from == to && edges_[i].to == from) return {i, false, false};
  }
  edges_.push_back({from, to});
  return {edges_.size() - 1, true, false};
}

void MadeCell::point(const std::string& object_class, GeoPoint place, Attributes attributes) {
  isolated_.push_back(place);
  objects_.push_back({object_class, std::move(attributes), {}, isolated_.size(), 1});
}

void MadeCell::line(const std::string& object_class, const std::vector<GeoPoint>& places,
                    Attributes attributes) {
  Object object{object_class, std::move(attributes), {}, 0, 2};
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    object.edges.push_back(edge_between(places[i], places[i + 1]));
  objects_.push_back(std::move(object));
}

void MadeCell::area(const std::string& object_class,
                    const std::vector<std::vector<GeoPoint>>& rings, Attributes attributes) {
  Object object{object_class, std::move(attributes), {}, 0, 3};
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t i = 0, n = rings[r].size(); i < n; ++i) {
      object.edges.push_back(edge_between(rings[r][i], rings[r][(i + 1) % n]));
      object.edges.back().hole = r > 0;
    }
  }
  objects_.push_back(std::move(object));
}

void MadeCell::write(const std::filesystem::path& file, int scale) const {
  GDALAllRegister();
  int meta = 0;
  for (const Object& object : objects_) meta += object.object_class.starts_with("M_") ? 1 : 0;
  const std::map<std::string, std::size_t> numbers = {
      {"S57_NOMR", static_cast<std::size_t>(meta)},
      {"S57_NOGR", objects_.size() - static_cast<std::size_t>(meta)},
      {"S57_NOIN", isolated_.size()},
      {"S57_NOCN", nodes_.size()},
      {"S57_NOED", edges_.size()},
      {"S57_EDTN", 1},
      {"S57_CSCL", static_cast<std::size_t>(scale)}};
  CPLStringList options;
  for (const auto& [name, value] : numbers)
    options.SetNameValue(name.c_str(), std::to_string(value).c_str());
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("S57");
  GDALDataset* dataset = driver->Create(file.c_str(), 0, 0, 0, GDT_Unknown, options.List());
  if (dataset == nullptr) throw std::logic_error("the test's cell cannot be created");

  for (std::size_t i = 0; i < isolated_.size(); ++i)
    put_node(layer_of(*dataset, "IsolatedNode"), kIsolatedNode, i + 1, isolated_[i]);
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    put_node(layer_of(*dataset, "ConnectedNode"), kConnectedNode, i + 1, nodes_[i]);
  OGRLayer& edges = layer_of(*dataset, "Edge");
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    OGRFeature feature(edges.GetLayerDefn());
    feature.SetField("RCNM", kEdge);
    feature.SetField("RCID", static_cast<int>(i + 1));
    feature.SetField("NAME_RCNM_0", kConnectedNode);
    feature.SetField("NAME_RCID_0", static_cast<int>(edges_[i].from + 1));
    feature.SetField("NAME_RCNM_1", kConnectedNode);
    feature.SetField("NAME_RCID_1", static_cast<int>(edges_[i].to + 1));
    put(edges, feature);
  }
  int number = 0;
  for (const Object& object : objects_) {
    OGRLayer& layer = layer_of(*dataset, object.object_class.c_str());
    OGRFeature feature(layer.GetLayerDefn());
    ++number;
    feature.SetField("RCID", number);
    feature.SetField("PRIM", object.primitive);
    feature.SetField("GRUP", 2);
    feature.SetField("AGEN", 540);
    feature.SetField("FIDN", number);
    feature.SetField("FIDS", 1);
    std::vector<int> kinds, names, ways, usages, masks;
    if (object.isolated > 0) {
      kinds.push_back(kIsolatedNode);
      names.push_back(static_cast<int>(object.isolated));
      ways.push_back(255);
      usages.push_back(255);
    }
    for (const Use& use : object.edges) {
      kinds.push_back(kEdge);
      names.push_back(static_cast<int>(use.edge + 1));
      ways.push_back(use.forward ? 1 : 2);
      usages.push_back(object.primitive == 3 ? (use.hole ? 2 : 1) : 255);
    }
    masks.assign(kinds.size(), 255);
    const int n = static_cast<int>(kinds.size());
    feature.SetField("NAME_RCNM", n, kinds.data());
    feature.SetField("NAME_RCID", n, names.data());
    feature.SetField("ORNT", n, ways.data());
    feature.SetField("USAG", n, usages.data());
    feature.SetField("MASK", n, masks.data());
    for (const auto& [attribute, value] : object.attributes)
      feature.SetField(attribute.c_str(), value.c_str());
    put(layer, feature);
  }
  GDALClose(dataset);
}

}  // namespace skerry::echo
