// NavigationListener: what an outside simulator's sentences make of own ship.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/nmea/con_command.hpp"
#include "protocol/nmea/sentence.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/targets.pb.h"
#include "server/core/traffic.hpp"

namespace skerry::server {

// The result of one line.
struct HeardLine {
  std::optional<OwnShipFix> fix;  // only what the sentence said
  // What it orders of the con.
  std::optional<nmea::ConCommand> command = {};
  // What it orders of alerts.
  std::optional<wire::TargetOrder> alert_order = {};
  // The position is so many metres from the last one, further than her speed explains.
  std::optional<double> jump_m;
  std::string fault = {};  // why the line could not be read; empty: it could
};

// Takes RMC, GGA, GLL, VTG, HDT, THS, VBW, VHW and ROT of any talker, and orders to the con: HTC,
// HSC, ROR, PRC, ETL and TRC (nmea/con_command.hpp), and orders about alerts: ACN and ACK.  What
// says of itself that it is not valid, and all other sentences, are passed over without a fault.
//
// Course and speed over ground are RMC's, VTG's and the ground part of VBW; speed through the water
// (VBW, VHW) stands for them, along the heading, only while none of those has come for
// kGroundSpeedLasts.  VBW needs a heading to have a course: of HDT, THS or VHW.  Astern is a course
// the other way, so speeds are never negative.
//
// A jump is obeyed, since an instructor may put her simulator's ship elsewhere; only told.
// No clock, no sockets.  Thread: one at a time.
class NavigationListener {
 public:
  static constexpr Duration kGroundSpeedLasts = std::chrono::seconds(5);
  // Positions may differ by so much from what motion explains, besides twice that motion.
  static constexpr double kJumpSlack = 100.0;  // metres
  // Own ships are not driven faster than this: it is no ship.
  static constexpr double kMostSpeedMps = 100.0;  // 194 kn, as OwnShipFix

  // After so long without a fix the next one begins anew, and no jump is seen in it.
  explicit NavigationListener(Duration silence) : silence_(silence) {}

  // `now` is of any steady clock and does not go back.
  HeardLine hear(std::string_view line, ScenarioTime now);

 private:
  using Fix = std::optional<OwnShipFix>;
  Fix read(const nmea::Sentence& sentence, ScenarioTime now, std::string& fault);
  Fix read_log(const nmea::Sentence& sentence, ScenarioTime now, std::string& fault);
  void over_ground(OwnShipFix& fix, std::optional<double> speed_kn,
                   std::optional<double> course_deg, ScenarioTime now);
  bool lacks_ground_speed(ScenarioTime now) const;
  std::optional<double> jump(GeoPoint to, ScenarioTime now) const;

  Duration silence_;
  std::optional<ScenarioTime> last_fix_, ground_speed_at_, position_at_;
  GeoPoint position_;
  std::optional<double> heading_deg_, speed_mps_;
};

}  // namespace skerry::server
