#include "server/recorder/target_news.hpp"

namespace skerry::server {
namespace {

// Lists come every TargetPort::kListPeriod; of two one is recorded, whatever moment each has.
constexpr std::uint64_t kListEvery_ns = 800'000'000;

}  // namespace

TargetNews::News TargetNews::take(const TargetPort& port, std::uint32_t radar, std::uint32_t view) {
  News news;
  const auto list = port.targets(radar, view);
  if (list == nullptr) {
    told_.erase({radar, view});
    return news;
  }
  Told& told = told_[{radar, view}];
  if (list != told.list) {
    told.list = list;
    // The time of a playback may go back.
    if (list->utc_ns() < told.utc_ns || list->utc_ns() - told.utc_ns >= kListEvery_ns) {
      told.utc_ns = list->utc_ns();
      news.list = *list;
      for (wire::Target& target : *news.list->mutable_targets()) target.clear_past();
    }
  }
  const auto plots = port.plots(radar, view);
  if (plots != nullptr && plots != told.plots) {
    told.plots = plots;
    if (plots->plots_size() > 0) news.plots = plots;
  }
  return news;
}

}  // namespace skerry::server
