#include "server/net/common/recording_news.hpp"

#include <utility>

#include "server/net/common/net_context.hpp"

namespace skerry::server {
namespace {

SharedBytes frame_of(wire::RecorderState state) {
  wire::ServerMessage message;
  *message.mutable_recorder() = std::move(state);
  return make_frame(message);
}

SharedBytes frame_of(wire::PlaybackState state) {
  wire::ServerMessage message;
  *message.mutable_playback() = std::move(state);
  return make_frame(message);
}

bool goes_on(const wire::RecorderState& state) {
  return state.phase() == wire::RecorderState::RECORDING ||
         state.phase() == wire::RecorderState::DISK_FULL;
}

bool goes_on(const wire::PlaybackState& state) { return state.playing(); }

// The port's state, if it changed or goes on and was told `every` ago.
template <typename Port, typename Told>
SharedBytes due_of(const Port* port, Told& told, std::chrono::steady_clock::time_point now,
                   std::chrono::milliseconds every) {
  if (port == nullptr) return nullptr;
  const std::uint64_t version = port->version();
  const bool changed = told.version != version;
  if (!changed && now - told.at < every) return nullptr;
  auto state = port->state();
  if (!changed && !goes_on(state)) return nullptr;
  told = {version, now};
  return frame_of(std::move(state));
}

}  // namespace

RecordingNews::Frames RecordingNews::due(std::chrono::steady_clock::time_point now) {
  return {due_of(host_.recording(), recorder_, now, kWhileRecording),
          due_of(host_.playback(), playback_, now, kWhilePlaying)};
}

RecordingNews::Frames RecordingNews::all() const {
  Frames frames;
  if (const RecordingPort* port = host_.recording()) frames.recorder = frame_of(port->state());
  if (const PlaybackPort* port = host_.playback()) frames.playback = frame_of(port->state());
  return frames;
}

}  // namespace skerry::server
