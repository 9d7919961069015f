#include "echo/receiver/set_video.hpp"

#include <algorithm>

#include "echo/kernel/video_stages.hpp"

namespace skerry::echo {

SetVideo::SetVideo(const RadarSet& set) : smoothing_(set.video_smoothing) {
  const std::vector<VideoLevel>& levels = set.levels;
  if (levels.empty()) return;
  levels_.assign(256, 0);
  for (std::size_t v = 1; v < levels_.size(); ++v) {
    const double at = (static_cast<double>(v) + 0.5) / 256.0;
    std::size_t k = levels.size();
    while (k > 0 && levels[k - 1].from > at) --k;
    if (k == 0) continue;
    const double from = levels[k - 1].from, to = k < levels.size() ? levels[k].from : 1.0;
    const double into = std::clamp((at - from) / std::max(to - from, 1e-9), 0.0, 0.999);
    levels_[v] = static_cast<std::uint8_t>(std::min(255.0, 16.0 * (levels[k - 1].shown + into)));
  }
}

void SetVideo::smooth(std::span<std::uint8_t> video, std::size_t cells, std::size_t first,
                      std::size_t last, std::vector<std::uint8_t>& scratch) const {
  smooth_video(video, cells, smoothing_, scratch);
  for (std::size_t s = 0; s < video.size(); s += cells) {
    const std::span<std::uint8_t> spoke = video.subspan(s, cells);
    std::fill_n(spoke.begin(), first, std::uint8_t{0});
    std::fill(spoke.begin() + static_cast<std::ptrdiff_t>(last), spoke.end(), std::uint8_t{0});
  }
}

void SetVideo::level(std::span<std::uint8_t> video) const {
  if (levels_.empty()) return;
  for (std::uint8_t& v : video) v = levels_[v];
}

}  // namespace skerry::echo
