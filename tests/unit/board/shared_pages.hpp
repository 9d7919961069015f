// Shared memory of a test: written through one mapping, read through another, read-only one.
#pragma once

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <span>

namespace skerry::board {

class SharedPages {
 public:
  explicit SharedPages(std::size_t bytes) : bytes_(bytes) {
    const int file = memfd_create("board_test", MFD_CLOEXEC);
    EXPECT_GE(file, 0);
    EXPECT_EQ(ftruncate(file, static_cast<off_t>(bytes)), 0);
    writable_ = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    readable_ = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, file, 0);
    close(file);
    EXPECT_TRUE(writable_ != MAP_FAILED && readable_ != MAP_FAILED);
  }
  SharedPages(const SharedPages&) = delete;
  SharedPages& operator=(const SharedPages&) = delete;
  ~SharedPages() {
    munmap(writable_, bytes_);
    munmap(readable_, bytes_);
  }

  std::span<std::uint8_t> writable() { return {static_cast<std::uint8_t*>(writable_), bytes_}; }
  std::span<const std::uint8_t> readable() const {
    return {static_cast<const std::uint8_t*>(readable_), bytes_};
  }

 private:
  std::size_t bytes_;
  void* writable_ = nullptr;
  void* readable_ = nullptr;
};

}  // namespace skerry::board
