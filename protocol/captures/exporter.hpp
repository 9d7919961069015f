// A radar's picture in a recording as a capture of another protocol.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "protocol/navico/model.hpp"
#include "protocol/pcap/pcap_writer.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/recording/item.hpp"
#include "protocol/recording/reader.hpp"

namespace skerry::captures {

enum class ExportFormat : std::uint8_t { cat240, navico };

struct ExportOptions {
  ExportFormat format = ExportFormat::cat240;
  navico::Model model = navico::Model::halo20;  // halo20, halo or g4
  std::uint32_t radar = 0;
  std::uint32_t view = 0;
  std::optional<UtcTime> from, to;  // absent: all; `to` is not in it
};

struct ExportReport {
  std::uint64_t spokes = 0;
  std::uint64_t spokes_refused = 0;  // that are no spokes
  std::uint64_t spokes_cut = 0;      // reach further than the model can say
  std::uint64_t datagrams = 0;
  std::uint64_t chunks_damaged = 0;  // of the recording, passed over
};

// CAT240: a record per spoke with all of its cells, a summary per turn; SAC 0, SIC the radar.
// Navico: frames of 32 spokes of 1024 cells of 4 bits that end where the recording's do, with
// locator and reports; other numbers of spokes and cells are resampled so that peaks stay.
// Both: position, course and heading as NMEA sentences once a second, where own ship was recorded.
// Error: the recording has no such picture, or `progress` gave up.
Result<ExportReport, recording::RecordingError> export_capture(
    const recording::RecordingReader& reader, const ExportOptions& options, pcap::PcapWriter& out,
    const recording::RecordingReader::Progress& progress = {});

}  // namespace skerry::captures
