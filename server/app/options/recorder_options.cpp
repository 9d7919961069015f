#include "server/app/options/recorder_options.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <string>

#include "server/app/config.pb.h"
#include "server/app/options/field_options.hpp"

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

void add_recorder_options(CLI::App& cli, Recorder& line) {
  FieldOptions add(cli, kRecorderGroup);
  add.flag("--record", line, &Recorder::set_record, "record all radars from the start");
  add.flag("--record-all-views", line, &Recorder::set_record_all_views,
           "record every view of all radars from the start: what each console sees");
  add.text("--record-folder", line, &Recorder::mutable_folder,
           "where recordings go (skerry-recordings)");
  cli.add_option_function<std::string>(
         "--record-compression",
         [&line](const std::string& name) {
           Recorder::Compression compression{};
           if (Recorder::Compression_Parse(name, &compression)) line.set_compression(compression);
         },
         "none, lz4 or zstd (lz4)")
      ->check(CLI::IsMember({"none", "lz4", "zstd"}))
      ->group(kRecorderGroup);
  add.flag("--record-compact", line, &Recorder::set_compact,
           "spokes as differences: smaller, more work");
  const auto number = [&](const char* name, void (Recorder::*set)(std::uint32_t), int least,
                          int most, const char* help) {
    add.number<std::uint32_t>(name, line, set, help)->check(CLI::Range(least, most));
  };
  number("--record-roll-mib", &Recorder::set_roll_mib, 1, 1 << 24,
         "another file after so many MiB (never)");
  number("--record-roll-minutes", &Recorder::set_roll_minutes, 1, 525'600,
         "another file after so many minutes (never)");
  number("--record-keep-gib", &Recorder::set_keep_gib, 1, 1 << 24,
         "remove the oldest recordings beyond so many GiB (keep all)");
  number("--record-keep-hours", &Recorder::set_keep_hours, 1, 876'000,
         "remove recordings older than so many hours (keep all)");
  number("--record-reserve-mib", &Recorder::set_reserve_mib, 0, 1 << 24,
         "free space that is never touched, MiB (512)");
  cli.add_option_function<std::string>(
         "--record-fsync",
         [&line](const std::string& name) {
           Recorder::Fsync::Policy policy{};
           if (Recorder::Fsync::Policy_Parse(name, &policy)) line.set_fsync(policy);
         },
         "what a loss of power may take: chunk (a second), file or none (chunk)")
      ->check(CLI::IsMember({"none", "file", "chunk"}))
      ->group(kRecorderGroup);
}

RecorderConfig recorder_config(const Recorder& said) {
  RecorderConfig config;
  if (!said.folder().empty()) config.folder = said.folder();
  config.record_at_start = said.record() || said.record_all_views();
  config.record_all_views = said.record_all_views();
  if (said.has_compression()) config.compression = compression_of(said.compression());
  config.compact = said.compact();
  config.roll_bytes = std::uint64_t{said.roll_mib()} << 20;
  config.roll_time = std::chrono::minutes(said.roll_minutes());
  config.keep_bytes = std::uint64_t{said.keep_gib()} << 30;
  config.keep_time = std::chrono::hours(said.keep_hours());
  if (said.has_reserve_mib()) config.reserve_bytes = std::uint64_t{said.reserve_mib()} << 20;
  if (said.has_fsync()) config.sync = sync_of(said.fsync());
  return config;
}

}  // namespace skerry::server
