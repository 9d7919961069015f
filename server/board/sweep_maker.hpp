// SweepMaker: the video of a board's channels at one trigger.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "echo/sweeps/sweep_echoes.hpp"
#include "echo/sweeps/sweep_receiver.hpp"
#include "server/board/board_settings.hpp"

namespace skerry::server {

// Cuts a sweep out of the echoes of each channel's radar.  Channels of one radar share its echoes.
// Another radar of the ship is seen with the pulse that it has on the air itself, at this board's
// triggers and azimuth: one antenna, as far as the board can tell.  A radar whose echoes are not to
// be had gives no video: blank codes.  Test patterns take no echoes.
// Thread: the board's.
class SweepMaker {
 public:
  using FindEchoes = std::function<std::shared_ptr<echo::SweepEchoes>(std::uint32_t radar)>;

  SweepMaker(std::uint32_t radar, FindEchoes find) : radar_(radar), find_(std::move(find)) {}

  void set(const BoardSettings& settings) { settings_ = settings; }
  // Before the first sweep of a step: what the radars have on the air may have changed.
  void prepare();
  // Fills the samples of `sweep`, whose meta is complete.
  void make(Azimuth azimuth, ScenarioTime when, bool blanked, board::Sweep& sweep);

 private:
  struct Source {
    std::shared_ptr<echo::SweepEchoes> echoes;  // nullptr: there are none
    std::optional<echo::SweepEchoes::Wish> wish;
    echo::SweepEchoes::Grid grid;
    // The two rows held; good until the step ends.
    bool has_rows = false;
    std::uint64_t row = 0;
    std::span<const float> before, after;
  };
  struct Channel {
    Source* source = nullptr;
    std::unique_ptr<echo::SweepReceiver> receiver;
    echo::SweepEchoes::Grid grid;  // that the receiver is for
  };

  bool has_video(const ChannelSettings& channel) const {
    return channel.is_on() && channel.test_mode == board::TestMode::off;
  }
  echo::SweepEchoes::Wish wish_for(std::uint32_t source) const;
  echo::SweepChannel channel_for(const ChannelSettings& channel) const;
  float find_rows(Source& source, Azimuth azimuth, ScenarioTime when) const;

  std::uint32_t radar_;
  FindEchoes find_;
  BoardSettings settings_;
  std::map<std::uint32_t, Source> sources_;  // by source register
  std::array<Channel, 2> channels_;
};

}  // namespace skerry::server
