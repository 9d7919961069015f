#include "clients/doctor/finding.hpp"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

namespace skerry::client::doctor {
namespace {

constexpr std::array kWords = {"ok", "hint", "FAULT"};
const char* word_of(Grade grade) { return kWords[static_cast<std::size_t>(grade)]; }

}  // namespace

std::string as_text(const Findings& findings) {
  std::string out;
  for (const Finding& one : findings) {
    out += fmt::format("{:<6} {:<18} {}\n", word_of(one.grade), one.about, one.text);
    if (!one.advice.empty()) out += fmt::format("{:<25} -> {}\n", "", one.advice);
  }
  return out;
}

std::string as_json(const Findings& findings) {
  auto all = nlohmann::json::array();
  for (const Finding& one : findings) {
    all.push_back({{"grade", word_of(one.grade)},
                   {"about", one.about},
                   {"text", one.text},
                   {"advice", one.advice}});
  }
  return all.dump(2) + "\n";
}

}  // namespace skerry::client::doctor
