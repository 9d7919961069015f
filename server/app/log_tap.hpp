// LogTap: lines of the server's log, for the recorder.
#pragma once

#include <spdlog/details/null_mutex.h>
#include <spdlog/sinks/base_sink.h>

#include <atomic>
#include <string>

#include "server/app/change_log.hpp"
#include "server/recorder/recorder.hpp"

namespace skerry::server {

// A sink of the log that hands on to a recorder, if there is one.  Thread: any.
class LogTap final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  // nullptr: none from now on; when it returns, no line is on its way to the one before.
  void set(Recorder* recorder) {
    const std::lock_guard lock(mutex_);
    recorder_ = recorder;
  }

 private:
  void sink_it_(const spdlog::details::log_msg& line) override {
    if (recorder_ == nullptr) return;
    std::string text(line.payload.data(), line.payload.size());
    const std::string_view logger(line.logger_name.data(), line.logger_name.size());
    if (logger == kControlLogger) {
      recorder_->control_changed(std::move(text));
    } else {
      recorder_->log(static_cast<int>(line.level), std::move(text));
    }
  }
  void flush_() override {}

  Recorder* recorder_ = nullptr;  // under the sink's mutex
};

}  // namespace skerry::server
