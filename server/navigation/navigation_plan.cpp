#include "server/navigation/navigation_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr std::array<std::string_view, kNavigationSentences> kNames = {
    "rmc", "gga", "vtg", "zda", "hdt", "ths", "rot", "vhw", "vbw",
    "rsd", "osd", "vdm", "vdo", "ttm", "tll", "ttd", "tlb", "alf",
    "alc", "alr", "rsa", "rpm", "dpt", "mwv", "mwd", "vdr", "xte"};
constexpr std::uint32_t kMostMmsi = 999'999'999;

bool is_ais(NavigationSentence sentence) {
  return sentence == NavigationSentence::vdm || sentence == NavigationSentence::vdo;
}

std::string seconds(Duration period) { return fmt::format("{} s", in_seconds(period)); }

bool within(double value, double least, double most) { return value >= least && value <= most; }

}  // namespace

std::string_view name_of(NavigationSentence sentence) {
  return kNames[static_cast<std::size_t>(sentence)];
}

std::optional<NavigationSentence> find_navigation_sentence(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<NavigationSentence>(i);
  }
  return std::nullopt;
}

std::map<NavigationSentence, Duration> NavigationPlan::usual_periods() {
  using enum NavigationSentence;
  return {{rmc, 1s},    {gga, 1s}, {vtg, 1s}, {zda, 1s},    {hdt, 100ms}, {ths, 100ms},
          {rot, 500ms}, {vhw, 1s}, {vbw, 1s}, {rsd, 1s},    {osd, 1s},    {vdm, kAsAisDoes},
          {vdo, 1s},    {ttm, 2s}, {tll, 2s}, {rsa, 500ms}, {rpm, 1s},    {dpt, 1s},
          {mwv, 1s},    {mwd, 1s}, {vdr, 1s}, {xte, 1s}};
}

bool is_of_targets(NavigationSentence sentence) {
  return sentence >= NavigationSentence::ttm && sentence <= NavigationSentence::tlb;
}

bool is_of_alerts(NavigationSentence sentence) {
  return sentence >= NavigationSentence::alf && sentence <= NavigationSentence::alr;
}

bool needs_plotter(const NavigationPlan& plan) {
  return std::any_of(plan.periods.begin(), plan.periods.end(), [&](const auto& each) {
    return is_of_alerts(each.first) ||
           (is_of_targets(each.first) && plan.targets == TargetSource::plotted);
  });
}

std::optional<std::string> fault_in(const NavigationPlan& plan) {
  for (const auto& [sentence, period] : plan.periods) {
    if (period == kAsAisDoes && is_ais(sentence)) continue;
    if (period < kShortestNavigationPeriod || period > kLongestNavigationPeriod) {
      return fmt::format("the period of {} is {}; it must be {} to {}", name_of(sentence),
                         seconds(period), seconds(kShortestNavigationPeriod),
                         seconds(kLongestNavigationPeriod));
    }
  }
  if (plan.static_period != kAsAisDoes && (plan.static_period < std::chrono::seconds(1) ||
                                           plan.static_period > kLongestNavigationPeriod)) {
    return fmt::format("the period of AIS names is {}; it must be 1 s to {}",
                       seconds(plan.static_period), seconds(kLongestNavigationPeriod));
  }
  if (plan.own_mmsi > kMostMmsi) {
    return fmt::format("MMSI {} has more than nine digits", plan.own_mmsi);
  }
  if (!within(plan.ais_range_nm, 1.0, 1000.0)) {
    return fmt::format("an AIS range of {} NM is not 1 to 1000", plan.ais_range_nm);
  }
  if (!within(plan.tracking_range_nm, 0.1, 120.0)) {
    return fmt::format("a tracking range of {} NM is not 0.1 to 120", plan.tracking_range_nm);
  }
  if (plan.tracked_targets < 1 || plan.tracked_targets > 99) {
    return fmt::format("{} tracked targets are not 1 to 99", plan.tracked_targets);
  }
  return std::nullopt;
}

}  // namespace skerry::server
