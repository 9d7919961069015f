// CaptureStream: a file, packed by gzip or not, as a stream that is unpacked while it is read.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

namespace skerry::pcap {

// Outlives the stream that release() gives.  Thread: one at a time.
class CaptureStream {
 public:
  // `progress` gets the share of the packed file read, and may return false to end the stream.
  CaptureStream(const std::string& path, std::function<bool(double)> progress);
  ~CaptureStream();
  CaptureStream(const CaptureStream&) = delete;
  CaptureStream& operator=(const CaptureStream&) = delete;

  // For reading onwards only; the caller closes it.  nullptr if there is no memory.
  std::FILE* release();

  // Why it could not be opened or read to its end; else empty.
  const std::string& problem() const { return problem_; }
  std::size_t size() const { return size_; }          // of the file, packed
  std::size_t position() const { return position_; }  // bytes unpacked so far

 private:
  static ssize_t read(void* self, char* into, std::size_t most);
  static int seek(void* self, std::int64_t* offset, int whence);

  std::function<bool(double)> progress_;
  void* packed_ = nullptr;  // gzFile
  std::string problem_;
  std::size_t size_ = 0, position_ = 0;
};

}  // namespace skerry::pcap
