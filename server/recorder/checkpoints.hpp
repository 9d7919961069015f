// Checkpoints: what the video was, for recordings of inputs alone.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "protocol/recording/inputs.pb.h"
#include "server/recorder/spoke_frame.hpp"

namespace skerry::server {

// SHA-256 of the wire::Spoke messages of each view, over stretches without a gap of kTime each.
// Thread: one at a time.
class Checkpoints {
 public:
  static constexpr Duration kTime = std::chrono::seconds(2);

  Checkpoints();
  ~Checkpoints();

  // A checkpoint that this spoke ends, as it is not the next one or kTime after the first.
  std::optional<recording::Input> add(std::uint32_t radar, std::uint32_t view,
                                      const FramedSpoke& spoke);
  // The next view's open checkpoint: begun and not ended.
  std::optional<recording::Input> take();

 private:
  struct Stretch;
  using View = std::pair<std::uint32_t, std::uint32_t>;
  static recording::Input end(const View& view, Stretch& stretch);
  std::map<View, std::unique_ptr<Stretch>> stretches_;
};

}  // namespace skerry::server
