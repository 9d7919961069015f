// A TargetPort that has what the test gives it.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/core/target_port.hpp"

namespace skerry::server {

// Of radar 0, view 0.  Thread: any.
class FakePlotters final : public TargetPort {
 public:
  FakePlotters() {
    change([](wire::TargetList& list) { list.set_utc_ns(1'795'000'000'000'000'000); });
  }

  // A target that is tracked, so far east of 0 N 0 E and going west.
  static wire::Target target(std::uint32_t number, double range_m) {
    wire::Target target;
    target.set_number(number);
    target.set_state(wire::TARGET_TRACKED);
    target.set_range_m(range_m);
    target.set_bearing_deg(90.0);
    target.set_longitude_deg(range_m / 111'319.5);
    target.set_course_deg(270.0);
    target.set_speed_kn(9.0);
    target.set_cpa_nm(0.1);
    target.set_tcpa_min(4.0);
    return target;
  }
  void change(const auto& how) {
    const std::lock_guard lock(mutex_);
    how(list_);
    told_ = std::make_shared<const wire::TargetList>(list_);
  }
  // As once nobody wants them any more.
  void forget() {
    const std::lock_guard lock(mutex_);
    told_ = nullptr;
    plots_ = nullptr;
  }
  void tell_plots(wire::TargetPlots plots) {
    const std::lock_guard lock(mutex_);
    plots_ = std::make_shared<const wire::TargetPlots>(std::move(plots));
  }
  void answer(wire::Reply::Code code, const std::string& text) {
    const std::lock_guard lock(mutex_);
    reply_.set_code(code);
    reply_.set_text(text);
  }
  std::vector<wire::TargetOrder> orders() const {
    const std::lock_guard lock(mutex_);
    return orders_;
  }
  bool is_wanted() const { return !lease_.expired(); }

  std::shared_ptr<const void> want(std::uint32_t radar, std::uint32_t view) override {
    const std::lock_guard lock(mutex_);
    if (radar != 0 || view != 0) return nullptr;
    auto lease = lease_.lock();
    if (lease == nullptr) lease_ = lease = std::make_shared<int>(0);
    return lease;
  }
  TargetListPtr targets(std::uint32_t radar, std::uint32_t view) const override {
    const std::lock_guard lock(mutex_);
    if (radar != 0 || view != 0) return nullptr;
    return told_;
  }
  TargetPlotsPtr plots(std::uint32_t radar, std::uint32_t view) const override {
    const std::lock_guard lock(mutex_);
    return radar == 0 && view == 0 ? plots_ : nullptr;
  }
  wire::Reply order(const wire::TargetOrder& order, const std::string&) override {
    const std::lock_guard lock(mutex_);
    orders_.push_back(order);
    return reply_;
  }

 private:
  mutable std::mutex mutex_;
  wire::TargetList list_;
  TargetListPtr told_;  // the list as it is; another one with each change
  TargetPlotsPtr plots_;
  wire::Reply reply_;
  std::vector<wire::TargetOrder> orders_;
  std::weak_ptr<int> lease_;
};

}  // namespace skerry::server
