#include "server/board/fault_log.hpp"

#include <spdlog/spdlog.h>

#include <array>
#include <span>
#include <utility>
#include <variant>

#include "protocol/board/sweep_record.hpp"

namespace skerry::server {

std::string fault_names(std::uint32_t faults) {
  static constexpr std::array<std::pair<std::uint32_t, const char*>, 7> kNames = {{
      {board::fault::config, "config"},
      {board::fault::acp_missing, "acp_missing"},
      {board::fault::acp_extra, "acp_extra"},
      {board::fault::arp_missing, "arp_missing"},
      {board::fault::stalled, "stalled"},
      {board::fault::overrun, "overrun"},
      {board::fault::late, "late"},
  }};
  std::string names;
  for (const auto& [bit, name] : kNames) {
    if ((faults & bit) != 0) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

void FaultLog::look_at(const BoardBatch& batch, const std::function<std::string()>& reason,
                       std::chrono::steady_clock::time_point now) {
  if (now - second_begun_ >= std::chrono::seconds(1)) tell_left_out();
  std::uint32_t begin = 0;
  for (const std::uint32_t end : batch.signal_ends) {
    const auto record = board::decode_record(std::span(batch.signals).subspan(begin, end - begin));
    begin = end;
    if (!record) continue;
    const auto* const event = std::get_if<board::Event>(&record->record);
    if (event == nullptr) continue;
    if (event->event != board::event::fault_raised && event->event != board::event::fault_cleared)
      continue;
    if (has_room(now)) {
      tell(*event, reason);
    } else {
      ++left_out_;
    }
  }
}

bool FaultLog::has_room(std::chrono::steady_clock::time_point now) {
  if (now - second_begun_ >= std::chrono::seconds(1)) {
    second_begun_ = now;
    lines_ = 0;
  }
  return ++lines_ <= kMostLines;
}

void FaultLog::tell_left_out() {
  if (left_out_ == 0) return;
  spdlog::warn("board of {}: {} more faults raised or cleared", name_, left_out_);
  left_out_ = 0;
}

void FaultLog::tell(const board::Event& event, const std::function<std::string()>& reason) {
  if (event.event == board::event::fault_cleared) {
    spdlog::info("board of {}: fault cleared: {}", name_, fault_names(event.faults));
  } else if ((event.faults & board::fault::config) != 0) {
    spdlog::warn("board of {}: fault raised: {}: {}", name_, fault_names(event.faults), reason());
  } else {
    spdlog::warn("board of {}: fault raised: {}", name_, fault_names(event.faults));
  }
}

}  // namespace skerry::server
