// LoggingRecorder: a recorder that also has the lines of the log and the entries of the audit.
#pragma once

#include <spdlog/sinks/base_sink.h>

#include <mutex>

#include "server/audit/audit_log.hpp"
#include "server/recorder/recorder.hpp"

namespace skerry::server {

// Lines of the server's log, for the recorder: a sink of the log that hands on to a recorder, if
// there is one.  Thread: any.
class LogTap final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  // nullptr: none from now on; when it returns, no line is on its way to the one before.
  void set(Recorder* recorder) {
    const std::lock_guard lock(mutex_);
    recorder_ = recorder;
  }

 private:
  void sink_it_(const spdlog::details::log_msg& line) override;
  void flush_() override {}

  Recorder* recorder_ = nullptr;  // under the sink's mutex
};

// They go to the recorder while this lives.
class LoggingRecorder {
 public:
  LoggingRecorder(RadarHost& host, const RecorderConfig& config, LogTap& tap, AuditLog& audit);
  ~LoggingRecorder();
  LoggingRecorder(const LoggingRecorder&) = delete;
  LoggingRecorder& operator=(const LoggingRecorder&) = delete;

  Recorder recorder;

 private:
  LogTap& tap_;
  AuditLog& audit_;
};

}  // namespace skerry::server
