// Files of AIS into tracks: logs of sentences, tables, captures of networks.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "protocol/quantity/result.hpp"
#include "server/traffic_logs/track_book.hpp"

namespace skerry::server {

enum class LogForm : std::uint8_t { nmea, csv, capture };

struct LogFileRead {
  LogForm form = LogForm::nmea;
  std::uint64_t lines = 0;  // lines, rows or datagrams with sentences
  std::uint64_t used = 0;   // VDM and VDO sentences, or rows
};

// Reads a file, packed by gzip or not, whatever its name: a capture (pcap, pcapng) by its first
// bytes, a table by a first row that names an mmsi, else a log of sentences.  Of a capture the
// datagrams that begin as sentences or as IEC 61162-450 do.  The file is read as a stream.
// `progress` (may be empty) gets the share read, 0 .. 1.
// Error: why the file cannot be read, or which column a table lacks.  What was read is in the book.
Result<LogFileRead, std::string> read_log_file(const std::string& path, TrackBook& book,
                                               const std::function<void(double)>& progress = {});

}  // namespace skerry::server
