// TrackRecording: tracks and plots as a recording, for any reader of MCAP.
#pragma once

#include "protocol/recording/writer.hpp"
#include "server/track_tool/track_writer.hpp"

namespace skerry::server {

// A hello, and for each turn the plots found in it and a list of its targets, lost ones as well, at
// the turn's end; turns without either have none.  As a set tells them (targets.proto): motions,
// CPA and TCPA from the second minute on; without alerts and AIS.
class TrackRecording final : public TrackWriter {
 public:
  TrackRecording(const TrackedView& of, TextSink sink);
  TrackRecording(const TrackRecording&) = delete;
  TrackRecording& operator=(const TrackRecording&) = delete;
  void plot(const Plot& plot) override;
  void turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) override;
  void finish() override;

 private:
  void add(recording::Kind kind, Duration since, const google::protobuf::MessageLite& message);
  void write_plots();
  wire::TargetList list_of(std::span<const PlottedTrack> tracked,
                           std::span<const PlottedTrack> lost) const;

  TrackedView of_;
  TextSink sink_;
  recording::RecordingWriter writer_;
  wire::TargetPlots plots_;
  Duration last_plot_{};
  bool begun_ = false;  // the hello is written
};

}  // namespace skerry::server
