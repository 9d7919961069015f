// SeriesWriter: the items of a recording, into the files of a series.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/recording.pb.h"
#include "protocol/recording/writer.hpp"
#include "server/recorder/disk_writer.hpp"
#include "server/recorder/recorder_config.hpp"

namespace skerry::server {

// Ends chunks by the clock, so that what was given is on its way to the disk kChunkTime later, and
// files by size or time.  A chunk that finds no place is dropped, and what it held is counted; the
// next one that does says so in events, and has again what must not be lost.
// Thread: the recorder's.
class SeriesWriter {
 public:
  using Steady = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kChunkTime{400};
  // While nothing comes to be written, a chunk that says how far the recording has come begins, and
  // ends, so long after the begin of the one before: with kChunkTime, below a second.
  static constexpr std::chrono::milliseconds kQuietTime{600};
  // A file that is gone is followed by another so long after it began: whoever takes away each that
  // is made does not get any number.
  static constexpr std::chrono::seconds kGoneAfter{2};
  static constexpr std::size_t kChunkBytes = 2u << 20;  // before compression
  static constexpr std::size_t kMaxKept = 10'000;       // items that are given again

  // Callbacks in which the recording adds its own items, with add(), keep() and attach().
  struct Additions {
    std::function<void()> file_begins;  // to every file
    std::function<void()> chunk_ends;   // to every chunk
    std::function<void()> quiet;        // to a chunk that has nothing else
    std::function<void()> chunk_lost;   // what was added since the last chunk is not in the file
  };

  // Both must outlive it.  Nothing is written before begin().
  SeriesWriter(const RecorderConfig& config, DiskWriter& disk, Additions additions);

  void begin(const std::string& name, Steady now);
  void add_spoke(const recording::Topic& topic, UtcTime time, std::span<const std::uint8_t> bytes);
  void add(const recording::Item& item);
  // One that is given again if its chunk is lost, unless `most` wait for that.
  void keep(const recording::Item& item, std::size_t most = kMaxKept);
  // Only while a file begins.
  void attach(const recording::Attachment& attachment);
  // Ends chunk and file where it is time.  `now_utc`: of what is added then.
  void look_at_clock(Steady now, UtcTime now_utc);
  void end(UtcTime now_utc);

  std::uint64_t spokes() const { return spokes_; }           // given
  std::uint64_t spokes_dropped() const { return dropped_; }  // in chunks that found no place

 private:
  struct Kept {
    recording::Topic topic;
    UtcTime time;
    Bytes bytes;
    recording::Item item() const { return {topic, time, bytes}; }
  };
  using View = std::pair<std::uint32_t, std::uint32_t>;
  struct Missing {
    std::uint64_t spokes = 0;
    bool disk_was_full = false;
  };

  void open_file();
  void prepare_chunk();  // at its first item
  void note(const recording::Item& item);
  void note_event(const recording::Event& event);
  bool flush();
  bool take(std::span<const std::uint8_t> bytes);

  const RecorderConfig& config_;
  DiskWriter& disk_;
  Additions additions_;
  std::optional<recording::RecordingWriter> writer_;
  Steady now_{}, file_begun_{}, chunk_begun_{};
  UtcTime now_utc_{};
  bool always_ = false;    // begins and ends of files do not wait for room
  bool in_chunk_ = false;  // it has items
  bool preparing_ = false, ending_ = false;
  std::string left_;  // the file that the next was ordered after; empty: the first
  std::size_t chunk_bytes_ = 0;
  std::map<View, std::uint64_t> chunk_spokes_;
  std::vector<Kept> kept_;           // not yet known to be in a file
  std::map<View, Missing> missing_;  // not yet told in a file
  DiskWriter::Taken taken_ = DiskWriter::Taken::yes;
  std::uint64_t spokes_ = 0, dropped_ = 0;
  // Spokes that were taken and then lost by the disk: those reported in a file, and those in the
  // chunk.
  std::uint64_t lost_told_ = 0, lost_in_chunk_ = 0;
};

}  // namespace skerry::server
