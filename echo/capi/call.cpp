#include "echo/capi/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>

namespace skerry::echo::capi {
namespace {

// Far above any structure to come, far below what a stray number would be.
constexpr std::size_t kMostStructBytes = 4096;

constexpr std::size_t kTextBytes = 512;
thread_local std::array<char, kTextBytes> t_text{};

[[noreturn]] void refuse(std::int32_t code, const std::string& text) {
  throw CallError(code, text);
}

}  // namespace

std::int32_t failed(std::int32_t code, const char* text) noexcept {
  std::size_t size = std::min(std::strlen(text), kTextBytes - 1);
  // Not in the middle of a character of UTF-8.
  if (text[size] != '\0') {
    while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0u) == 0x80u) --size;
  }
  std::transform(text, text + size, t_text.begin(), [](char c) { return c == '\n' ? ' ' : c; });
  t_text[size] = '\0';
  return code;
}

const char* last_error() noexcept { return t_text.data(); }

std::int32_t failed_by_exception() noexcept {
  try {
    throw;
  } catch (const CallError& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(SKERRY_ECHO_ERROR_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return failed(SKERRY_ECHO_ERROR_MEMORY, "more than memory can hold");
  } catch (const std::invalid_argument& error) {
    return failed(SKERRY_ECHO_ERROR_ARGUMENT, error.what());
  } catch (const std::exception& error) {
    return failed(SKERRY_ECHO_ERROR_INTERNAL, error.what());
  } catch (...) {
    return failed(SKERRY_ECHO_ERROR_INTERNAL, "an exception of unknown kind");
  }
}

void require_pointer(const char* name, const void* pointer) {
  if (!pointer) refuse(SKERRY_ECHO_ERROR_ARGUMENT, fmt::format("{} is NULL", name));
}

void require_range(const char* name, double value, double min, double max) {
  if (value >= min && value <= max) return;
  refuse(SKERRY_ECHO_ERROR_ARGUMENT,
         fmt::format("{} is {:.9g}; allowed: {:.6g} to {:.6g}", name, value, min, max));
}

void require_range(const char* name, std::uint64_t value, std::uint64_t min, std::uint64_t max) {
  if (value >= min && value <= max) return;
  refuse(SKERRY_ECHO_ERROR_ARGUMENT,
         fmt::format("{} is {}; allowed: {} to {}", name, value, min, max));
}

void require_choice(const char* name, std::int64_t value, std::int64_t min, std::int64_t max) {
  if (value >= min && value <= max) return;
  if (min == max) {
    refuse(SKERRY_ECHO_ERROR_ARGUMENT, fmt::format("{} is {}; expected {}", name, value, min));
  }
  refuse(SKERRY_ECHO_ERROR_ARGUMENT,
         fmt::format("{} is {}; allowed: {} to {}", name, value, min, max));
}

void require_struct_size(const char* name, std::uint32_t given, std::size_t first) {
  if (given >= first && given <= kMostStructBytes) return;
  refuse(SKERRY_ECHO_ERROR_SIZE,
         fmt::format("{}: struct_size is {}; expected {} (sizeof) or, from a newer header, up to "
                     "{}: let its _defaults call set it, or set it to sizeof",
                     name, given, first, kMostStructBytes));
}

void read_struct(const char* name, const void* given, std::size_t first,
                 std::span<std::byte> known) {
  require_pointer(name, given);
  std::uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  require_struct_size(name, size, first);
  const auto* bytes = static_cast<const std::byte*>(given);
  for (std::size_t i = known.size(); i < size; ++i) {
    if (bytes[i] == std::byte{0}) continue;
    refuse(SKERRY_ECHO_ERROR_SIZE,
           fmt::format("{}: byte {} of {} is set, of which version {}.{} knows {}: it was written "
                       "for a newer library",
                       name, i, size, SKERRY_ECHO_VERSION_MAJOR, SKERRY_ECHO_VERSION_MINOR,
                       known.size()));
  }
  std::memcpy(known.data(), given, std::min<std::size_t>(size, known.size()));
}

void write_struct(void* out, std::size_t size, std::span<const std::byte> known) {
  auto* bytes = static_cast<std::byte*>(out);
  const std::size_t used = std::min(size, known.size());
  std::memcpy(bytes, known.data(), used);
  std::memset(bytes + used, 0, size - used);
  const auto said = static_cast<std::uint32_t>(size);
  std::memcpy(bytes, &said, sizeof said);
}

void require_room(std::size_t needed, const void* out, std::size_t capacity, std::size_t* count) {
  require_pointer("the pointer to the count", count);
  if (!out && capacity > 0) {
    refuse(SKERRY_ECHO_ERROR_ARGUMENT, fmt::format("out is NULL with capacity {}", capacity));
  }
  *count = needed;
  if (out && capacity < needed) {
    refuse(SKERRY_ECHO_ERROR_SIZE, fmt::format("room for {} of {} elements", capacity, needed));
  }
}

}  // namespace skerry::echo::capi
