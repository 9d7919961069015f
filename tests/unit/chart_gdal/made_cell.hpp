// MadeCell: an S-57 cell written for a test, by GDAL's own writer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Nodes, edges and objects on them; write() makes a file of edition 1, update 0, COMF 1e7.
class MadeCell {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  // A point object.
  void point(const std::string& object_class, GeoPoint place, Attributes attributes = {});
  // A line object on edges made before, or on a new one.
  void line(const std::string& object_class, const std::vector<GeoPoint>& places,
            Attributes attributes = {});
  // An area bounded by rings, the first its outer one; `along_edges` makes an edge of every two
  // neighbours, so that lines can be laid along parts of it.
  void area(const std::string& object_class, const std::vector<std::vector<GeoPoint>>& rings,
            Attributes attributes = {});

  void write(const std::filesystem::path& file, int scale = 20000) const;

 private:
  struct Edge {
    std::size_t from, to;  // nodes
  };
  struct Use {
    std::size_t edge;
    bool forward, hole;
  };
  struct Object {
    std::string object_class;
    Attributes attributes;
    std::vector<Use> edges;
    std::size_t isolated = 0;  // number of the isolated node, from 1; 0: none
    int primitive = 1;
  };
  std::size_t node_at(GeoPoint place);
  Use edge_between(GeoPoint a, GeoPoint b);

  std::vector<GeoPoint> isolated_, nodes_;
  std::vector<Edge> edges_;
  std::vector<Object> objects_;
};

}  // namespace skerry::echo
