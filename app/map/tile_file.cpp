#include "app/map/map_results.h"

#include <fmt/format.h>

#include "app/support/files.h"
#include "app/support/text.h"
#include "app/support/version.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

constexpr const char* kFirstLine = "# twinarm map 2\n";
constexpr std::string_view kHeadMark = "# ";  // before each line of the head
constexpr const char* kFirstLineOfOld = "twinarm map 1\n";
constexpr std::uintmax_t kMaxTileBytes = 512u << 20;  // four million cells
constexpr const char* kOtherFile = "give a file of `twinarm map --checkpoint` or `--job`";

std::string table_heading() {
  std::string line = "ix,iy";
  for (const char* measure : kMapMeasures) line += std::string(",") + measure;
  return line;
}

InputError not_readable(const std::filesystem::path& path, int line, const std::string& problem,
                        const std::string& fix, std::string_view code) {
  return InputError({{path.string(), line, "", problem, fix, code}});
}

std::string key_of(const std::string& line) {
  return line.substr(0, line.find(' '));
}

// Adds a line of the table to `file`; false if it is invalid or repeated.
bool read_cell(const std::string& line, TileFile& file) {
  const std::vector<std::string> fields = split(line);
  if (fields.size() != 2 + kMapMeasures.size()) return false;
  std::array<double, 2 + kMapMeasures.size()> numbers{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<double> number = parse_number(fields[i]);
    const bool is_empty = i > 2 && fields[i].empty();  // a measure without a value
    if (!number && !is_empty) return false;
    numbers[i] = number.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  for (const double index : {numbers[0], numbers[1]})
    if (index < 0 || index > 1e9 || index != std::floor(index)) return false;
  const std::pair place{static_cast<int>(numbers[1]), static_cast<int>(numbers[0])};
  CellValues values;
  std::copy(numbers.begin() + 2, numbers.end(), values.begin());
  return file.cells.emplace(place, values).second;
}

bool is_same(const CellValues& a, const CellValues& b) {
  return std::ranges::equal(a, b, [](double one, double other) {
    return one == other || (std::isnan(one) && std::isnan(other));
  });
}

}  // namespace

MapBlocks::Block MapBlocks::operator[](int b) const {
  const int x0 = b % columns() * kSide, y0 = b / columns() * kSide;
  return {x0, std::min(x0 + kSide, nx), y0, std::min(y0 + kSide, ny)};
}

std::string TileFile::value_of(const std::string& key) const {
  for (const std::string& line : head)
    if (key_of(line) == key) return line.size() > key.size() ? line.substr(key.size() + 1) : "";
  return "";
}

bool TileFile::has_all_of(const MapBlocks::Block& block) const {
  for (int iy = block.y0; iy < block.y1; ++iy)
    for (int ix = block.x0; ix < block.x1; ++ix)
      if (!cells.contains({iy, ix})) return false;
  return true;
}

TileFile empty_tile_file(const MapJob& job) {
  TileFile file;
  file.head = {std::string("program ") + kProgramVersion,
               "scene " + job.run.robot.model.generic_string()};
  file.head.insert(file.head.end(), job.identity.begin(), job.identity.end());
  return file;
}

std::string csv_fields(const CellValues& values) {
  std::string text;
  for (const double value : values) text += "," + (std::isfinite(value) ? number_text(value) : "");
  return text + "\n";
}

std::string to_text(const TileFile& file) {
  std::string text = kFirstLine;
  for (const std::string& line : file.head) text += std::string(kHeadMark) + line + "\n";
  text += table_heading() + "\n";
  for (const auto& [place, values] : file.cells)
    text += std::to_string(place.second) + "," + std::to_string(place.first) + csv_fields(values);
  return text;
}

