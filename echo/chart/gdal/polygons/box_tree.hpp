// BoxTree: boxes in a plane, found by what they touch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace skerry::echo {

struct PlaneBox {
  double west, south, east, north;
  bool touches(const PlaneBox& other) const {
    return west <= other.east && other.west <= east && south <= other.north && other.south <= north;
  }
};

// A tree of two branches, halved by the boxes' middles along the longer side: memory by the number
// of boxes alone, however long they are.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<PlaneBox>& boxes);

  // Calls found(index) for each box that touches `area`, until it returns true; whether it did.
  template <typename Found>
  bool find(const PlaneBox& area, Found&& found) const {
    return !nodes_.empty() && find_below(0, area, found);
  }

  // Calls pair(i, j) once for each two boxes that touch, until it returns true.  Gives up after
  // `most` comparisons of boxes or branches.  Returns the number made: above `most` if given up.
  template <typename Pair>
  std::size_t join(std::size_t most, Pair&& pair) const {
    std::size_t made = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
    if (!nodes_.empty()) open.emplace_back(0, 0);
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      const Node &left = nodes_[a], &right = nodes_[b];
      if (++made > most) return made;
      if (a != b && !left.box.touches(right.box)) continue;
      if (left.is_leaf() && right.is_leaf()) {
        for (std::uint32_t i = left.first; i < left.first + left.count; ++i) {
          const std::uint32_t from = a == b ? i + 1 : right.first;
          for (std::uint32_t j = from; j < right.first + right.count; ++j) {
            if (++made > most) return made;
            if (items_[i].box.touches(items_[j].box) && pair(items_[i].index, items_[j].index))
              return made;
          }
        }
      } else if (a == b) {
        open.emplace_back(a + 1, a + 1);
        open.emplace_back(left.second, left.second);
        open.emplace_back(a + 1, left.second);
      } else if (right.is_leaf() || (!left.is_leaf() && left.count >= right.count)) {
        open.emplace_back(a + 1, b);
        open.emplace_back(left.second, b);
      } else {
        open.emplace_back(a, b + 1);
        open.emplace_back(a, right.second);
      }
    }
    return made;
  }

 private:
  struct Item {
    PlaneBox box;
    std::uint32_t index;
  };
  // Its first branch follows it; `second` is its other one, 0 for a leaf.
  struct Node {
    PlaneBox box;
    std::uint32_t first, count, second;
    bool is_leaf() const { return second == 0; }
  };
  void build(std::uint32_t first, std::uint32_t count);

  template <typename Found>
  bool find_below(std::uint32_t at, const PlaneBox& area, Found& found) const {
    const Node& node = nodes_[at];
    if (!node.box.touches(area)) return false;
    if (!node.is_leaf())
      return find_below(at + 1, area, found) || find_below(node.second, area, found);
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (items_[i].box.touches(area) && found(items_[i].index)) return true;
    }
    return false;
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;
};

}  // namespace skerry::echo
