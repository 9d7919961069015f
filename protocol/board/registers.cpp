#include "protocol/board/registers.hpp"

#include <algorithm>

#include "protocol/board/digdar_page.hpp"
#include "protocol/board/register_table.hpp"

namespace skerry::board {
namespace {

bool same_letters(std::string_view a, std::string_view b) {
  const auto upper = [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return upper(x) == upper(y); });
}

// All that is found, in the order of their addresses.
std::array<std::span<const RegisterInfo>, 3> tables() {
  return {register_table(), fault_reason_table(), digdar_infos()};
}

}  // namespace

std::string_view name_of(RegisterError error) {
  switch (error) {
    case RegisterError::ok:
      return "ok";
    case RegisterError::unknown_register:
      return "unknown register";
    case RegisterError::read_only:
      return "read only";
    case RegisterError::out_of_range:
      return "out of range";
    case RegisterError::misaligned:
      return "misaligned";
  }
  return "unknown";
}

std::span<const RegisterInfo> all_registers() { return register_table(); }

const RegisterInfo* find_register(std::uint32_t address) {
  for (const auto rows : tables()) {
    const auto found =
        std::lower_bound(rows.begin(), rows.end(), address,
                         [](const RegisterInfo& row, std::uint32_t a) { return row.address < a; });
    if (found != rows.end() && found->address == address) return &*found;
  }
  return nullptr;
}

const RegisterInfo* find_register(std::string_view name) {
  for (const auto rows : tables()) {
    for (const RegisterInfo& row : rows) {
      if (same_letters(row.name, name)) return &row;
    }
  }
  return nullptr;
}

RegisterError check_write(std::uint32_t address, std::uint32_t value) {
  if (address % 4 != 0) return RegisterError::misaligned;
  const RegisterInfo* const info = find_register(address);
  if (info == nullptr) return RegisterError::unknown_register;
  if (info->access == Access::read_only) return RegisterError::read_only;
  if (info->access == Access::write_ones_to_clear) return RegisterError::ok;
  const std::int64_t number = value_of(*info, value);
  if (info->or_zero && number == 0) return RegisterError::ok;
  const bool allowed = number >= info->min && number <= info->max &&
                       (number - info->min) % std::int64_t{info->step} == 0;
  return allowed ? RegisterError::ok : RegisterError::out_of_range;
}

std::uint32_t fault_reason_word(std::string_view reason, std::uint32_t n) {
  std::uint32_t word = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::size_t at = std::size_t{4} * n + i;
    if (at >= reason.size() || at >= kFaultReasonBytes - 1) break;
    const char c = reason[at] >= ' ' && reason[at] <= '~' ? reason[at] : '?';
    word |= static_cast<std::uint32_t>(c) << 8 * i;
  }
  return word;
}

std::string fault_reason_text(std::span<const std::uint32_t> words) {
  std::string text;
  for (const std::uint32_t word : words) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const char c = static_cast<char>(word >> 8 * i & 0xFF);
      if (c == 0) return text;
      text += c >= ' ' && c <= '~' ? c : '?';
    }
  }
  return text;
}

}  // namespace skerry::board
