// GshhgReader: windows of the world's shoreline, out of an installed GSHHG file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {

class GshhgFile;

// GSHHG 2.3.7 (Wessel and Smith; LGPL 3 or later): shorelines, lakes, islands in them and ponds on
// those, everywhere.  Full detail has a vertex every 100 to 200 m and lies within about 400 m of
// where a radar finds the coast; piers and moles are absent.
// Thread: load() from any thread; all readers share one lock while they read.
class GshhgReader final : public ChartSource {
 public:
  // The file binned_GSHHS_f.nc or one of its coarser brothers.
  // Error: std::runtime_error naming the file, the variable, and what was wrong.
  static GshhgReader open(const std::filesystem::path& file);

  // The finest of the five levels of detail (full, high, intermediate, low, crude) in any of the
  // directories; the earlier directory wins a draw.
  // Error: std::runtime_error naming where it looked and which packages to install.
  static std::filesystem::path find_finest(const std::vector<std::filesystem::path>& directories = {
                                               "/usr/share/gmt-gshhg"});

  GshhgReader(GshhgReader&&) noexcept;
  GshhgReader& operator=(GshhgReader&&) noexcept;
  ~GshhgReader() override;

  // All coast within `radius` of `centre`, any place on Earth, antimeridian and poles included.
  // Rings are those of the file's bins (gshhg_bin.hpp): whole bins are loaded, so there is coast
  // beyond the radius too, and a coast runs on from a ring of one bin to a ring of the next where
  // both have the same vertex.  Takes about 60 bytes per vertex while loading and 25 after;
  // the whole Earth in full detail is 11 million vertices.
  // Error: std::invalid_argument for a centre off the globe or a radius below 0;
  // std::runtime_error for a damaged file.
  CoastChart load(GeoPoint centre, Length radius) const override;
  std::string describe() const override;  // "GSHHG 2.3.7 full"

 private:
  explicit GshhgReader(std::unique_ptr<const GshhgFile> file);
  std::unique_ptr<const GshhgFile> file_;
};

}  // namespace skerry::echo
