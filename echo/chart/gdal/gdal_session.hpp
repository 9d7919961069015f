// GDAL as it is used here: few drivers, and nothing on standard error.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gdal_priv.h>

namespace skerry::echo {

// Takes GDAL's complaints, while it lives, in place of standard error.
// Thread: GDAL keeps a stack of handlers per thread; nest them.
class GdalErrors {
 public:
  // Messages with `ignored` in them are dropped; null: none.
  explicit GdalErrors(const char* ignored = nullptr);
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  std::size_t count() const { return count_; }
  // The first three since the last forget(), joined; "no reason given" where there was none.
  std::string text() const;
  // Whether there is any, and all of them speak of attributes and not of geometry.
  bool only_of_attributes() const;
  void forget();
  // Used by the handler.
  void add(const char* message);

 private:
  const char* ignored_;
  std::vector<std::string> messages_;
  std::size_t count_ = 0;
};

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

// Opens `name` with one of these drivers and no other, read only.  Null with the reason in
// `errors`. Only drivers that this folder needs are ever registered.
DatasetPtr open_dataset(const std::string& name, unsigned flags,
                        const std::vector<const char*>& drivers,
                        const std::vector<const char*>& options);

// Error: std::runtime_error if there is no such file, it cannot be read, or it is larger than
// `most_bytes`.
void require_file(const std::filesystem::path& file, std::uintmax_t most_bytes);

}  // namespace skerry::echo
