#include "server/access_tool/audit_entries.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

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

RecordedEntries::RecordedEntries(std::string file) : file_(std::move(file)) {
  read_recorded(file_, [&](const audit::Entry& entry) {
    ++count_;
    missing_[entry.n()] = entry.SerializeAsString();
  });
}

void RecordedEntries::compare(const audit::Entry& entry) {
  const auto mine = missing_.find(entry.n());
  if (mine == missing_.end()) return;
  audit::Entry theirs = entry;
  theirs.clear_follows();
  if (theirs.SerializeAsString() != mine->second && first_other_ == 0) first_other_ = entry.n();
  missing_.erase(mine);
}

std::optional<std::string> RecordedEntries::fault() const {
  if (first_other_ > 0) {
    return fmt::format("{}: its entry {} is another than in the files", file_, first_other_);
  }
  if (missing_.empty()) return std::nullopt;
  return fmt::format("{}: {} of its {} entries are not in the files, the first is entry {}", file_,
                     missing_.size(), count_, missing_.begin()->first);
}

}  // namespace skerry::server
