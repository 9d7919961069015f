#include "server/net/common/recording_news.hpp"

#include <utility>

#include "server/net/common/for_strangers.hpp"
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

template <typename State>
void put(RecordingNews::Frames& frames, SharedBytes RecordingNews::Pair::*of, State state) {
  frames.whole.*of = frame_of(state);
  leave_out_for_strangers(state);
  frames.for_strangers.*of = frame_of(std::move(state));
}

// The port's state, if it changed or goes on and was told `every` ago.
template <typename Port, typename Told>
void put_due(RecordingNews::Frames& frames, SharedBytes RecordingNews::Pair::*of, const Port* port,
             Told& told, std::chrono::steady_clock::time_point now,
             std::chrono::milliseconds every) {
  if (port == nullptr) return;
  const std::uint64_t version = port->version();
  const bool changed = told.version != version;
  if (!changed && now - told.at < every) return;
  auto state = port->state();
  if (!changed && !goes_on(state)) return;
  told = {version, now};
  put(frames, of, std::move(state));
}

}  // namespace

RecordingNews::Frames RecordingNews::due(std::chrono::steady_clock::time_point now) {
  Frames frames;
  put_due(frames, &Pair::recorder, host_.recording(), recorder_, now, kWhileRecording);
  put_due(frames, &Pair::playback, host_.playback(), playback_, now, kWhilePlaying);
  return frames;
}

RecordingNews::Frames RecordingNews::all() const {
  Frames frames;
  if (const auto* port = host_.recording()) put(frames, &Pair::recorder, port->state());
  if (const auto* port = host_.playback()) put(frames, &Pair::playback, port->state());
  return frames;
}

}  // namespace skerry::server
