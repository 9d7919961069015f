#include "server/page/csv_table.hpp"

#include <fmt/format.h>

#include "server/page/csv_cell.hpp"

namespace skerry::server {

CsvTable& CsvTable::operator<<(std::string_view text) { return put(csv_cell(text)); }
CsvTable& CsvTable::operator<<(double value) { return put(fmt::format("{:.10g}", value)); }
CsvTable& CsvTable::operator<<(std::size_t value) { return put(fmt::format("{}", value)); }
CsvTable& CsvTable::fixed(double value, int digits) {
  return put(fmt::format("{:.{}f}", value, digits));
}

CsvTable& CsvTable::put(std::string_view cell) {
  if (!first_) text_ += ',';
  first_ = false;
  text_ += cell;
  return *this;
}

}  // namespace skerry::server
