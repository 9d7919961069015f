#include "server/recorder/new_marks.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace skerry::server {
namespace {

bool is_same_mark(const wire::ExerciseMark& a, const wire::ExerciseMark& b) {
  return a.exercise_s() == b.exercise_s() && a.text() == b.text() && a.kind() == b.kind();
}

// How many of `now` stood in `before` already: the whole of its end, without those that `now` has
// no room for any more; or, where marks were taken away, what both begin with.
std::size_t known_of(const std::vector<wire::ExerciseMark>& before,
                     const std::vector<wire::ExerciseMark>& now) {
  for (auto from = before.begin(); from != before.end(); ++from) {
    const auto [end, other] =
        std::mismatch(from, before.end(), now.begin(), now.end(), is_same_mark);
    if (end == before.end()) return static_cast<std::size_t>(other - now.begin());
  }
  const auto both =
      std::mismatch(before.begin(), before.end(), now.begin(), now.end(), is_same_mark);
  return static_cast<std::size_t>(both.second - now.begin());
}

}  // namespace

std::vector<wire::ExerciseMark> NewMarks::take(const wire::ExerciseState& state) {
  std::vector<wire::ExerciseMark> now(state.marks().begin(), state.marks().end());
  const std::size_t known = std::exchange(looked_, true) ? known_of(known_, now) : now.size();
  known_ = now;
  now.erase(now.begin(), now.begin() + static_cast<std::ptrdiff_t>(known));
  return now;
}

}  // namespace skerry::server
