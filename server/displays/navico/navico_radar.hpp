// NavicoRadar: a BR24, 3G, 4G or HALO as chart plotters and OpenCPN meet it.
#pragma once

#include <memory>
#include <string>

#include "protocol/navico/model.hpp"
#include "protocol/quantity/time.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

struct NavicoOptions {
  navico::Model model = navico::Model::halo;
  // 4G and HALO: a second range, B.
  bool second_range = true;
  // Decides the family for displays that find the radar by its locator; empty: one that fits.
  std::string serial = {};
  // BR24, 3G and 4G are fixed and these are not looked at; a HALO's are what its locator says.
  navico::Addresses a = navico::kAddressesA;
  navico::Addresses b = navico::kAddressesB;
  // Standby when no display has said anything for that long; zero: never.
  Duration standby_when_alone{};
  // HALO: own ship's heading, course and speed on its network.
  bool ship_data = true;
};

std::unique_ptr<RadarEmulation> make_navico_radar(const NavicoOptions& options);
EmulationIdentity navico_identity(const NavicoOptions& options);

}  // namespace skerry::server
