#include "server/radar/radar_view.hpp"

#include <algorithm>

namespace skerry::server {

echo::ViewControls RadarView::controls_in_force() const {
  echo::ViewControls own = *controls.get();
  if (!followed) return own;
  const double instrumented_range_m = own.instrumented_range_m;
  own = *followed->controls.get();
  own.instrumented_range_m = instrumented_range_m;
  return own;
}

void RadarView::set_controls(const echo::ViewControls& wanted) {
  controls.set(wanted);
  if (!followed) return;
  echo::ViewControls theirs = wanted;
  theirs.instrumented_range_m = followed->controls.get()->instrumented_range_m;
  if (!(theirs == *followed->controls.get())) followed->controls.set(theirs);
}

RadarViewList::RadarViewList(const echo::ViewControls& controls, std::size_t ring_sectors)
    : ring_sectors_(ring_sectors),
      views_(RadarViews{std::make_shared<RadarView>(0, controls, ring_sectors)}) {}

RadarViewPtr RadarViewList::find(std::uint32_t number) const {
  const auto views = get();
  const auto found = std::find_if(views->begin(), views->end(),
                                  [&](const RadarViewPtr& view) { return view->number == number; });
  return found == views->end() ? nullptr : *found;
}

RadarViewPtr RadarViewList::open(std::uint32_t like, bool follows,
                                 const std::function<void(VideoChannel&)>& prepare) {
  const std::lock_guard lock(mutex_);
  RadarViews views = *get();
  if (views.size() >= kMaxViews) return nullptr;
  do {
    last_number_ = last_number_ == kLastNumber ? 1 : last_number_ + 1;
  } while (find(last_number_) != nullptr);
  const RadarViewPtr example = find(like);
  echo::ViewControls controls = example->controls_in_force();
  if (follows) {
    controls.instrumented_range_m = 0.0;
    const RadarViewPtr followed = example->follows() ? example->followed : example;
    views.push_back(std::make_shared<RadarView>(last_number_, controls, ring_sectors_, followed));
  } else {
    views.push_back(std::make_shared<RadarView>(last_number_, controls, ring_sectors_));
  }
  prepare(views.back()->channel);
  RadarViewPtr opened = views.back();
  views_.set(std::move(views));
  return opened;
}

void RadarViewList::close(std::uint32_t number) {
  const std::lock_guard lock(mutex_);
  RadarViews views = *get();
  const auto gone = [&](const RadarViewPtr& view) { return number != 0 && view->number == number; };
  if (std::erase_if(views, gone) > 0) views_.set(std::move(views));
}

}  // namespace skerry::server
