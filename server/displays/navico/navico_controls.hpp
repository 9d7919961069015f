// NavicoControls: what a Navico display's commands mean to a radar of the server, and what its
// settings look like in reports.  No sockets, no time.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/navico/command.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// The controls of one range, A or B.  A display reads back exactly the value it set.  Levels of
// 0..255 and steps of 0..3 are shares of 100.  Values for which the server has no setting (local
// interference, sea state, parking, light) are remembered here.
class NavicoControls {
 public:
  explicit NavicoControls(navico::Model model) : model_(model) {}

  // The command as a Set; nullopt if the radar does not know the command or the value.  A command
  // that only changes a remembered value gives an empty Set.  Not for transmit or requests.
  std::optional<wire::Set> change(const navico::Command& command, const wire::Settings& settings);
  // Takes note of settings, by whomever they were changed.
  void observe(const wire::Settings& settings);

  // The range a display set, while the range scale still is what came of it; else the range scale,
  // or the most that the radar has.
  std::uint32_t range_dm(const wire::Settings& settings) const;

  navico::ControlReport controls(const wire::Settings& settings) const;
  navico::AdvancedReport advanced(const wire::Settings& settings) const;
  navico::InstallationReport installation(const wire::Settings& settings) const;
  navico::BlankedSectors sectors(const wire::Settings& settings) const;

 private:
  bool set_range(const navico::Command& command, wire::Set& set);
  bool set_sector(const navico::Command& command, const wire::Settings& settings, wire::Set& set);
  bool set_sea(const navico::Command& command, wire::Set& set);
  bool set_step(const navico::Command& command, wire::Set& set);
  bool set_installation(const navico::Command& command, wire::Set& set);

  navico::Model model_;
  std::uint32_t asked_dm_ = 0;  // range, 0: none
  double asked_scale_nm_ = 0.0;
  double sea_by_hand_ = 25.0;  // 0 .. 100
  double sea_adjust_ = 0.0;    // -50 .. 50 around automatic
  std::uint8_t sea_auto_ = 1;  // which automatic: 1 harbour, 2 offshore
  std::uint8_t sea_state_ = 1;
  std::uint8_t local_interference_ = 0;
  std::uint8_t accent_light_ = 0;
  std::uint16_t parking_ = 0;
  navico::BlankedSectors asked_sectors_;
};

// The smallest range scale that holds `range_dm`; the largest if none does.
double range_scale_nm(std::uint32_t range_dm);

}  // namespace skerry::server
