// TablesAhead: what another range scale needs, made before it goes on the air.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>

#include "echo/receiver/controls.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::server {

// Tables of set, weather and range scale take tens of milliseconds, several sectors.  They are
// shared by all who hold them (echo/kernel/shared_tables.hpp), so it is enough that somebody makes
// and holds them meanwhile: a thread for the while, one at a time.
// Thread: one at a time (the radar's).
class TablesAhead {
 public:
  struct Wish {
    RangeScale range;
    echo::RadarControls controls;
    friend bool operator==(const Wish&, const Wish&) = default;
  };
  // Makes all of it and returns what holds it.
  using Make = std::function<std::shared_ptr<const void>()>;

  // A wish that has waited so long unchanged is granted as it is.
  static constexpr std::chrono::milliseconds kPatience{5000};
  explicit TablesAhead(std::chrono::milliseconds patience = kPatience) : patience_(patience) {}

  // True once what make() returns for that wish is held, until let_go().  A wish begins to be
  // served when it is first asked for and no other is in hand.
  bool ready(const Wish& wish, const std::function<Make()>& make);
  // The tables are in use, or not wanted any more.
  void let_go();

 private:
  void take_made();

  std::chrono::milliseconds patience_;
  Wish wished_;     // last
  Wish asked_for_;  // while running_ or held_
  std::future<std::shared_ptr<const void>> running_;
  std::shared_ptr<const void> held_;
  std::chrono::steady_clock::time_point since_;
  bool waits_ = false;  // since_ is wished_'s
};

}  // namespace skerry::server
