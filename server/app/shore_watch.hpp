// ShoreWatch: finds own ships that come upon the chart's land.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "protocol/quantity/length.hpp"
#include "server/app/land_around.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// It stands outside the world, which stays a function of its inputs: what it finds is given to the
// world as an order, and recorded like one (ExerciseOrder.aground).
//
// Looks at the outline of each own ship (world/hull_outline.hpp), at points kSpacing_m apart along
// it, wherever she has gone kSpacing_m further: land of less than that may be missed.  Land is the
// chart's, before it is refined.  A ship that begins upon land, or is put there, lies at a berth
// that the chart does not have: nothing is told until she has been clear of it once.
// Thread: one at a time; answers to surveys may come from any.
class ShoreWatch {
 public:
  static constexpr double kSpacing_m = 5.0;
  static constexpr double kWindow_m = 5.0 * 1852.0;     // of chart about a ship
  static constexpr double kNewWindow_m = 3.0 * 1852.0;  // from its middle: a new one is asked for
  static constexpr int kPatience = 100;
  static constexpr double kMostStep_m = 300.0;  // between two looks; more: she was put there

  // Asks for the chart; the answer may come later, from another thread, or be nothing.
  using SurveyDone = std::function<void(std::optional<echo::CoastChart>)>;
  using Survey = std::function<void(GeoPoint, Length, SurveyDone)>;
  using Aground = std::function<void(std::size_t own_ship, GeoPoint at)>;
  ShoreWatch(Survey survey, Aground aground);

  // The world as it is now; call it with each tick, or now and then.
  void look(const WorldState& state);

 private:
  struct Window {
    Window(echo::CoastChart chart, GeoPoint at)
        : centre(at), land(std::move(chart), at, kWindow_m) {}
    GeoPoint centre;
    LandAround land;
  };
  // Shared with the answer to a survey, which may come after the watch has ended.
  struct Answer {
    std::mutex mutex;
    bool asked = false, failed = false;
    std::unique_ptr<const Window> window;
  };
  struct Watched {
    std::optional<ShipState> last;  // where she was looked at
    bool clear = false;             // she was clear of land since she was put somewhere
  };
  void look(Watched& watched, const ShipState& ship, std::size_t number);
  const LandAround* land_at(GeoPoint place);
  void take_answer(const WorldState& state);

  Survey survey_;
  Aground aground_;
  std::vector<Watched> watched_;
  std::vector<std::unique_ptr<const Window>> windows_;
  int patience_ = 0;  // looks before a chart that could not be read is asked for again
  std::shared_ptr<Answer> answer_ = std::make_shared<Answer>();
};

// True if a point of the ship's outline, at most ShoreWatch::kSpacing_m from the next, is land.
bool is_on_land(const ShipState& ship, const LandAround& land);

}  // namespace skerry::server
