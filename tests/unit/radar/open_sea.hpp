// A chart without land.
#pragma once

#include <string>

#include "echo/chart/chart_source.hpp"

namespace skerry::server {

class OpenSea final : public echo::ChartSource {
 public:
  echo::CoastChart load(GeoPoint, Length) const override { return {}; }
  std::string describe() const override { return "open sea"; }
};

}  // namespace skerry::server
