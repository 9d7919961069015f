// PpiPicture: a scan as a mariner sees it, with range rings, heading line, bearing scale and
// labels.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "protocol/picture/canvas.hpp"
#include "protocol/picture/ppi_raster.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry {

enum class Palette : std::uint8_t { amber, green };

struct PpiOptions {
  int size = 1024;  // pixels, kMinPictureSize .. kMaxPictureSize
  Orientation orientation = Orientation::north_up;
  Palette palette = Palette::amber;
  bool range_rings = true;
  bool heading_line = true;
  bool labels = true;  // left out below kLabelSize all the same
};

inline constexpr int kMinPictureSize = 64;
inline constexpr int kMaxPictureSize = 8192;
inline constexpr int kLabelSize = 384;

// Label texts that the spokes do not hold.
struct PpiLabels {
  std::string radar{};                       // its name
  std::optional<wire::Settings> settings{};  // gain, sea, rain
  std::optional<wire::OwnShip> own_ship{};   // name, speed
  bool formed_of_pulses = false;  // a missing spoke had none, instead of having been lost
  std::string warning{};          // a line of its own
};

// The place of the video in a picture of these options.
PpiFrame frame_of(const PpiOptions& options);

// The colour of each level; level 0 is the background.
std::array<Rgba, 256> colours_of(Palette palette);
// The same of echoes that come nearer (red) or go away (blue), in either palette.
std::array<Rgba, 256> colours_of(DopplerClass motion, Palette palette);

// Requires kMinPictureSize <= options.size <= kMaxPictureSize.  Pure.  Thread: any.
RgbaImage draw_ppi(const Scan& scan, const PpiOptions& options, const PpiLabels& labels);

}  // namespace skerry
