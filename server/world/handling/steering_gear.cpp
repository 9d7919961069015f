#include "server/world/handling/steering_gear.hpp"

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {

double rudder_after(const SteeringGear& gear, double angle_deg, double order_deg, double after_s) {
  if (gear.rate_deg_s == 0.0) return angle_deg;
  const double order = std::clamp(order_deg, -gear.limit_deg, gear.limit_deg);
  const double left = order - angle_deg;
  const double side = left < 0.0 ? -1.0 : 1.0;
  const double far = std::fabs(left);
  const double near = gear.rate_deg_s * gear.lag_s;  // from here on the lag rules
  if (far > near) {
    const double running_s = (far - near) / gear.rate_deg_s;
    if (after_s < running_s) return angle_deg + side * gear.rate_deg_s * after_s;
    if (gear.lag_s == 0.0) return order;
    return order - side * near * exact_exp(-std::min((after_s - running_s) / gear.lag_s, 600.0));
  }
  if (gear.lag_s == 0.0) return order;
  return order - left * exact_exp(-std::min(after_s / gear.lag_s, 600.0));
}

}  // namespace skerry::server
