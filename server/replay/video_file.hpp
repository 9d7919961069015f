// VideoFile: a recording of video that was made again.
#pragma once

#include <memory>
#include <string>

#include "protocol/recording/reader.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::server {

// With everything of the recording it came of but its spokes.
class VideoFile {
 public:
  // Error: std::runtime_error if the file is there already or cannot be written.
  // `zero`: scenario time 0 among the times of its items.
  VideoFile(const std::string& path, const recording::RecordingReader& source, UtcTime zero);
  ~VideoFile();  // a file that was not finished stays as it is: what it has can be read

  // Error: std::runtime_error when the disk takes no more.
  void add(const Spoke& spoke);
  void finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skerry::server
