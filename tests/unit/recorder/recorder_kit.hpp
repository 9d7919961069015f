// A host to be recorded, and what was recorded of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "server/recorder/recorder.hpp"
#include "tests/unit/net/fake_host.hpp"

namespace skerry::server {

// A folder of its own, gone at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  std::string path() const { return path_.string(); }
  std::string path(const std::string& name) const { return (path_ / name).string(); }
  // Names of its recordings, sorted.
  std::vector<std::string> recordings() const;

 private:
  std::filesystem::path path_;
};

// Inputs that the test gives.  Thread: any.
class FakeExercise final : public ExerciseInputs {
 public:
  void add(std::string input) {
    const std::lock_guard lock(mutex_);
    inputs_.push_back(std::move(input));
  }
  std::vector<std::string> since(std::size_t from) const override {
    const std::lock_guard lock(mutex_);
    if (from >= inputs_.size()) return {};
    return {inputs_.begin() + static_cast<std::ptrdiff_t>(from), inputs_.end()};
  }
  std::vector<std::string> reached() const override { return {"reached"}; }
  std::vector<ExerciseDocument> documents() const override {
    return {{"scenario.yaml", "application/yaml", "name: test\n"}};
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> inputs_;
};

class RecordedHost : public FakeHost {
 public:
  explicit RecordedHost(std::uint32_t radars = 1, std::size_t ring_sectors = 64);
  const ExerciseInputs* exercise() const override { return has_exercise ? &inputs : nullptr; }

  std::optional<wire::ExerciseState> exercise_state() const override {
    const std::lock_guard lock(told_mutex_);
    ++asked;
    return told_;
  }
  mutable std::atomic<int> asked = 0;  // for the exercise's state
  void tell(const wire::ExerciseState& state) {
    const std::lock_guard lock(told_mutex_);
    told_ = state;
  }

  FakeExercise inputs;
  bool has_exercise = false;

  // The bytes of the wire::Spoke that publish() gives.
  std::string spoke_bytes(std::uint32_t radar, std::uint64_t sequence) const;

 private:
  mutable std::mutex told_mutex_;
  std::optional<wire::ExerciseState> told_;
};

// Waits until `done`; false if it never comes.
bool comes_true(const std::function<bool()>& done);
bool reaches(const RecordingPort& recorder, wire::RecorderState::Phase phase);
wire::Record record_of(wire::Record::Action action, const std::string& name = {});

// All items of a file, or of the files of a series one after the other.
struct Recorded {
  struct Item {
    recording::Topic topic;
    UtcTime time;
    std::string bytes;
  };
  std::vector<Item> items;
  std::vector<recording::Attachment> attachments;
  bool is_whole = true;

  std::vector<std::string> of(recording::Kind kind, std::uint32_t radar = 0) const;
  std::vector<recording::Event> events(recording::Event::Kind kind) const;
};
Recorded recorded(const std::string& path);

}  // namespace skerry::server
