#include "server/recorder/checkpoints.hpp"

#include "protocol/digest/digest.hpp"

namespace skerry::server {

struct Checkpoints::Stretch {
  Sha256 hash;
  std::uint64_t first = 0, spokes = 0;
  UtcTime begun{};

  explicit Stretch(const FramedSpoke& spoke) : first(spoke.sequence), begun(spoke.utc) {}
  void add(const FramedSpoke& spoke) {
    hash.add(spoke.bytes);
    ++spokes;
  }
};

Checkpoints::Checkpoints() = default;
Checkpoints::~Checkpoints() = default;

std::optional<recording::Input> Checkpoints::add(std::uint32_t radar, std::uint32_t view,
                                                 const FramedSpoke& spoke) {
  std::unique_ptr<Stretch>& stretch = stretches_[{radar, view}];
  std::optional<recording::Input> ended;
  const bool goes_on = stretch && spoke.sequence == stretch->first + stretch->spokes &&
                       spoke.utc - stretch->begun < kTime;
  if (!goes_on) {
    if (stretch) ended = end({radar, view}, *stretch);
    stretch = std::make_unique<Stretch>(spoke);
  }
  stretch->add(spoke);
  return ended;
}

std::optional<recording::Input> Checkpoints::take() {
  if (stretches_.empty()) return std::nullopt;
  const auto first = stretches_.begin();
  recording::Input ended = end(first->first, *first->second);
  stretches_.erase(first);
  return ended;
}

recording::Input Checkpoints::end(const View& view, Stretch& stretch) {
  recording::Input input;
  recording::Input::Checkpoint& checkpoint = *input.mutable_checkpoint();
  checkpoint.set_radar(view.first);
  checkpoint.set_view(view.second);
  checkpoint.set_first_sequence(stretch.first);
  checkpoint.set_spokes(stretch.spokes);
  checkpoint.set_sha256(stretch.hash.take());
  return input;
}

}  // namespace skerry::server
