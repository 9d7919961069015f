// Captures of real radars into recordings.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "protocol/captures/spoke_fitter.hpp"
#include "protocol/captures/survey.hpp"
#include "protocol/pcap/capture_reader.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/recording/item.hpp"
#include "protocol/recording/writer.hpp"

namespace skerry::captures {

struct ImportedRadar {
  SurveyedPicture picture;
  FittedCounts counts;
};

struct ImportReport {
  std::vector<ImportedRadar> radars;  // by their number in the recording
  pcap::CaptureCounts capture;
  std::uint64_t left_out = 0;  // datagrams of more than kMaxPictures pictures
  // The capture is damaged from there on; what is before it was imported.
  std::optional<recording::RecordingError> damage;
};

// Calls its argument with every datagram of a capture, from its beginning, each time it is called;
// gets the share read, which may say "give up" by false.
using DatagramSink = std::function<void(const pcap::Datagram&)>;
using ImportProgress = std::function<bool(double)>;
using CapturePass = std::function<Result<pcap::CaptureCounts, WireError>(const DatagramSink&,
                                                                         const ImportProgress&)>;

// Reads the capture twice: which radars there are, then their spokes.  Writes Hello (a radar for
// every picture), own ship once a second, settings when reports tell others, spokes with the time
// of the capture, an event GAP wherever the capture misses spokes, and `import.json`, which says
// what was captured and what had to be changed.  Does not finish the recording.
// `name` is the capture's, for texts.
// Error: it is no capture, has no picture that can be read, or `progress` gave up.
Result<ImportReport, recording::RecordingError> import_capture(const CapturePass& pass,
                                                               const std::string& name,
                                                               recording::RecordingWriter& writer,
                                                               const ImportProgress& progress = {});
// Imports a file: pcap or pcapng, with or without gzip.
Result<ImportReport, recording::RecordingError> import_capture_file(
    const std::string& path, recording::RecordingWriter& writer,
    const ImportProgress& progress = {});

}  // namespace skerry::captures
