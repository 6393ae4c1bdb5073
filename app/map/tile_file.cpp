#include "app/map/tile_file.h"

#include <fmt/format.h>

#include <cstring>

#include "app/record/recording.h"
#include "app/support/output_file.h"
#include "app/support/version.h"
#include "solver/support/state_archive.h"

namespace twinarm {
namespace {

constexpr const char* kFirstLine = "twinarm map 1";
constexpr std::size_t kHeadMost = 65536;               // bytes
constexpr std::uintmax_t kMostTileBytes = 256u << 20;  // four million cells

std::string block_bytes(int number, const std::vector<double>& values) {
  Memory memory;
  auto n = static_cast<std::uint32_t>(number);
  auto cells = static_cast<std::uint32_t>(values.size());
  memory.visit(n);
  memory.visit(cells);
  for (double value : values) memory.visit(value);
  auto sum = hash_of(memory.bytes());
  memory.visit(sum);
  return memory.bytes();
}

InputError is_damaged(const std::filesystem::path& path, const std::string& how,
                      std::string_view code) {
  return InputError({{path.string(), 0, "", "the file of a map is damaged: " + how,
                      "delete it, and compute its part again", code}});
}

std::string key_of(const std::string& line) {
  return line.substr(0, line.find(' '));
}

bool is_compared(const std::string& key) {
  return key != "scene";  // its content is; where it lies may differ
}

}  // namespace

std::string TileFile::value_of(const std::string& key) const {
  for (const std::string& line : head)
    if (key_of(line) == key) return line.size() > key.size() ? line.substr(key.size() + 1) : "";
  return "";
}

MapBlocks blocks_of(const MapJob& job) {
  return {job.nx(), job.ny()};
}

TileFile empty_tile_file(const MapJob& job) {
  TileFile file;
  file.head = {std::string("program ") + kProgramVersion,
               "scene " + job.run.robot.model.generic_string()};
  file.head.insert(file.head.end(), job.identity.begin(), job.identity.end());
  return file;
}

std::string to_bytes(const TileFile& file) {
  std::string bytes = std::string(kFirstLine) + "\n";
  for (const std::string& line : file.head) bytes += line + "\n";
  bytes += "\n";
  for (const auto& [number, values] : file.blocks) bytes += block_bytes(number, values);
  return bytes;
}

TileFile read_tile_file(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::file_size(path, unknown) > kMostTileBytes && !unknown)
    throw InputError(
        {{path.string(), 0, "", "has more than 256 MiB: no map is as large",
          "give a file that `twinarm map` has written with --work or --tile", "file.too-large"}});
  const std::string bytes = read_whole_file(path);
  const std::size_t end = bytes.substr(0, kHeadMost).find("\n\n");
  if (!bytes.starts_with(std::string(kFirstLine) + "\n") || end == std::string::npos)
    throw InputError(
        {{path.string(), 0, "", "is no file of a map",
          "give a file that `twinarm map` has written with --work or --tile", "map.file-form"}});
  TileFile file;
  for (std::size_t at = bytes.find('\n') + 1; at < end + 1;) {
    const std::size_t line_end = bytes.find('\n', at);
    file.head.push_back(bytes.substr(at, line_end - at));
    at = line_end + 1;
  }
  for (std::size_t at = end + 2; at < bytes.size();) {
    std::uint32_t number = 0, cells = 0;
    constexpr std::size_t kFrame = 2 * sizeof number + sizeof(std::uint64_t);
    if (bytes.size() - at < kFrame) throw is_damaged(path, "its end is cut off", "map.cut-short");
    std::memcpy(&number, bytes.data() + at, sizeof number);
    std::memcpy(&cells, bytes.data() + at + sizeof number, sizeof cells);
    if (cells > kMapMeasures.size() * MapBlocks::kSide * MapBlocks::kSide)
      throw is_damaged(path, "a block is too large", "map.block-size");
    if (bytes.size() - at < kFrame + 8 * cells)
      throw is_damaged(path, "its end is cut off", "map.cut-short");
    std::vector<double> values(cells);
    if (cells > 0)  // else there is no place to copy to
      std::memcpy(values.data(), bytes.data() + at + 2 * sizeof number, 8 * cells);
    const std::string again = block_bytes(static_cast<int>(number), values);
    if (bytes.compare(at, again.size(), again) != 0)
      throw is_damaged(path, fmt::format("block {} has another check sum", number), "map.checksum");
    file.blocks[static_cast<int>(number)] = std::move(values);
    at += again.size();
  }
  return file;
}

void check_same_map(const TileFile& found, const TileFile& wanted,
                    const std::filesystem::path& path, const std::string& remedy,
                    FaultList& faults) {
  for (const std::string& line : wanted.head) {
    const std::string key = key_of(line);
    if (!is_compared(key)) continue;
    const std::string here = found.value_of(key), there = wanted.value_of(key);
    if (here == there) continue;
    const std::string what = key == "content"
                                 ? "the scene, or a file that it names, is not the same"
                             : key == "of" ? "it measures " + here + ", not " + there
                                           : key + " is " + here + ", not " + there;
    faults.add(
        {path.string(), 0, "", "the file is of another map: " + what, remedy, "map.other-map"});
  }
}

void add_blocks(const TileFile& from, const MapBlocks& blocks, const std::filesystem::path& path,
                TileFile& into, FaultList& faults) {
  const auto fault = [&](int number, const char* rule) {
    faults.add({path.string(), 0, fmt::format("block {}", number), rule,
                "delete the file, and compute its part again", "map.blocks"});
  };
  for (const auto& [number, values] : from.blocks) {
    if (number < 0 || number >= blocks.count() ||
        values.size() != kMapMeasures.size() * blocks[number].cells()) {
      fault(number, "the map has no block of that size there");
      continue;
    }
    const auto [place, is_new] = into.blocks.emplace(number, values);
    if (!is_new && std::memcmp(place->second.data(), values.data(), 8 * values.size()) != 0)
      fault(number, "another file has other values for it");
  }
}

TileFile resume_tile_file(const std::filesystem::path& work, const TileFile& empty,
                          const MapBlocks& blocks, bool force) {
  TileFile file = empty;
  FaultList faults;
  const auto found = attempt(faults, [&] { return read_tile_file(work); });
  if (found) check_same_map(*found, empty, work, "name another --work, or give --force", faults);
  if (found && faults.empty()) add_blocks(*found, blocks, work, file, faults);
  if (force && !faults.empty()) return empty;
  faults.check();
  return file;
}

TileFile merge_tile_files(const std::vector<std::filesystem::path>& parts, const TileFile& empty,
                          const MapBlocks& blocks) {
  TileFile file = empty;
  FaultList faults;
  for (const std::filesystem::path& path : parts) {
    const auto part = attempt(faults, [&] { return read_tile_file(path); });
    if (!part) continue;
    FaultList of_this;
    check_same_map(*part, empty, path, "merge files of one map", of_this);
    if (of_this.empty()) add_blocks(*part, blocks, path, file, of_this);
    attempt(faults, [&] {
      of_this.check();
      return true;
    });
  }
  std::string missing;
  int count = 0;
  for (int b = 0; b < blocks.count(); ++b)
    if (!file.blocks.contains(b) && ++count <= 10) missing += " " + std::to_string(b);
  if (count > 0)
    faults.add({"", 0, "--merge",
                fmt::format("{} of {} blocks are missing:{}{}", count, blocks.count(), missing,
                            count > 10 ? " .." : ""),
                "give the files of all parts; compute those that failed with --tile again",
                "map.blocks-missing"});
  faults.check();
  return file;
}

}  // namespace twinarm
