#include "clients/board/call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string_view>

#include "clients/board/board_session.hpp"

namespace skerry::client::capi {
namespace {

// Far above any structure to come, far below what a stray number would be.
constexpr std::size_t kMostStructBytes = 4096;

constexpr std::size_t kTextBytes = 512;
thread_local std::array<char, kTextBytes> t_text{};

std::int32_t failed(std::int32_t code, std::string_view text) noexcept {
  const std::size_t size = std::min(text.size(), kTextBytes - 1);
  std::transform(text.begin(), text.begin() + size, t_text.begin(),
                 [](char c) { return c < 0x20 || c > 0x7e ? '?' : c; });
  t_text[size] = '\0';
  return code;
}

std::int32_t code_of(ClientErrorKind kind) {
  switch (kind) {
    case ClientErrorKind::unreachable:
    case ClientErrorKind::refused:
      return SKB_ERROR_UNREACHABLE;
    case ClientErrorKind::timed_out:
      return SKB_ERROR_TIMEOUT;
    case ClientErrorKind::closed:
      return SKB_ERROR_CLOSED;
    case ClientErrorKind::rejected:
      return SKB_ERROR_REJECTED;
    case ClientErrorKind::malformed:
      return SKB_ERROR_PROTOCOL;
  }
  return SKB_ERROR_INTERNAL;
}

}  // namespace

const char* last_error() noexcept { return t_text.data(); }

std::int32_t failed_by_exception() noexcept {
  try {
    throw;
  } catch (const CallError& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(SKB_ERROR_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return failed(SKB_ERROR_MEMORY, "more than memory can hold");
  } catch (const std::exception& error) {
    return failed(SKB_ERROR_INTERNAL, error.what());
  } catch (...) {
    return failed(SKB_ERROR_INTERNAL, "an exception of unknown kind");
  }
}

void refuse(const ClientError& error) { throw CallError(code_of(error.kind), error.text); }

void require_pointer(const char* name, const void* pointer) {
  if (!pointer) throw CallError(SKB_ERROR_ARGUMENT, fmt::format("{} is NULL", name));
}

void require_range(const char* name, std::uint64_t value, std::uint64_t min, std::uint64_t max) {
  if (value >= min && value <= max) return;
  throw CallError(SKB_ERROR_ARGUMENT,
                  fmt::format("{} is {}; allowed: {} to {}", name, value, min, max));
}

void copy_text(const std::string& text, char* out, std::size_t capacity, std::size_t* size) {
  require_pointer("size", size);
  if (!out && capacity > 0) {
    throw CallError(SKB_ERROR_ARGUMENT, fmt::format("text is NULL with capacity {}", capacity));
  }
  *size = text.size() + 1;
  if (!out) return;
  if (capacity < text.size() + 1) {
    throw CallError(SKB_ERROR_SIZE, fmt::format("room for {} of {} bytes", capacity, *size));
  }
  std::memcpy(out, text.c_str(), text.size() + 1);
}

void copy_struct(const char* name, const void* known, std::size_t known_size, void* out,
                 std::size_t size, std::size_t first) {
  require_pointer(name, out);
  if (size < first || size > kMostStructBytes) {
    throw CallError(SKB_ERROR_SIZE, fmt::format("the size of {} is {}; expected its sizeof, which "
                                                "is {} and may grow up to {}",
                                                name, size, first, kMostStructBytes));
  }
  const std::size_t used = std::min(size, known_size);
  std::memcpy(out, known, used);
  std::memset(static_cast<std::byte*>(out) + used, 0, size - used);
}

BoardTable& BoardTable::global() {
  static auto* const table = new BoardTable;
  return *table;
}

skb_board* BoardTable::add(std::shared_ptr<BoardSession> session) {
  const std::lock_guard lock(mutex_);
  if (next_ + 2 < next_) throw std::bad_alloc();
  sessions_.emplace(next_, std::move(session));
  auto* const ticket = reinterpret_cast<skb_board*>(next_);  // NOLINT(performance-no-int-to-ptr)
  next_ += 2;
  return ticket;
}

std::shared_ptr<BoardSession> BoardTable::find(const skb_board* ticket) const {
  if (!ticket) throw CallError(SKB_ERROR_HANDLE, "board is NULL");
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(reinterpret_cast<std::uintptr_t>(ticket));
  if (found == sessions_.end()) {
    throw CallError(SKB_ERROR_HANDLE, "board is no handle: closed, or never one of this library's");
  }
  return found->second;
}

std::shared_ptr<BoardSession> BoardTable::remove(const skb_board* ticket) {
  auto session = find(ticket);
  const std::lock_guard lock(mutex_);
  if (sessions_.erase(reinterpret_cast<std::uintptr_t>(ticket)) == 0) {
    throw CallError(SKB_ERROR_HANDLE, "board was closed by another thread");
  }
  return session;
}

Held::Held(const skb_board* ticket)
    : session_(BoardTable::global().find(ticket)), lock_(session_->in_use, std::try_to_lock) {
  if (!lock_) {
    throw CallError(SKB_ERROR_BUSY, "board is in use by another thread; one at a time may");
  }
}

}  // namespace skerry::client::capi
