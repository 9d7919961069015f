// An exercise of a scenario and orders, as a recording in a file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "protocol/recording/inputs.pb.h"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/targets.pb.h"

namespace skerry::server {

struct RecordedInputs {
  std::string yaml;
  double length_s = 60.0;
  std::vector<recording::Input> inputs;  // of the world
  struct Setting {
    double at_s = 0.0;
    std::uint32_t radar = 0, view = 0;
    wire::Settings settings;
  };
  std::vector<Setting> settings;
  struct Known {
    double at_s = 0.0;
    std::uint32_t radar = 0, view = 0;
    wire::TargetList list;
  };
  std::vector<Known> known;
  struct Written {
    double at_s = 0.0;
    recording::AuditEntry entry;
  };
  std::vector<Written> audit;

  // From that tick on.
  void order(std::uint64_t tick, const wire::ExerciseOrder& order);
  void helm(std::uint64_t tick, std::uint32_t own_ship, double course_deg);
  void engine(std::uint64_t tick, std::uint32_t own_ship, double speed_kn);
};

// The bytes of the recording.
std::string bytes_of(const RecordedInputs& recorded);
std::string write_bytes(const std::filesystem::path& folder, const std::string& bytes);

}  // namespace skerry::server
