#include "server/app/logging_recorder.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "server/app/control/change_log.hpp"

namespace skerry::server {

void LogTap::sink_it_(const spdlog::details::log_msg& line) {
  if (recorder_ == nullptr) return;
  std::string text(line.payload.data(), line.payload.size());
  const std::string_view logger(line.logger_name.data(), line.logger_name.size());
  if (logger == kControlLogger) {
    recorder_->control_changed(std::move(text));
  } else {
    recorder_->log(static_cast<int>(line.level), std::move(text));
  }
}

LoggingRecorder::LoggingRecorder(RadarHost& host, const RecorderConfig& config, LogTap& tap,
                                 AuditLog& audit)
    : recorder(host, config), tap_(tap), audit_(audit) {
  tap_.set(&recorder);
  audit_.give_to([this](const AuditEntryPtr& entry) { recorder.audit(entry); });
}

LoggingRecorder::~LoggingRecorder() {
  audit_.give_to(nullptr);
  tap_.set(nullptr);
}

}  // namespace skerry::server
