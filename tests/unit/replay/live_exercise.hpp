// A short exercise of three radars with land, recorded with everything it was given.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/recording/inputs.pb.h"
#include "protocol/video/spoke.hpp"
#include "server/app/radar_server.hpp"

namespace skerry::server {

// Two ships near Bergen that hear each other's radars; fast, on short ranges, so that the coast is
// laid and indexed anew all the time.
std::string exercise_yaml(unsigned seed = 11);

// The spokes that a server made, as a recorder takes them.
class SpokeCollector {
 public:
  // Listens to a channel that gets no video yet.
  void listen(VideoChannel& channel);
  // Until `more` further spokes have come.
  void await_more(std::size_t more);
  // Stops listening.
  std::vector<SpokePtr> end();

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  std::vector<SpokePtr> spokes_;
  std::vector<FormatRing::Registration> readers_;
};

// The parts that a recording of it holds.
struct RecordedParts {
  std::vector<ExerciseDocument> documents;
  std::vector<std::string> inputs;  // recording::Input messages
  std::vector<SpokePtr> spokes;
};

// Runs the exercise with `changes` changes of controls, world and ships; some seconds.  `ago`: as
// of RadarServer::start().
RecordedParts run_exercise(unsigned changes, unsigned seed = 11, Duration ago = {});

// Writes a file of its own in `folder`.  `checkpoints`: hashes of a hundred spokes each in the
// place of the spokes.
std::string write_recording(const std::filesystem::path& folder, const RecordedParts& parts,
                            bool checkpoints);

}  // namespace skerry::server
