#include "server/access_tool/audit_entries.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "protocol/recording/reader.hpp"

namespace skerry::server {
namespace {

std::optional<std::string> read_recorded(const std::string& file,
                                         const std::function<void(const audit::Entry&)>& each) {
  const auto reader = recording::RecordingReader::open(file);
  if (!reader) throw std::runtime_error(reader.error().to_string());
  std::uint32_t last = 0;
  std::uint64_t missing = 0;
  std::string first_missing;
  auto items = reader->items({{recording::Kind::audit}});
  while (const auto item = items.next()) {
    audit::Entry entry;
    if (!entry.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size()))) continue;
    if (last > 0 && entry.n() > last + 1) {
      missing += entry.n() - last - 1;
      if (first_missing.empty()) first_missing = fmt::format("from entry {} on", last + 1);
    }
    last = entry.n();
    each(entry);
  }
  if (last == 0) {
    return fmt::format("{}: no entries of the audit are in this recording", file);
  }
  if (const auto damage = items.damage()) {
    return fmt::format("{}; entries may be missing", damage->to_string());
  }
  if (missing == 0) return std::nullopt;
  return fmt::format("{}: {} entries are missing, {}: the recorder had no room for them", file,
                     missing, first_missing);
}

}  // namespace

bool is_recording(const std::string& file) {
  constexpr std::string_view kMagic = "\x89MCAP";
  std::array<char, kMagic.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == kMagic;
}

std::optional<std::string> read_entries(const std::string& file,
                                        const std::function<void(const audit::Entry&)>& each) {
  if (is_recording(file)) return read_recorded(file, each);
  const AuditCheck check = check_audit(file, {}, each);
  if (check.wrong_line == 0) return std::nullopt;
  return fmt::format("{}:{}: {}\nWhat follows is not shown; `skerry audit verify` says more.", file,
                     check.wrong_line, check.wrong);
}

}  // namespace skerry::server
