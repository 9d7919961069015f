#include "echo/coast_tool/printed_picture.hpp"

#include <memory>
#include <vector>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {

CoastPicturePtr printed_picture(const CoastPicture& straight,
                                const as_printed::Parameters& parameters, double diameter_px) {
  const as_printed::Display display{straight.centre, straight.range_m, diameter_px};
  auto picture = std::make_shared<CoastPicture>(straight);
  picture->vertices.clear();
  picture->run_starts.clear();
  picture->shores = {PictureShore{}};
  picture->edge_shores.clear();
  std::vector<as_printed::PixelPoint> line;
  for (std::size_t run = 0; run + 1 < straight.run_starts.size(); ++run) {
    line.clear();
    for (std::uint32_t v = straight.run_starts[run]; v < straight.run_starts[run + 1]; ++v)
      line.push_back(display.to_pixel(straight.vertices[v]));
    as_printed::Parameters own = parameters;
    own.seed = mixed(parameters.seed, run);
    picture->run_starts.push_back(static_cast<std::uint32_t>(picture->vertices.size()));
    for (const as_printed::PixelPoint p : as_printed::refine(line, own))
      picture->vertices.push_back(display.to_plane(p));
  }
  picture->run_starts.push_back(static_cast<std::uint32_t>(picture->vertices.size()));
  return picture;
}

}  // namespace skerry::echo
