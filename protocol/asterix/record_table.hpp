// A category as a table: a row for each item, with its length, its writer and its reader.  Shared
// by the categories whose records are reports of plots and tracks, of no use elsewhere.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/asterix/item_reader.hpp"
#include "protocol/asterix/item_writer.hpp"
#include "protocol/quantity/result.hpp"

namespace skerry::asterix {

// In the order of the field reference numbers (FRN), the first being 1.
template <typename Report>
struct ItemRow {
  std::string_view name = "a spare number";
  Shape shape = {};  // spare
  // Appends the item if the report has it, and nothing otherwise; nothing: it is never written.
  void (*write)(Bytes& out, const Report& report) = nullptr;
  // False if it has a value that the edition does not allow; nothing: it is passed over.
  bool (*read)(const ItemOctets& item, Report& report) = nullptr;
};

template <typename Report>
struct RecordTable {
  std::uint8_t category = 0;
  std::string_view name = {};  // "CAT048"
  std::span<const ItemRow<Report>> rows = {};
  // The items, by FRN, without which a record is refused.
  ItemSet<std::size_t> needed = {};
};

template <typename Report>
void append_record(Bytes& out, const RecordTable<Report>& table, const Report& report) {
  PartWriter record;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i].write == nullptr) continue;
    Bytes item;
    table.rows[i].write(item, report);
    record.add(i + 1, item);
  }
  record.append_to(out);
}

// Datagrams of one data block each, of `most` octets at most; a record alone may be longer.
template <typename Report>
std::vector<Bytes> encode_records(const RecordTable<Report>& table, std::span<const Report> reports,
                                  std::size_t most) {
  std::vector<Bytes> datagrams;
  Bytes records;
  const auto send = [&] {
    if (records.empty()) return;
    Bytes& out = datagrams.emplace_back();
    const std::size_t begun = begin_block(out, table.category);
    out.insert(out.end(), records.begin(), records.end());
    end_block(out, begun);
    records.clear();
  };
  constexpr std::size_t kMostBlock = 65'507;  // of one datagram of UDP over IPv4
  for (const Report& report : reports) {
    Bytes record;
    append_record(record, table, report);
    if (kBlockHeader + records.size() + record.size() > std::min(most, kMostBlock)) send();
    records.insert(records.end(), record.begin(), record.end());
  }
  send();
  return datagrams;
}

template <typename Report>
std::optional<WireError> read_record(ByteReader& block, std::size_t offset,
                                     const RecordTable<Report>& table, Report& report) {
  ItemReader reader(block, offset, table.name);
  ItemSet<std::size_t> items;
  if (!reader.read(items, (table.rows.size() + 6) / 7)) return reader.error();
  if (!items.has_all(table.needed)) {
    reader.fail(WireErrorKind::malformed, "record without an item that all have");
    return reader.error();
  }
  for (std::size_t i = 0; i < 7 * ItemSet<std::size_t>::kMostOctets; ++i) {
    if (!items.has(i + 1)) continue;
    const ItemRow<Report> row = i < table.rows.size() ? table.rows[i] : ItemRow<Report>{};
    ItemOctets item;
    if (!reader.read(item, row.shape, row.name)) return reader.error();
    if (row.read != nullptr && !row.read(item, report)) {
      reader.fail(WireErrorKind::out_of_range,
                  "item " + std::string(row.name) + " has a value that the edition does not allow");
      return reader.error();
    }
  }
  return std::nullopt;
}

template <typename Report>
Result<std::vector<Report>, WireError> decode_records(const RecordTable<Report>& table,
                                                      std::span<const std::uint8_t> datagram) {
  std::vector<Report> reports;
  const auto error =
      for_each_block(datagram, table.category, table.name,
                     [&](ByteReader& block, std::size_t offset) -> std::optional<WireError> {
                       while (block.left() > 0) {
                         if (auto bad = read_record(block, offset, table, reports.emplace_back()))
                           return bad;
                       }
                       return std::nullopt;
                     });
  if (error) return Failure{*error};
  return reports;
}

}  // namespace skerry::asterix
