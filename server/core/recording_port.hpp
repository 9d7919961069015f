// RecordingPort and PlaybackPort: recorder and playback as the network sees them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/recorder.pb.h"
#include "server/core/answered.hpp"

namespace skerry::server {

// Thread: any; every function returns at once, no disk is waited for.
class RecordingPort {
 public:
  virtual ~RecordingPort() = default;
  // The token is not looked at.  OK to START means that it has begun to begin: a folder that cannot
  // be written shows in state().  `origin`: who asked, as RadarHost::apply() has it.
  virtual wire::Reply record(const wire::Record& record, const std::string& origin) = 0;
  virtual wire::RecorderState state() const = 0;
  // Grows whenever phase, file, marks or problem change.
  virtual std::uint64_t version() const = 0;
};

// Thread: any; every function returns at once.
class PlaybackPort {
 public:
  virtual ~PlaybackPort() = default;
  // The token is not looked at.
  virtual wire::Reply control(const wire::Playback& playback, const std::string& origin) = 0;
  // As RadarHost::apply_or_ask() has it.
  virtual std::optional<wire::Reply> control_or_ask(const wire::Playback& playback,
                                                    const std::string& origin,
                                                    const Answered& /*later*/) {
    return control(playback, origin);
  }
  virtual wire::PlaybackState state() const = 0;
  // Grows whenever anything but the position of a running playback changes.
  virtual std::uint64_t version() const = 0;
};

}  // namespace skerry::server
