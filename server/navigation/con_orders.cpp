#include "server/navigation/con_orders.hpp"

#include <algorithm>

namespace skerry::server {
namespace {

constexpr double kHardOver_deg = 35.0;
constexpr double kMostTurn_deg_min = 720.0;

}  // namespace

wire::ConOrder con_order_of(const nmea::ConCommand& command) {
  wire::ConOrder order;
  const bool by_hand = command.mode == nmea::SteeringMode::hand ||
                       (!command.mode && command.rudder_deg && !command.heading_deg);
  if (by_hand && command.rudder_deg) {
    order.set_rudder_deg(std::clamp(*command.rudder_deg, -kHardOver_deg, kHardOver_deg));
  } else if (by_hand) {
    order.set_steering(wire::STEERING_HAND);
  } else if (const auto heading = command.heading_deg ? command.heading_deg : command.track_deg) {
    order.set_heading_deg(*heading);
  } else if (command.mode == nmea::SteeringMode::heading) {
    order.set_steering(wire::STEERING_HEADING);
  } else if (command.mode == nmea::SteeringMode::track) {
    order.set_steering(wire::STEERING_TRACK);
  }
  if (command.turn_rate_deg_min && !by_hand) {
    order.set_turn_rate_deg_min(std::min(*command.turn_rate_deg_min, kMostTurn_deg_min));
  }
  if (command.lever_percent && command.shaft.value_or(0) <= 1) {
    order.set_engine_percent(*command.lever_percent);
  }
  if (command.bow_thruster_percent) order.set_bow_thruster_percent(*command.bow_thruster_percent);
  if (command.stern_thruster_percent) {
    order.set_stern_thruster_percent(*command.stern_thruster_percent);
  }
  return order;
}

}  // namespace skerry::server
