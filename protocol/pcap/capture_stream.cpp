#include "protocol/pcap/capture_stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace skerry::pcap {
namespace {

constexpr unsigned kReadAhead = 1 << 18;

gzFile gz(void* packed) { return static_cast<gzFile>(packed); }

}  // namespace

CaptureStream::CaptureStream(const std::string& path, std::function<bool(double)> progress)
    : progress_(std::move(progress)) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    problem_ = "it is a folder";
    return;
  }
  size_ = static_cast<std::size_t>(std::filesystem::file_size(path, error));
  if (error) size_ = 0;  // a pipe: no progress is told
  errno = 0;
  packed_ = gzopen(path.c_str(), "rb");
  if (packed_ == nullptr) {
    problem_ = std::string("cannot open it: ") + std::strerror(errno != 0 ? errno : ENOMEM);
    return;
  }
  gzbuffer(gz(packed_), kReadAhead);
}

CaptureStream::~CaptureStream() {
  if (packed_ != nullptr) gzclose(gz(packed_));
}

std::FILE* CaptureStream::release() {
  cookie_io_functions_t functions{};
  functions.read = &CaptureStream::read;
  functions.seek = &CaptureStream::seek;
  return fopencookie(this, "rb", functions);
}

ssize_t CaptureStream::read(void* self, char* into, std::size_t most) {
  auto& stream = *static_cast<CaptureStream*>(self);
  if (!stream.problem_.empty()) return -1;
  const gzFile packed = gz(stream.packed_);
  if (stream.progress_ && stream.size_ > 0) {
    const double share = static_cast<double>(gzoffset(packed)) / static_cast<double>(stream.size_);
    if (!stream.progress_(std::clamp(share, 0.0, 1.0))) {
      stream.problem_ = "given up";
      return -1;
    }
  }
  const int got = gzread(packed, into, static_cast<unsigned>(std::min<std::size_t>(most, 1 << 20)));
  int why = Z_OK;
  const char* const text = gzerror(packed, &why);
  if (got < 0 || why == Z_BUF_ERROR) {
    stream.problem_ = why == Z_ERRNO       ? std::strerror(errno)
                      : why == Z_BUF_ERROR ? "its gzip stream ends too early"
                                           : std::string("its gzip stream is damaged: ") + text;
  }
  if (got < 0) return -1;
  stream.position_ += static_cast<std::size_t>(got);
  return got;
}

// ftell() alone is answered.
int CaptureStream::seek(void* self, std::int64_t* offset, int whence) {
  if (whence != SEEK_CUR || *offset != 0) return -1;
  *offset = static_cast<std::int64_t>(static_cast<CaptureStream*>(self)->position_);
  return 0;
}

}  // namespace skerry::pcap
