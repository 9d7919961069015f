#include "protocol/signalk/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace skerry::signalk {
namespace {

struct Rgba {
  double red, green, blue, alpha;
};

// From the weakest echo to the strongest: blue, green, yellow, red.  The weakest let the chart
// through, so that receiver noise does not hide it.
constexpr std::array<Rgba, 5> kStrengths = {
    {{0, 48, 160, 0}, {0, 96, 255, 255}, {0, 208, 64, 255}, {255, 224, 0, 255}, {255, 32, 0, 255}}};

std::string text_of_colour(const Rgba& c) {
  const auto byte = [](double v) { return static_cast<unsigned>(v + 0.5); };
  return fmt::format("#{:02x}{:02x}{:02x}{:02x}", byte(c.red), byte(c.green), byte(c.blue),
                     byte(c.alpha));
}

Rgba strength(double part) {
  const double place = std::clamp(part, 0.0, 1.0) * (kStrengths.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kStrengths.size() - 2);
  const Rgba &a = kStrengths[below], &b = kStrengths[below + 1];
  const double k = place - static_cast<double>(below);
  const auto between = [k](double from, double to) { return from + (to - from) * k; };
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue),
          between(a.alpha, b.alpha)};
}

Json pixel(const char* type, const Rgba& colour) {
  return Json{{"type", type}, {"color", text_of_colour(colour)}};
}

}  // namespace

Json legend_document(const Legend& legend) {
  Json pixels = Json::array();
  for (std::uint32_t level = 0; level < legend.levels; ++level) {
    const Rgba colour = level == 0 ? Rgba{0, 0, 0, 0} : strength(level / (legend.levels - 1.0));
    pixels.push_back(pixel("normal", colour));
  }
  pixels.push_back(pixel("targetBorder", {200, 200, 200, 255}));
  pixels.push_back(pixel("dopplerApproaching", {255, 0, 255, 255}));
  pixels.push_back(pixel("dopplerReceding", {0, 224, 255, 255}));
  for (std::uint32_t age = 0; age < Legend::kHistory; ++age) {
    const double fade = 1.0 - age / static_cast<double>(Legend::kHistory);
    pixels.push_back(pixel("history", {160 * fade, 160 * fade, 160 * fade, 255}));
  }
  return Json{{"lowReturn", legend.low_return()},
              {"mediumReturn", legend.medium_return()},
              {"strongReturn", legend.strong_return()},
              {"targetBorder", legend.target_border()},
              {"dopplerApproaching", legend.doppler_approaching()},
              {"dopplerReceding", legend.doppler_receding()},
              {"historyStart", legend.history_start()},
              {"pixelColors", legend.levels},
              {"pixels", std::move(pixels)}};
}

}  // namespace skerry::signalk
