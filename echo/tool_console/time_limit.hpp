// TimeLimit: when long work should stop and hand over what it has.
#pragma once

#include <ctime>

namespace skerry::echo {

// Counted in whole seconds from when it is made.  What was done until then says so itself: no
// result depends on the time but by how much of it there is.
class TimeLimit {
 public:
  explicit TimeLimit(double minutes) : seconds_(60.0 * minutes), begin_(std::time(nullptr)) {}
  bool over() const { return std::difftime(std::time(nullptr), begin_) >= seconds_; }

 private:
  double seconds_;
  std::time_t begin_;
};

}  // namespace skerry::echo
