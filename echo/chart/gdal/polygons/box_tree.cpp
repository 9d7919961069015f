#include "echo/chart/gdal/polygons/box_tree.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kLeaf = 8;

}  // namespace

BoxTree::BoxTree(const std::vector<PlaneBox>& boxes) {
  items_.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) items_.push_back({boxes[i], i});
  if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
}

void BoxTree::build(std::uint32_t first, std::uint32_t count) {
  PlaneBox box = items_[first].box;
  for (std::uint32_t i = first + 1; i < first + count; ++i) {
    const PlaneBox& one = items_[i].box;
    box = {std::min(box.west, one.west), std::min(box.south, one.south),
           std::max(box.east, one.east), std::max(box.north, one.north)};
  }
  const std::size_t own = nodes_.size();
  nodes_.push_back({box, first, count, 0});
  if (count <= kLeaf) return;
  const bool by_x = box.east - box.west > box.north - box.south;
  const auto begin = items_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](const Item& a, const Item& b) {
    const double at_a = by_x ? a.box.west + a.box.east : a.box.south + a.box.north;
    const double at_b = by_x ? b.box.west + b.box.east : b.box.south + b.box.north;
    return at_a != at_b ? at_a < at_b : a.index < b.index;
  });
  build(first, count / 2);
  nodes_[own].second = static_cast<std::uint32_t>(nodes_.size());
  build(first + count / 2, count - count / 2);
}

}  // namespace skerry::echo
