// Finding: one thing that the doctor has to say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace skerry::client::doctor {

enum class Grade : std::uint8_t {
  good,   // looked at, and as it should be
  hint,   // may be meant so
  fault,  // no picture, or a wrong one, until it is mended
};

struct Finding {
  Grade grade = Grade::good;
  std::string about;   // "server", "navico_4g", "port 7480"
  std::string text;    // what was found, and what was expected
  std::string advice;  // what to do; empty: nothing
};
using Findings = std::vector<Finding>;

// "FAULT  port 7480          taken by python3 (4711), ..." and what to do on a line of its own.
std::string as_text(const Findings& findings);
// A list of {grade, about, text, advice}; grades are "ok", "hint" and "FAULT".
std::string as_json(const Findings& findings);

}  // namespace skerry::client::doctor
