#include "echo/chart/gdal/s57/s57_chart.hpp"

#include <cpl_vsi.h>
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <map>
#include <optional>
#include <stdexcept>

#include "echo/chart/gdal/s57/cell_file.hpp"
#include "echo/chart/gdal/s57/s57_cell.hpp"
#include "echo/chart/gdal/s57/s57_cover.hpp"
#include "echo/chart/gdal/s57/s57_detail.hpp"
#include "echo/chart/gdal/s57/s57_land.hpp"
#include "echo/chart/gdal/s57/s57_moorings.hpp"
#include "echo/chart/gdal/s57/s57_objects.hpp"

namespace skerry::echo {
namespace {

using CellBytes = std::vector<std::uint8_t>;

// The checked bytes, as files of GDAL's own in memory.
class MemoryCell {
 public:
  MemoryCell() {
    static std::atomic<unsigned> next{0};
    folder_ = fmt::format("/vsimem/skerry-cell-{}", next.fetch_add(1));
  }
  ~MemoryCell() {
    for (const std::string& name : names_) VSIUnlink(name.c_str());
  }
  MemoryCell(const MemoryCell&) = delete;
  MemoryCell& operator=(const MemoryCell&) = delete;

  std::string base() const { return names_.front(); }
  // The first is the cell, the others its updates in turn.  `bytes` must outlive this.
  void add(CellBytes& bytes) {
    names_.push_back(fmt::format("{}/CELL.{:03}", folder_, names_.size()));
    VSIFCloseL(VSIFileFromMemBuffer(names_.back().c_str(), bytes.data(), bytes.size(), FALSE));
  }

 private:
  std::string folder_;
  std::vector<std::string> names_;
};

// Update files beside the cell by number.
std::map<int, std::filesystem::path> updates_beside(const std::filesystem::path& file) {
  std::map<int, std::filesystem::path> found;
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const std::string ending = it->path().extension().string();
    if (it->path().stem() != file.stem() || ending.size() != 4 ||
        !std::all_of(ending.begin() + 1, ending.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; }))
      continue;
    const int number = std::stoi(ending.substr(1));
    if (number > 0) found.emplace(number, it->path());
  }
  return found;
}

struct Updates {
  std::vector<CellBytes> files;  // in turn; a vector of vectors keeps the bytes in place when moved
  int last = 0;
};

// Those that can be applied to a cell of that edition and update; why others cannot is told.
Updates read_updates(const std::filesystem::path& file, const CellFacts& cell,
                     ChartWarnings& warnings) {
  Updates updates;
  updates.last = cell.update;
  for (const auto& [number, path] : updates_beside(file)) {
    if (number <= cell.update) continue;  // a cell issued anew holds them
    const std::string name = path.filename().string();
    if (number != updates.last + 1) {
      warnings.add(fmt::format(
          "{}: update {} is missing; {} and later updates are not applied, put {}.{:03} beside it",
          file.filename().string(), updates.last + 1, name, file.stem().string(),
          updates.last + 1));
      break;
    }
    try {
      CellBytes bytes = read_cell_file(path);
      const CellFacts facts = check_cell(bytes, path.string());
      if (facts.edition != cell.edition || facts.update != number)
        throw std::runtime_error(fmt::format(
            "chart file {}: holds update {} of edition {}, expected update {} of edition {}",
            path.string(), facts.update, facts.edition, number, cell.edition));
      updates.files.push_back(std::move(bytes));
      updates.last = number;
    } catch (const std::runtime_error& error) {
      warnings.add(fmt::format("{}; no update is applied", error.what()));
      return {{}, cell.update};
    }
  }
  return updates;
}

struct OpenCell {
  DatasetPtr dataset;
  std::string complaint;  // of GDAL, while it opened and updated it
};

