// Common parts of all calls of the C interface: exceptions, error texts, checks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>

#include "echo/capi/skerry_echo.h"

namespace skerry::echo::capi {

// A refusal: one of SKERRY_ECHO_ERROR_ and what was wrong.
class CallError : public std::runtime_error {
 public:
  CallError(std::int32_t code, const std::string& text) : std::runtime_error(text), code_(code) {}
  std::int32_t code() const { return code_; }

 private:
  std::int32_t code_;
};

// Keeps the text for the calling thread, cut to what skerry_echo_last_error() promises; returns
// `code`.  Allocates nothing.
std::int32_t failed(std::int32_t code, const char* text) noexcept;
const char* last_error() noexcept;
// The code of the exception in flight, its text kept.
std::int32_t failed_by_exception() noexcept;

// Runs `body`; whatever it throws becomes a code and a text.
template <typename Body>
std::int32_t guarded(Body&& body) noexcept {
  try {
    body();
    return SKERRY_ECHO_OK;
  } catch (...) {
    return failed_by_exception();
  }
}

// Error: CallError ARGUMENT, naming the parameter, for each of the checks below.
void require_pointer(const char* name, const void* pointer);
// NaN is out of any range.
void require_range(const char* name, double value, double min, double max);
void require_range(const char* name, std::uint64_t value, std::uint64_t min, std::uint64_t max);
void require_choice(const char* name, std::int64_t value, std::int64_t min, std::int64_t max);

// Runs `body`; a refusal is told to be of `name()`, e.g. of "targets[3]".
template <typename Name, typename Body>
auto of_part(Name&& name, Body&& body) {
  try {
    return body();
  } catch (const CallError& error) {
    throw CallError(error.code(), name() + ": " + error.what());
  }
}

// Structures of the interface: `known` is what this library knows of one, `first` what its first
// version had.  Error: CallError SIZE.
void require_struct_size(const char* name, std::uint32_t given, std::size_t first);
// Copies a caller's structure over `known`, which holds the defaults of what an older caller leaves
// out.  Error: also where a newer caller uses what this library does not know.
void read_struct(const char* name, const void* given, std::size_t first,
                 std::span<std::byte> known);
// Copies `known` out, with the caller's size in the first four bytes and zeros behind.
void write_struct(void* out, std::size_t size, std::span<const std::byte> known);

template <typename T>
T from_caller(const char* name, const T* given, T defaults) {
  read_struct(name, given, sizeof(T), std::as_writable_bytes(std::span(&defaults, 1)));
  return defaults;
}

// For the _defaults() calls, which are told the size.
template <typename T>
void to_caller(const char* name, T* out, std::size_t size, const T& value) {
  require_pointer(name, out);
  require_struct_size(name, size > UINT32_MAX ? UINT32_MAX : static_cast<std::uint32_t>(size),
                      sizeof(T));
  write_struct(out, size, std::as_bytes(std::span(&value, 1)));
}

// For structures whose struct_size the caller has set.
template <typename T>
void to_caller(const char* name, T* out, const T& value) {
  require_pointer(name, out);
  std::uint32_t size = 0;
  std::memcpy(&size, out, sizeof size);
  to_caller(name, out, size, value);
}

// The two-call copy of an array: *count is set, then refused where it does not fit.
void require_room(std::size_t needed, const void* out, std::size_t capacity, std::size_t* count);

}  // namespace skerry::echo::capi
