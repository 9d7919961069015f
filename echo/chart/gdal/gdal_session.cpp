#include "echo/chart/gdal/gdal_session.hpp"

#include <cpl_error.h>
#include <fmt/core.h>
#include <gdal_frmts.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace skerry::echo {
namespace {

constexpr std::size_t kMostMessages = 3, kLongestMessage = 300;

void CPL_STDCALL keep_message(CPLErr severity, CPLErrorNum, const char* message) {
  if (severity == CE_Debug || severity == CE_None) return;
  static_cast<GdalErrors*>(CPLGetErrorHandlerUserData())->add(message);
}

void register_drivers() {
  static const bool once = [] {
    RegisterOGRS57();
    RegisterOGRShape();
    RegisterOGRGeoJSON();
    GDALRegister_GTiff();
    GDALRegister_DTED();
    GDALRegister_SRTMHGT();
    GDALRegister_VRT();
    return true;
  }();
  (void)once;
}

}  // namespace

GdalErrors::GdalErrors(const char* ignored) : ignored_(ignored) {
  CPLPushErrorHandlerEx(keep_message, this);
}
GdalErrors::~GdalErrors() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void GdalErrors::add(const char* message) {
  if (ignored_ != nullptr && std::strstr(message, ignored_) != nullptr) return;
  ++count_;
  if (messages_.size() >= kMostMessages) return;
  std::string text(message, std::min(std::char_traits<char>::length(message), kLongestMessage));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  messages_.push_back(std::move(text));
}

std::string GdalErrors::text() const {
  if (messages_.empty()) return "no reason given";
  std::string all;
  for (const std::string& message : messages_) all += (all.empty() ? "" : "; ") + message;
  if (count_ > messages_.size()) all += fmt::format("; and {} more", count_ - messages_.size());
  return all;
}

bool GdalErrors::only_of_attributes() const {
  return count_ > 0 && count_ == messages_.size() &&
         std::all_of(messages_.begin(), messages_.end(), [](const std::string& message) {
           return message.find("ttribute") != std::string::npos;
         });
}

void GdalErrors::forget() {
  messages_.clear();
  count_ = 0;
}

DatasetPtr open_dataset(const std::string& name, unsigned flags,
                        const std::vector<const char*>& drivers,
                        const std::vector<const char*>& options) {
  register_drivers();
  const auto ended = [](std::vector<const char*> list) {
    list.push_back(nullptr);
    return list;
  };
  return DatasetPtr(GDALDataset::Open(name.c_str(),
                                      flags | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                      ended(drivers).data(), ended(options).data()));
}

void require_file(const std::filesystem::path& file, std::uintmax_t most_bytes) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error)
    throw std::runtime_error(
        fmt::format("cannot read chart file {}: {}", file.string(), error.message()));
  if (size > most_bytes)
    throw std::runtime_error(
        fmt::format("chart file {} has {} bytes, more than the {} allowed; cut it into smaller "
                    "files",
                    file.string(), size, most_bytes));
}

}  // namespace skerry::echo
