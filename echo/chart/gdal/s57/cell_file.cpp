#include "echo/chart/gdal/s57/cell_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "echo/chart/gdal/gdal_session.hpp"

namespace skerry::echo {
namespace {

constexpr std::uintmax_t kMostCellBytes = 64u << 20;
constexpr std::size_t kLeader = 24;
constexpr std::size_t kMostRecords = 2'000'000;
constexpr std::uint8_t kUnitEnd = 0x1F, kFieldEnd = 0x1E;

using ByteSpan = std::span<const std::uint8_t>;

std::optional<std::size_t> number_in(ByteSpan digits) {
  std::size_t value = 0;
  for (const std::uint8_t c : digits) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

// The format controls that a definition ends with, "(2b11,A)" as "b11,b11,A,".
std::string formats_of(std::string_view definition) {
  const auto last = definition.rfind(static_cast<char>(kUnitEnd));
  std::string_view rest = definition.substr(last == definition.npos ? 0 : last + 1);
  if (!rest.starts_with('(') || !rest.ends_with(')')) return {};
  rest = rest.substr(1, rest.size() - 2);
  std::string all;
  while (!rest.empty() && all.size() < 200) {
    const std::string_view one = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    const bool repeated = one.size() > 1 && one[0] >= '2' && one[0] <= '9';
    for (int i = 0; i < (repeated ? one[0] - '0' : 1); ++i)
      all += std::string(one.substr(repeated ? 1 : 0)) + ',';
  }
  return all;
}

std::uint32_t little_endian(ByteSpan b) {
  std::uint32_t value = 0;
  for (std::size_t i = b.size(); i-- > 0;) value = value << 8 | b[i];
  return value;
}

struct Field {
  std::string_view tag;
  ByteSpan data;  // with its terminator
};

class CellCheck {
 public:
  CellCheck(ByteSpan bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  CellFacts run() {
    while (at_ < bytes_.size()) {
      read_record();
      if (++record_ > kMostRecords)
        refuse(fmt::format("more than the {} records allowed", kMostRecords));
    }
    if (record_ < 2) refuse("no data records");
    if (!identified_) refuse("no data set identification (field DSID)");
    compare_counts();
    return std::move(facts_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(fmt::format(
        "chart file {}: record {} at byte {}: {}; the file is damaged, cut short, or no "
        "S-57 cell",
        file_, record_, at_, what));
  }

  void read_record() {
    const ByteSpan rest = bytes_.subspan(at_);
    if (rest.size() < kLeader)
      refuse(fmt::format("{} bytes left, a leader has {}", rest.size(), kLeader));
    const auto length = number_in(rest.first(5));
    const auto base = number_in(rest.subspan(12, 5));
    const char kind = static_cast<char>(rest[6]);
    if (!length || !base) refuse("its leader holds no length and base address");
    if (kind != (record_ == 0 ? 'L' : 'D'))
      refuse(fmt::format("leader identifier 0x{:02X}, expected {}", rest[6],
                         record_ == 0 ? "L" : "D"));
    const auto digit = [&](std::size_t i) {
      const std::uint8_t c = rest[i];
      if (c < '1' || c > '9') refuse("its entry map is no digits");
      return static_cast<std::size_t>(c - '0');
    };
    const std::size_t size_width = digit(20), place_width = digit(21), tag_width = digit(23);
    if (tag_width != 4) refuse(fmt::format("field tags of {} letters, expected 4", tag_width));
    if (*length > rest.size())
      refuse(fmt::format("states {} bytes, the file has {} left", *length, rest.size()));
    // A length of 0 stands for more than 99999 bytes; the directory has the sum.
    const std::size_t most = *length == 0 ? rest.size() : *length;
    if (*base < kLeader + 1 || *base > most)
      refuse(fmt::format("base address {} outside its {} bytes", *base, most));

    const ByteSpan record = rest.first(most);
    const std::size_t entry = tag_width + size_width + place_width;
    if ((*base - kLeader - 1) % entry != 0 || record[*base - 1] != kFieldEnd)
      refuse("its directory does not end where the fields begin");
    fields_.clear();
    std::size_t expected = 0;
    for (std::size_t i = kLeader; i + 1 < *base; i += entry) {
      const auto size = number_in(record.subspan(i + tag_width, size_width));
      const auto place = number_in(record.subspan(i + tag_width + size_width, place_width));
      if (!size || !place) refuse("its directory holds no numbers");
      const std::string_view tag(reinterpret_cast<const char*>(record.data()) + i, tag_width);
      if (*size == 0 || *place != expected || *place + *size > most - *base)
        refuse(fmt::format("field {} at {} with {} bytes, expected at {} within {}", tag, *place,
                           *size, expected, most - *base));
      expected = *place + *size;
      fields_.push_back({tag, record.subspan(*base + *place, *size)});
      // Texts of national letters may have two bytes to the letter, the terminator too.
      if (tag != "NATF" && fields_.back().data.back() != kFieldEnd)
        refuse(fmt::format("field {} does not end with a field terminator", tag));
    }
    if (*length != 0 && expected != most - *base) refuse("its fields do not fill it");
    if (fields_.empty()) refuse("no fields");
    if (record_ == 0) {
      check_definitions();
    } else {
      look_at_fields();
    }
    at_ += *base + expected;
  }

  // The data definition: what the binary fields are made of.  S-57 fixes it; other formats would
  // make GDAL read past the ends of fields.
  void check_definitions() {
    struct Expected {
      std::string_view tag, format;
    };
    static constexpr std::array kExpected = {
        Expected{"VRID", "(b11,b14,b12,b11)"},
        Expected{"FRID", "(b11,b14,2b11,2b12,b11)"},
        Expected{"SG2D", "(2b24)"},
        Expected{"SG3D", "(3b24)"},
        Expected{"FOID", "(b12,b14,b12)"},
        Expected{"FSPT", "(B(40),3b11)"},
        Expected{"VRPT", "(B(40),4b11)"},
        Expected{"DSSI", "(3b11,8b14)"},
        Expected{"FSPC", "(b11,2b12)"},
        Expected{"VRPC", "(b11,2b12)"},
        Expected{"SGCC", "(b11,2b12)"},
        Expected{"ATTF", "(b12,A)"},
        Expected{"NATF", "(b12,A)"},
        Expected{"ATTV", "(b12,A)"},
        Expected{"FFPT", "(B(64),b11,A)"},
        Expected{"FFPC", "(b11,2b12)"},
    };
    bool features = false;
    for (const Field& field : fields_) {
      const std::string_view text(reinterpret_cast<const char*>(field.data.data()),
                                  field.data.size() - 1);
      features = features || field.tag == "FRID";
      for (const Expected& expected : kExpected) {
        if (field.tag == expected.tag && formats_of(text) != formats_of(expected.format))
          refuse(fmt::format("field {} is not defined as {}", field.tag, expected.format));
      }
    }
    if (!features) refuse("no feature records defined (field FRID)");
  }

  // One row of `width` bytes, or any number of them, and a terminator.
  void require_rows(const Field& field, std::size_t width, bool one) const {
    const std::size_t size = field.data.size() - 1;
    if (size % width != 0 || (one && size != width))
      refuse(fmt::format("field {} has {} bytes, expected {}{}", field.tag, size,
                         one ? "" : "a multiple of ", width));
  }

  // Rows of a number of two bytes and a text.
  void require_attributes(const Field& field) const {
    const ByteSpan rows = field.data.first(field.data.size() - 1);
    for (std::size_t i = 0; i < rows.size();) {
      const auto from = rows.begin() + static_cast<std::ptrdiff_t>(std::min(i + 2, rows.size()));
      const auto end = std::find(from, rows.end(), kUnitEnd);
      if (end == rows.end()) refuse(fmt::format("field {} is incomplete", field.tag));
      i = static_cast<std::size_t>(end - rows.begin()) + 1;
    }
  }

  void look_at_fields() {
    for (const Field& field : fields_) {
      const ByteSpan data = field.data;
      if (field.tag == "VRID") {
        require_rows(field, 8, true);
        ++facts_.vector_records;
        if (data[0] == 110) ++isolated_nodes_;
        if (data[0] == 120) ++connected_nodes_;
        if (data[0] == 130) ++edges_;
        if (data[0] == 140) ++faces_;
      } else if (field.tag == "FRID") {
        require_rows(field, 12, true);
        ++facts_.feature_records;
      } else if (field.tag == "FOID" || field.tag == "VRPT") {
        require_rows(field, field.tag == "FOID" ? 8 : 9, field.tag == "FOID");
      } else if (field.tag == "SG2D" || field.tag == "FSPT") {
        require_rows(field, 8, false);
      } else if (field.tag == "SG3D") {
        require_rows(field, 12, false);
      } else if (field.tag == "FSPC" || field.tag == "VRPC" || field.tag == "SGCC" ||
                 field.tag == "FFPC") {
        require_rows(field, 5, true);
        if (data[0] < 1 || data[0] > 3 || little_endian(data.subspan(1, 2)) < 1)
          refuse(
              fmt::format("field {} has instruction {} at index {}, expected 1 to 3 at 1 or more",
                          field.tag, data[0], little_endian(data.subspan(1, 2))));
      } else if (field.tag == "ATTF" || field.tag == "ATTV") {
        require_attributes(field);
      } else if (field.tag == "DSSI") {
        require_rows(field, 35, true);
        for (std::size_t i = 0; i < stated_.size(); ++i)
          stated_[i] = little_endian(data.subspan(3 + 4 * i, 4));
      } else if (field.tag == "DSID") {
        read_identification(data);
      }
    }
  }

  // (b11,b14,2b11,3A,...): DSNM, EDTN and UPDN are the first texts.
  void read_identification(ByteSpan data) {
    std::array<std::string, 3> texts;
    std::size_t i = 7;
    for (std::string& text : texts) {
      while (i < data.size() && data[i] != kUnitEnd && data[i] != kFieldEnd)
        text += static_cast<char>(data[i++]);
      if (i >= data.size() || data[i] != kUnitEnd || text.size() > 64)
        refuse("field DSID is incomplete");
      ++i;
    }
    const ByteSpan digits(reinterpret_cast<const std::uint8_t*>(texts[2].data()), texts[2].size());
    const auto update = number_in(digits);
    if (!update || *update > 999)
      refuse(fmt::format("update number \"{}\", expected 0 to 999", texts[2]));
    facts_.name = texts[0];
    facts_.edition = texts[1];
    facts_.update = static_cast<int>(*update);
    identified_ = true;
  }

  void compare_counts() const {
    // NOMR, NOCR, NOGR, NOLR: records of features; NOIN, NOCN, NOED, NOFA: of geometry.
    if (std::all_of(stated_.begin(), stated_.end(), [](std::uint32_t n) { return n == 0; })) return;
    const std::array<std::uint64_t, 5> found = {facts_.feature_records, isolated_nodes_,
                                                connected_nodes_, edges_, faces_};
    const std::array<std::uint64_t, 5> stated = {
        std::uint64_t{stated_[0]} + stated_[1] + stated_[2] + stated_[3], stated_[4], stated_[5],
        stated_[6], stated_[7]};
    static constexpr std::array kWhat = {"features", "isolated nodes", "connected nodes", "edges",
                                         "faces"};
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] < stated[i])
        refuse(fmt::format("field DSSI states {} {}, the file holds {}", stated[i], kWhat[i],
                           found[i]));
    }
  }

  ByteSpan bytes_;
  const std::string& file_;
  std::size_t at_ = 0, record_ = 0;
  std::vector<Field> fields_;
  bool identified_ = false;
  std::array<std::uint32_t, 8> stated_{};
  std::uint64_t isolated_nodes_ = 0, connected_nodes_ = 0, edges_ = 0, faces_ = 0;
  CellFacts facts_;
};

}  // namespace

std::vector<std::uint8_t> read_cell_file(const std::filesystem::path& file) {
  require_file(file, kMostCellBytes);
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(std::filesystem::file_size(file)));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream || stream.gcount() != static_cast<std::streamsize>(bytes.size()))
    throw std::runtime_error(fmt::format("cannot read chart file {}", file.string()));
  return bytes;
}

CellFacts check_cell(std::span<const std::uint8_t> bytes, const std::string& file) {
  return CellCheck(bytes, file).run();
}

}  // namespace skerry::echo
