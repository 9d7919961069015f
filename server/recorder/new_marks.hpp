// NewMarks: which marks of an exercise have come since it was looked at last.
#pragma once

#include <vector>

#include "protocol/wire/exercise.pb.h"

namespace skerry::server {

// A state has the newest marks only, and a snapshot that is restored takes marks away; a mark that
// is there again afterwards is another one.  Those of the first state came before the recording.
// Thread: one at a time.
class NewMarks {
 public:
  std::vector<wire::ExerciseMark> take(const wire::ExerciseState& state);

 private:
  bool looked_ = false;
  std::vector<wire::ExerciseMark> known_;
};

}  // namespace skerry::server
