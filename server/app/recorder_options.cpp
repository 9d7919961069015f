#include "server/app/recorder_options.hpp"

#include <CLI/CLI.hpp>
#include <chrono>

#include "server/app/config.pb.h"

namespace skerry::server {
namespace {

using app::Recorder;

constexpr const char* kRecorderGroup = "Recorder";

recording::Compression compression_of(Recorder::Compression compression) {
  switch (compression) {
    case Recorder::none:
      return recording::Compression::none;
    case Recorder::zstd:
      return recording::Compression::zstd;
    default:
      return recording::Compression::lz4;
  }
}

Sync sync_of(Recorder::Fsync::Policy fsync) {
  switch (fsync) {
    case Recorder::Fsync::none:
      return Sync::none;
    case Recorder::Fsync::file:
      return Sync::file;
    default:
      return Sync::chunk;
  }
}

}  // namespace

void add_recorder_options(CLI::App& cli, RecorderOptions& options) {
  cli.add_flag("--record", options.record, "record all radars from the start")
      ->group(kRecorderGroup);
  cli.add_flag("--record-all-views", options.record_all_views,
               "record every view of all radars from the start: what each console sees")
      ->group(kRecorderGroup);
  cli.add_option("--record-folder", options.folder, "where recordings go (skerry-recordings)")
      ->group(kRecorderGroup);
  cli.add_option("--record-compression", options.compression, "none, lz4 or zstd (lz4)")
      ->check(CLI::IsMember({"none", "lz4", "zstd"}))
      ->group(kRecorderGroup);
  cli.add_flag("--record-compact", options.compact, "spokes as differences: smaller, more work")
      ->group(kRecorderGroup);
  cli.add_option("--record-roll-mib", options.roll_mib, "another file after so many MiB (never)")
      ->check(CLI::Range(1, 1 << 24))
      ->group(kRecorderGroup);
  cli.add_option("--record-roll-minutes", options.roll_minutes,
                 "another file after so many minutes (never)")
      ->check(CLI::Range(1, 525'600))
      ->group(kRecorderGroup);
  cli.add_option("--record-keep-gib", options.keep_gib,
                 "remove the oldest recordings beyond so many GiB (keep all)")
      ->check(CLI::Range(1, 1 << 24))
      ->group(kRecorderGroup);
  cli.add_option("--record-keep-hours", options.keep_hours,
                 "remove recordings older than so many hours (keep all)")
      ->check(CLI::Range(1, 876'000))
      ->group(kRecorderGroup);
  cli.add_option("--record-reserve-mib", options.reserve_mib,
                 "free space that is never touched, MiB (512)")
      ->check(CLI::Range(0, 1 << 24))
      ->group(kRecorderGroup);
  cli.add_option("--record-fsync", options.fsync,
                 "what a loss of power may take: chunk (a second), file or none (chunk)")
      ->check(CLI::IsMember({"none", "file", "chunk"}))
      ->group(kRecorderGroup);
}

RecorderConfig recorder_config(const Recorder& in_file, const RecorderOptions& options) {
  Recorder file = in_file;
  if (options.folder) file.set_folder(*options.folder);
  if (options.record) file.set_record(true);
  if (options.record_all_views) file.set_record_all_views(true);
  if (options.compact) file.set_compact(true);
  if (options.roll_mib) file.set_roll_mib(*options.roll_mib);
  if (options.roll_minutes) file.set_roll_minutes(*options.roll_minutes);
  if (options.keep_gib) file.set_keep_gib(*options.keep_gib);
  if (options.keep_hours) file.set_keep_hours(*options.keep_hours);
  if (options.reserve_mib) file.set_reserve_mib(*options.reserve_mib);
  Recorder::Compression compression{};
  if (options.compression && Recorder::Compression_Parse(*options.compression, &compression)) {
    file.set_compression(compression);
  }
  Recorder::Fsync::Policy fsync{};
  if (options.fsync && Recorder::Fsync::Policy_Parse(*options.fsync, &fsync)) file.set_fsync(fsync);
  RecorderConfig config;
  if (!file.folder().empty()) config.folder = file.folder();
  config.record_at_start = file.record() || file.record_all_views();
  config.record_all_views = file.record_all_views();
  if (file.has_compression()) config.compression = compression_of(file.compression());
  config.compact = file.compact();
  config.roll_bytes = std::uint64_t{file.roll_mib()} << 20;
  config.roll_time = std::chrono::minutes(file.roll_minutes());
  config.keep_bytes = std::uint64_t{file.keep_gib()} << 30;
  config.keep_time = std::chrono::hours(file.keep_hours());
  if (file.has_reserve_mib()) config.reserve_bytes = std::uint64_t{file.reserve_mib()} << 20;
  if (file.has_fsync()) config.sync = sync_of(file.fsync());
  return config;
}

}  // namespace skerry::server
