// Common parts of all calls of the C interface: exceptions, error texts, checks, and the boards
// handed out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "clients/board/skerry_board.h"
#include "clients/common/client_error.hpp"

namespace skerry::client::capi {

class BoardSession;

// A refusal: one of SKB_ERROR and what was wrong.
class CallError : public std::runtime_error {
 public:
  CallError(std::int32_t code, const std::string& text) : std::runtime_error(text), code_(code) {}
  std::int32_t code() const { return code_; }

 private:
  std::int32_t code_;
};

const char* last_error() noexcept;
// The code of the exception in flight; its text is kept for the calling thread.
std::int32_t failed_by_exception() noexcept;

// Runs `body`; whatever it throws becomes a code and a text.
template <typename Body>
std::int32_t guarded(Body&& body) noexcept {
  try {
    body();
    return SKB_OK;
  } catch (...) {
    return failed_by_exception();
  }
}

// The value, or its error as a CallError.
[[noreturn]] void refuse(const ClientError& error);
template <typename T>
T value_of(ClientResult<T> result) {
  if (!result) refuse(result.error());
  return std::move(result).value();
}

// Error: CallError ARGUMENT, naming the parameter.
void require_pointer(const char* name, const void* pointer);
void require_range(const char* name, std::uint64_t value, std::uint64_t min, std::uint64_t max);
// The two-call copy of a text with its ending 0.  Error: ARGUMENT, SIZE (*size is set).
void copy_text(const std::string& text, char* out, std::size_t capacity, std::size_t* size);
// Copies as much of `known` as the caller has room for, and fills the rest with 0.  Error:
// ARGUMENT; SIZE below `first`, what the first version had, and for sizes that make no sense.
void copy_struct(const char* name, const void* known, std::size_t known_size, void* out,
                 std::size_t size, std::size_t first);

// Hands out tickets for boards and finds them again.  A ticket has the type of a pointer and is
// never followed as one: it is odd, so no object's address is a ticket, and none is used twice.
// Thread: any.
class BoardTable {
 public:
  // The one of this process.  Never destroyed: threads may call while the process ends.
  static BoardTable& global();

  skb_board* add(std::shared_ptr<BoardSession> session);
  // Error: CallError HANDLE.
  std::shared_ptr<BoardSession> find(const skb_board* ticket) const;
  std::shared_ptr<BoardSession> remove(const skb_board* ticket);

 private:
  mutable std::mutex mutex_;
  std::unordered_map<std::uintptr_t, std::shared_ptr<BoardSession>> sessions_;
  std::uintptr_t next_ = 1;
};

// A board found by its ticket that no other thread uses meanwhile.
class Held {
 public:
  // Error: CallError HANDLE; BUSY where another thread is in a call on it.
  explicit Held(const skb_board* ticket);
  BoardSession* operator->() const { return session_.get(); }

 private:
  std::shared_ptr<BoardSession> session_;  // outlives the lock
  std::unique_lock<std::mutex> lock_;
};

}  // namespace skerry::client::capi
