#include "echo/scene/style_refiners.hpp"

#include <algorithm>
#include <mutex>
#include <vector>

namespace skerry::echo {
namespace {

constexpr std::size_t kMostKept = 64;

struct Kept {
  std::mutex mutex;
  std::vector<std::shared_ptr<const EdgeRefiner>> refiners;
};

Kept& kept() {
  static Kept one;
  return one;
}

}  // namespace

std::shared_ptr<const EdgeRefiner> refiner_of(const CoastStyle& style) {
  const std::lock_guard lock(kept().mutex);
  auto& refiners = kept().refiners;
  const auto known = std::find_if(refiners.begin(), refiners.end(),
                                  [&](const auto& r) { return r->style() == style; });
  if (known != refiners.end()) return *known;
  auto made = std::make_shared<const EdgeRefiner>(style);
  if (refiners.size() >= kMostKept) refiners.clear();
  refiners.push_back(made);
  return made;
}

}  // namespace skerry::echo
