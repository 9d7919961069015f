// The methods of refinement as lists for tests, so that a new one is tested without a word.
#pragma once

#include <string>
#include <vector>

#include "echo/fractal/coast_style.hpp"

namespace skerry::scenes {

inline std::vector<echo::CoastMethod> every_method() {
  std::vector<echo::CoastMethod> all;
  for (const echo::CoastMethodRow& row : echo::coast_methods()) all.push_back(row.method);
  return all;
}

// All but straight.
inline std::vector<echo::CoastMethod> every_refining_method() {
  std::vector<echo::CoastMethod> all = every_method();
  std::erase(all, echo::CoastMethod::straight);
  return all;
}

// The name of a parameterised test.
inline constexpr auto kMethodName = [](const auto& method) {
  return std::string(echo::name_of(method.param));
};

}  // namespace skerry::scenes