OpenCell open_cell(const std::string& name, bool updated) {
  GdalErrors errors;
  OpenCell cell;
  cell.dataset = open_dataset(
      name, GDAL_OF_VECTOR, {"S57"},
      {"RETURN_PRIMITIVES=OFF", "SPLIT_MULTIPOINT=ON", "ADD_SOUNDG_DEPTH=ON", "LIST_AS_STRING=OFF",
       "RECODE_BY_DSSI=ON", updated ? "UPDATES=APPLY" : "UPDATES=IGNORE"});
  // Records are read, and updates applied, when the first of them is asked for.
  if (cell.dataset) {
    if (OGRLayer* covered = cell.dataset->GetLayerByName("M_COVR"))
      const OGRFeatureUniquePtr first(covered->GetNextFeature());
  }
  if (!cell.dataset || errors.count() > 0) cell.complaint = errors.text();
  return cell;
}

int number_of(const OGRFeature& feature, const char* field) {
  const int index = feature.GetFieldIndex(field);
  return index < 0 ? 0 : feature.GetFieldAsInteger(index);
}

// Reports objects of classes that no catalogue knows, by class.
void warn_of_unknown_objects(const S57Cell& cell) {
  std::map<int, int> counts;
  GdalErrors errors;
  if (OGRLayer* unknown = cell.dataset().GetLayerByName("Generic")) {
    for (const OGRFeatureUniquePtr& feature : *unknown) ++counts[number_of(*feature, "OBJL")];
  }
  for (const auto& [object_class, count] : counts)
    cell.warnings().add(fmt::format("{}: {} objects of the unknown class {}; left out", cell.file(),
                                    count, object_class));
}

}  // namespace

S57Chart S57Chart::open(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  CellBytes bytes = read_cell_file(file);
  const CellFacts facts = check_cell(bytes, file.string());
  ChartWarnings told;
  Updates updates = read_updates(file, facts, told);

  MemoryCell memory;
  memory.add(bytes);
  for (CellBytes& update : updates.files) memory.add(update);
  OpenCell cell = open_cell(memory.base(), !updates.files.empty());
  if (!cell.complaint.empty() && !updates.files.empty()) {
    told.add(fmt::format("{}: its updates do not fit it ({}); no update is applied",
                         file.filename().string(), cell.complaint));
    updates.last = facts.update;
    cell.dataset.reset();
    cell = open_cell(memory.base(), false);
  }
  if (!cell.dataset)
    throw std::runtime_error(
        fmt::format("chart file {}: {}; no S-57 cell", file.string(), cell.complaint));
  if (!cell.complaint.empty())
    told.add(fmt::format("{}: {}", file.filename().string(), cell.complaint));

  S57Chart chart;
  chart.name_ = file.stem().string();
  chart.sheet_.source =
      fmt::format("ENC {} edition {} update {}", chart.name_, facts.edition, updates.last);
  const S57Cell objects(*cell.dataset, file.filename().string(), told);
  double metres_per_unit = 1.0;
  bool depths_in_metres = true;
  {
    GdalErrors errors;
    OGRLayer* const parameters = cell.dataset->GetLayerByName("DSID");
    const OGRFeatureUniquePtr first(parameters ? parameters->GetNextFeature() : nullptr);
    if (first) {
      constexpr int kFeet = 2, kDepthsInMetres = 1;
      chart.scale_ = std::max(0, number_of(*first, "DSPM_CSCL"));
      if (number_of(*first, "DSPM_HUNI") == kFeet) metres_per_unit = 0.3048;
      depths_in_metres = number_of(*first, "DSPM_DUNI") <= kDepthsInMetres;  // 0: not said
    }
  }
  read_land(objects, chart.sheet_);
  read_cover(objects, chart.sheet_);
  read_objects(objects, metres_per_unit, chart.sheet_);
  read_moorings(objects, chart.sheet_);
  read_detail(objects, depths_in_metres, chart.sheet_);
  warn_of_unknown_objects(objects);
  cell.dataset.reset();
  chart.sheet_.index();
  for (std::string& text : told.texts()) warnings.push_back(std::move(text));
  return chart;
}

}  // namespace skerry::echo
