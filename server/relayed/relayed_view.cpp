#include "server/relayed/relayed_view.hpp"

#include <algorithm>

#include "protocol/wire/spoke_message.hpp"
#include "server/relayed/spoke_reach.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kLastNumber = 65'535;  // what datagrams can say
constexpr std::size_t kMostAdded = 256;        // views, whatever another server grants

}  // namespace

Length WantedReach::on(RangeScale other) const {
  const double scale_m = other.length().in_metres();
  if (range_m == 0.0) return other.length();
  const double wanted_m = range_m / scale.length().in_metres() * scale_m;
  return metres(std::clamp(wanted_m, kShortestReach * scale_m, kLongestReach * scale_m));
}

void RelayedView::publish(std::vector<std::shared_ptr<Spoke>> spokes) {
  if (spokes.empty()) return;
  const auto reach = reach_.get();
  for (std::shared_ptr<Spoke>& spoke : spokes) {
    const RangeScale scale = spoke->header.range_scale;
    if (reach && reach->on(scale) != spoke->header.reach()) {
      spoke = std::make_shared<Spoke>(reaching(*spoke, reach->on(scale)));
      // Spokes say no instrumented range where it is the range scale.
      if (reach->range_m == 0.0) spoke->header.instrumented_range = {};
    }
    spoke->header.view = number;
    stamp_.put_on(spoke->header);
  }
  const Sector sector{{spokes.begin(), spokes.end()}};
  channel.publish(sector);
  spokes_.fetch_add(sector.spokes.size(), std::memory_order_relaxed);
  scan_.store(sector.spokes.back()->header.scan, std::memory_order_relaxed);
}

void RelayedView::pass_on(const Sector& sector, const std::string& format,
                          const EncodedSectorPtr& encoded) {
  if (sector.spokes.empty()) return;
  channel.publish(sector, format, encoded);
  spokes_.fetch_add(sector.spokes.size(), std::memory_order_relaxed);
  scan_.store(sector.spokes.back()->header.scan, std::memory_order_relaxed);
}

void RelayedView::tell_reach(wire::Settings& settings) const {
  const auto reach = reach_.get();
  const auto scale = RangeScale::find(settings.range_nm());
  if (!reach || !scale) return;
  const bool as_wanted = reach->range_m == 0.0 || *scale == reach->scale;
  settings.set_instrumented_range_m(as_wanted ? reach->range_m : reach->on(*scale).in_metres());
}

RelayedViewList::RelayedViewList(const std::vector<std::uint32_t>& recorded, std::uint32_t shared,
                                 std::size_t ring_sectors, std::uint32_t first_opened)
    : ring_sectors_(ring_sectors), first_opened_(first_opened) {
  RelayedViews views = {std::make_shared<RelayedView>(0, shared, false, ring_sectors)};
  for (const std::uint32_t number : recorded) {
    if (number == 0) continue;
    views.push_back(std::make_shared<RelayedView>(number, number, false, ring_sectors));
    first_opened_ = std::max(first_opened_, number + 1);
  }
  last_number_ = first_opened_ - 1;
  views_.set(std::move(views));
}

RelayedViewPtr RelayedViewList::find(std::uint32_t number) const {
  const auto views = get();
  const auto found = std::find_if(views->begin(), views->end(), [&](const RelayedViewPtr& view) {
    return view->number == number;
  });
  return found == views->end() ? nullptr : *found;
}

RelayedViewPtr RelayedViewList::open(std::uint32_t like,
                                     const std::function<void(VideoChannel&)>& prepare) {
  const std::lock_guard lock(mutex_);
  const auto views = get();
  const auto opened = std::count_if(views->begin(), views->end(),
                                    [](const RelayedViewPtr& view) { return view->opened; });
  const RelayedViewPtr example = find(like);
  if (!example || static_cast<std::size_t>(opened) >= kMaxViews) return nullptr;
  const auto number = next_number();
  return number ? put(*number, example->source, true, prepare) : nullptr;
}

std::optional<std::uint32_t> RelayedViewList::next_number() {
  if (first_opened_ + kMaxViews > kLastNumber) return std::nullopt;
  do {
    last_number_ = last_number_ >= kLastNumber ? first_opened_ : last_number_ + 1;
  } while (find(last_number_) != nullptr);
  return last_number_;
}

RelayedViewPtr RelayedViewList::put(std::uint32_t number, std::uint32_t source, bool opened,
                                    const std::function<void(VideoChannel&)>& prepare) {
  auto view = std::make_shared<RelayedView>(number, source, opened, ring_sectors_);
  prepare(view->channel);
  view->channel.hold(held_bytes_);
  RelayedViews views = *get();
  views.push_back(view);
  views_.set(std::move(views));
  return view;
}

RelayedViewPtr RelayedViewList::add(std::uint32_t number,
                                    const std::function<void(VideoChannel&)>& prepare) {
  const std::lock_guard lock(mutex_);
  if (get()->size() > kMostAdded) return nullptr;
  const auto own = [&]() -> std::optional<std::uint32_t> {
    if (number < first_opened_ && find(number) == nullptr) return number;
    return next_number();
  }();
  return own ? put(*own, *own, false, prepare) : nullptr;
}

void RelayedViewList::take_away(std::uint32_t number) {
  const std::lock_guard lock(mutex_);
  RelayedViews views = *get();
  if (std::erase_if(views, [&](const auto& view) { return view->number == number; }) > 0) {
    views_.set(std::move(views));
  }
}

void RelayedViewList::close(std::uint32_t number) {
  const std::lock_guard lock(mutex_);
  RelayedViews views = *get();
  const auto gone = [&](const RelayedViewPtr& view) {
    return view->opened && view->number == number;
  };
  if (std::erase_if(views, gone) > 0) views_.set(std::move(views));
}

void RelayedViewList::hold(std::size_t max_bytes) {
  const std::lock_guard lock(mutex_);
  held_bytes_ = max_bytes;
  const auto views = get();
  for (const RelayedViewPtr& view : *views) view->channel.hold(max_bytes);
}

}  // namespace skerry::server
