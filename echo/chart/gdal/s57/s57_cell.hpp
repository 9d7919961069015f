// S57Cell: an open cell, feature by feature.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <ogrsf_frmts.h>

#include "echo/chart/gdal/chart_warnings.hpp"
#include "echo/chart/gdal/gdal_session.hpp"

namespace skerry::echo {

// One object of a cell.
class S57Feature {
 public:
  S57Feature(const OGRFeature& feature, std::string name)
      : feature_(feature), name_(std::move(name)) {}

  // "US5MA1BO.000: LNDARE 0226FF9CDB5F21F3" (the long name: agency, feature and subdivision
  // number).
  const std::string& name() const { return name_; }
  const OGRGeometry* geometry() const { return feature_.GetGeometryRef(); }
  // An attribute; the first of a list; nothing if it is not charted.
  std::optional<int> integer(const char* attribute) const;
  std::vector<int> integers(const char* attribute) const;  // all of a list
  std::optional<double> real(const char* attribute) const;
  std::string text(const char* attribute) const;

 private:
  const OGRFeature& feature_;
  std::string name_;
};

// Of an RTPBCN: it sends without being asked (CATRTB 1), unlike a racon.
bool is_ramark(const S57Feature& feature);

class S57Cell {
 public:
  // `file` names it in warnings.
  S57Cell(GDALDataset& dataset, std::string file, ChartWarnings& warnings)
      : dataset_(dataset), file_(std::move(file)), warnings_(warnings) {}

  GDALDataset& dataset() const { return dataset_; }
  const std::string& file() const { return file_; }
  ChartWarnings& warnings() const { return warnings_; }

  // Objects of a class whose geometry is whole; of others, and of attributes that GDAL cannot read,
  // the warnings tell.
  void for_each(const char* object_class,
                const std::function<void(const S57Feature&)>& visit) const;

 private:
  GDALDataset& dataset_;
  std::string file_;
  ChartWarnings& warnings_;
};

}  // namespace skerry::echo