TileFile read_tile_file(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::file_size(path, unknown) > kMaxTileBytes && !unknown)
    throw not_readable(path, 0, "has more than 512 MiB", kOtherFile, "file.too-large");
  const std::string text = read_whole_file(path);
  if (text.starts_with(kFirstLineOfOld))
    throw not_readable(path, 0, "has the format of an earlier version of twinarm",
                       "delete it and compute its job again", "map.old-file");
  if (!text.starts_with(kFirstLine))
    throw not_readable(path, 0, "is not a map file", kOtherFile, "map.file-form");
  TileFile file;
  bool is_table = false;
  int number = 1;
  for (std::size_t at = text.find('\n') + 1, end = 0; at < text.size(); at = end + 1) {
    end = text.find('\n', at);
    ++number;
    const auto damaged = [&](const std::string& how, std::string_view code) {
      return not_readable(path, number, "the map file is damaged: " + how,
                          "delete it and compute its job again", code);
    };
    if (end == text.npos) throw damaged("it is truncated", "map.cut-short");
    const std::string line = text.substr(at, end - at);
    if (!is_table && line.starts_with(kHeadMark))
      file.head.push_back(line.substr(kHeadMark.size()));
    else if (!is_table && line == table_heading())
      is_table = true;
    else if (!is_table || !read_cell(line, file))
      throw damaged(is_table ? "invalid or repeated cell" : "invalid header line", "map.row");
  }
  if (!is_table) throw not_readable(path, 0, "is not a map file", kOtherFile, "map.file-form");
  return file;
}

void add_cells(const TileFile& from, const MapBlocks& blocks, const std::filesystem::path& path,
               const std::string& fix, TileFile& into) {
  DiagnosticList faults;
  for (const std::string& line : into.head) {
    const std::string key = key_of(line);
    if (key == "scene") continue;  // the content is compared, not the path
    const std::string here = from.value_of(key), there = into.value_of(key);
    if (here == there) continue;
    const std::string what = key == "content" ? "the scene, or a file that it names, differs"
                             : key == "of"    ? "it measures " + here + ", not " + there
                                              : key + " is " + here + ", not " + there;
    faults.add({path.string(), 0, "", "the file is of another map: " + what, fix, "map.other-map"});
  }
  faults.check();
  for (const auto& [place, values] : from.cells) {
    const auto [iy, ix] = place;
    const auto fault = [&, x = ix, y = iy](const char* problem) {
      faults.add({path.string(), 0, fmt::format("cell {},{}", x, y), problem,
                  "delete the file and compute its job again", "map.blocks"});
    };
    if (ix >= blocks.nx || iy >= blocks.ny)
      fault("is outside the map");
    else if (!is_same(into.cells.emplace(place, values).first->second, values))
      fault("has other values in another file");
  }
  faults.check();
}

TileFile resume_tile_file(const std::filesystem::path& work, const TileFile& empty,
                          const MapBlocks& blocks, bool force) {
  TileFile file = empty;
  try {
    add_cells(read_tile_file(work), blocks, work, "name another --checkpoint, or give --force",
              file);
  } catch (const InputError&) {
    if (force) return empty;
    throw;
  }
  return file;
}

TileFile merge_tile_files(const std::vector<std::filesystem::path>& parts, const TileFile& empty,
                          const MapBlocks& blocks) {
  TileFile file = empty;
  DiagnosticList faults;
  for (const std::filesystem::path& path : parts)
    attempt(faults,
            [&] { add_cells(read_tile_file(path), blocks, path, "merge files of one map", file); });
  std::string missing;
  int count = 0;
  for (int b = 0; b < blocks.count(); ++b)
    if (!file.has_all_of(blocks[b]) && ++count <= 10) missing += " " + std::to_string(b);
  if (count > 0)
    faults.add("--merge",
               fmt::format("{} of {} blocks are missing:{}{}", count, blocks.count(), missing,
                           count > 10 ? " .." : ""),
               "give the files of all jobs; repeat --job for those that failed",
               "map.blocks-missing");
  faults.check();
  return file;
}

}  // namespace twinarm
