// Recorder: writes what a host's radars show to the disk, when told to.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "server/core/audit_port.hpp"
#include "server/core/radar_host.hpp"
#include "server/core/recording_port.hpp"
#include "server/recorder/disk_writer.hpp"
#include "server/recorder/full_disk_log.hpp"
#include "server/recorder/recorder_config.hpp"
#include "server/recorder/recording_session.hpp"

namespace skerry::server {

// Its thread "recorder" takes and packs, "recorder-disk" waits for the disk.  Nothing is opened,
// made or read before the first START, but the disk is asked what is free.
// Use: construct; start() once the host's channels have the format; stop() before the host ends.
class Recorder final : public RecordingPort {
 public:
  static constexpr std::uint32_t kMaxMarks = 10'000;  // of a recording
  static constexpr std::size_t kMaxWaiting = 1000;    // orders, lines of the log, entries

  // The host must outlive it.
  Recorder(RadarHost& host, RecorderConfig config);
  ~Recorder() override;  // stop()

  // Begins to record if the configuration says so.
  void start();
  // Finishes the file; waits for the disk.  A stopped recorder stays stopped.
  // Thread: start() and stop() from one thread.
  void stop();

  // Thread: any.
  wire::Reply record(const wire::Record& record, const std::string& origin) override;
  wire::RecorderState state() const override;
  std::uint64_t version() const override;
  // A line of the server's log, of spdlog's level, and one that says which control was changed:
  // they are recorded if anything is.  Does not log itself.
  void log(int level, std::string text);
  void control_changed(std::string text);
  // An entry of the audit; also the one that says who had the recording started.
  void audit(AuditEntryPtr entry);

 private:
  struct Order {
    enum class Kind : std::uint8_t { start, stop, mark, log, control, audit } kind;
    std::string text;    // of a mark its name, or the line
    std::string origin;  // who asked
    int level = 0;
    RecordingSession::Plan plan = {};
    AuditEntryPtr entry = nullptr;
  };

  wire::Reply begin(const wire::Record& record, const std::string& origin);
  void note(Order order);
  void wake();
  void run();
  void carry_out(Order order, std::chrono::steady_clock::time_point now);
  void look_at_session(std::chrono::steady_clock::time_point now);
  void look_at_disk();  // once the session is over
  void show(const wire::RecorderState& state);

  RadarHost& host_;
  const RecorderConfig config_;
  DiskWriter disk_;

  std::mutex wake_mutex_;  // its own, so that a radar's thread waits for nobody
  std::condition_variable wakes_;
  bool woken_ = false;

  mutable std::mutex mutex_;
  std::deque<Order> orders_;
  std::uint64_t left_out_ = 0;  // lines of the log, entries of the audit
  bool wanted_ = false;         // started, and neither stopped nor failed
  std::uint32_t marks_ = 0;
  bool stopping_ = false;
  wire::RecorderState state_;
  std::uint64_t version_ = 1;
  std::atomic<bool> records_{false};

  // The recorder's thread.
  std::unique_ptr<RecordingSession> session_;
  FullDiskLog full_disk_;
  bool finishing_ = false;  // the session is over, its file is not
  std::thread thread_;
};

}  // namespace skerry::server
