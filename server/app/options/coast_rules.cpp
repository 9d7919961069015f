#include "server/app/options/coast_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>

#include "protocol/quantity/length.hpp"

namespace skerry::server {
namespace {

using echo::CoastStyle;
using echo::CoastType;
using echo::SeriesPhases;

SeriesPhases phases_of(scenario::CoastStyle::Phases phases) {
  switch (phases) {
    case scenario::CoastStyle::cosine:
      return SeriesPhases::cosine;
    case scenario::CoastStyle::alternating:
      return SeriesPhases::alternating;
    default:
      return SeriesPhases::random;
  }
}

// `style` with what the scenario says in its place.  A method is given the dimension nearest to the
// old one that it can have, unless the scenario says which.
// Error: std::invalid_argument for a style that cannot be.
CoastStyle with(const scenario::CoastStyle& said, CoastStyle style) {
  if (said.has_method()) {
    // The schema's names are those of the methods (coast_rules_test).
    style.method = *echo::find_method(scenario::CoastStyle::Method_Name(said.method()));
    style.dimension = std::min(style.dimension, echo::greatest_dimension(style.method));
  }
  if (said.has_dimension()) style.dimension = said.dimension();
  if (said.has_amplitude()) style.amplitude = said.amplitude();
  if (said.has_gamma()) style.gamma = said.gamma();
  if (said.has_phases()) style.phases = phases_of(said.phases());
  try {
    echo::require_valid(style);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(
        fmt::format("{} (method {})", error.what(), echo::name_of(style.method)));
  }
  return style;
}

CoastType type_of(scenario::CoastKind kind) {
  switch (kind) {
    case scenario::artificial:
      return CoastType::artificial;
    case scenario::rocky:
      return CoastType::rocky;
    case scenario::sandy:
      return CoastType::sandy;
    default:
      return CoastType::unknown;
  }
}

// Told of each style that cannot be, by its key; the style is then left as it was.
using Complain = std::function<void(const std::string& key, const std::string& text)>;

echo::CoastRules rules_of(const scenario::Scenario& scenario, const Complain& complain) {
  const auto styled = [&](const scenario::CoastStyle& said, const CoastStyle& style,
                          const std::string& key) {
    try {
      return with(said, style);
    } catch (const std::invalid_argument& error) {
      complain(key, error.what());
      return style;
    }
  };
  echo::CoastRules rules;
  rules.seed = scenario.seed();
  const scenario::Coast& coast = scenario.coast();
  const auto apply = [&](CoastType type, bool said, const scenario::CoastStyle& style,
                         const char* key) {
    CoastStyle& mine = rules.styles[static_cast<std::size_t>(type)];
    if (said) mine = styled(style, mine, key);
  };
  apply(CoastType::unknown, coast.has_unknown(), coast.unknown(), "coast.unknown");
  apply(CoastType::artificial, coast.has_artificial(), coast.artificial(), "coast.artificial");
  apply(CoastType::rocky, coast.has_rocky(), coast.rocky(), "coast.rocky");
  apply(CoastType::sandy, coast.has_sandy(), coast.sandy(), "coast.sandy");
  if (coast.has_guess_kinds()) rules.guess_types = coast.guess_kinds();
  for (int i = 0; i < coast.places_size(); ++i) {
    const scenario::CoastPlace& said = coast.places(i);
    echo::CoastPlace place;
    place.centre = {said.position().lat(), said.position().lon()};
    place.radius_m = nautical_miles(said.radius_nm()).in_metres();
    if (said.has_kind()) place.type = type_of(said.kind());
    if (said.has_style()) {
      const CoastType type = place.type.value_or(CoastType::unknown);
      place.style = styled(said.style(), rules.styles[static_cast<std::size_t>(type)],
                           fmt::format("coast.places[{}].style", i));
    }
    rules.places.push_back(place);
  }
  return rules;
}

}  // namespace

echo::CoastRules coast_rules(const scenario::Scenario& scenario) {
  return rules_of(scenario, [](const std::string& key, const std::string& text) {
    throw std::runtime_error(fmt::format("scenario: {}: {}", key, text));
  });
}

void check_coast(const scenario::Scenario& scenario, YamlSource& source) {
  rules_of(scenario, [&](const std::string& key, const std::string& text) {
    if (source.is_sound(key)) source.refuse(key, text);
  });
}

}  // namespace skerry::server
