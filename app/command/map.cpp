// `twinarm map`: sweeps two scene parameters (docs/use/parameter_maps.md).
#include <fmt/format.h>
#include <algorithm>

#include "app/command/command.h"
#include "app/data/json_writer.h"
#include "app/map/map_results.h"
#include "app/plot/gnuplot.h"
#include "app/record/recording.h"
#include "app/support/files.h"
#include "app/support/progress.h"
#include "app/support/text.h"
#include "solver/support/atomic_file.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

void add_options(const OptionAdder& add, MapOptions& options) {
  add.input("scene", options.scene, ".toml", "scene (TOML); default with --merge: its scene");
  add.group("Parameters");
  add("--x", options.x,
      "PATH:MIN:MAX:N[:log]: parameter of the scene along x, its range, number of cells (2 to "
      "4096)");
  add("--y", options.y, "PATH:MIN:MAX:N[:log]: the same for the vertical axis");
  add("--measure", options.measure,
      "result to print and draw: stable, max_error, mean_error, energy or passivity");
  add("--of", options.of, "coupling whose tracking error is measured; default: the first");
  add.group("Run");
  add("--duration", options.duration, "simulated time of each cell [s]; default: the scene's");
  add.scene_step(options.step, options.integrator);
  add("--no-simd", options.no_simd, "run cells one at a time, not in SIMD batches");
  add("--threads", options.threads, "number of threads; default: all processors")
      ->check(between(1, 1024))
      ->default_str("");
  add.group("Output");
  add.output("--svg", options.svg, ".svg", "write the map as SVG, with predicted limits");
  add.output("--png", options.png, ".png", "write the map as PNG, with predicted limits");
  add.output("--csv", options.csv, ".csv", "write one row per cell with all measures");
  add("--force", options.force, "overwrite existing files");
  add.json(options.json);
  add.group("One cell");
  add("--cell", options.cell, "IX,IY: index of a cell, from 0");
  add.output("--record", options.record, ".twinrec",
             "write the recording of that cell, and its scene beside it");
  add.group("Resume and share");
  add.output("--checkpoint", options.checkpoint, ".twinmap",
             "checkpoint file, from which an interrupted map resumes; default: in out/map");
  add("--jobs", options.jobs, "split the map into so many parts")->default_str("");
  add("--job", options.job, "compute only this part, from 0")->default_str("");
  add.input("--merge", options.merge, ".twinmap", "combine these checkpoint files of the parts");
}

bool file_exists(const std::filesystem::path& file) {
  std::error_code ignored;
  return !file.empty() && std::filesystem::exists(file, ignored);
}

// Checks before the computation that the file overwrites nothing.
void check_new(const char* option, const std::filesystem::path& file, bool force,
               DiagnosticList& faults) {
  if (file_exists(file) && !force)
    faults.add({file.string(), 0, option, "the file exists", "choose another name, or give --force",
                "file.exists"});
}

bool is_part(const MapOptions& options) {
  return options.jobs != 0 || options.job != -1;
}

void check_modes(const MapOptions& options, DiagnosticList& faults) {
  const bool part = is_part(options);
  if (part && (options.jobs < 1 || options.job < 0 || options.job >= options.jobs))
    faults.add("--jobs, --job", fmt::format("there is no job {} of {}", options.job, options.jobs),
               "give --jobs N with N at least 1, and --job I with I from 0 to N - 1", "map.part");
  if (part && !(options.svg.empty() && options.png.empty() && options.csv.empty()))
    faults.add("--job", "a single job has no picture and no table",
               "give --svg, --png and --csv together with --merge", "map.part-output");
  if (!options.merge.empty() && (part || !options.cell.empty()))
    faults.add("--merge", "merges finished files of jobs", "leave --jobs, --job and --cell out",
               "map.merge-options");
  if (!options.cell.empty() && part)
    faults.add("--cell", "cannot be combined with --job", "leave --job out", "map.cell-options");
  if (options.cell.empty() != options.record.empty())
    faults.add(options.cell.empty() ? "--record" : "--cell",
               options.cell.empty() ? "needs --cell" : "needs --record",
               "give --cell IX,IY --record FILE together", "map.cell-options");
}

void check_outputs(const MapOptions& options, DiagnosticList& faults) {
  check_new("--svg", options.svg, options.force, faults);
  check_new("--png", options.png, options.force, faults);
  check_new("--csv", options.csv, options.force, faults);
  if (!options.svg.empty() || !options.png.empty()) attempt(faults, require_gnuplot);
  if (!options.merge.empty()) check_new("--checkpoint", options.checkpoint, options.force, faults);
  if (!options.record.empty()) {
    std::filesystem::path scene = options.record;
    scene.replace_extension(".toml");
    check_new("--record", options.record, options.force, faults);
    check_new("--record", scene, options.force && !is_same_file(scene, options.scene), faults);
  }
}

// --checkpoint, or a file in out/map whose name is unique for the map.
std::filesystem::path work_file(const MapOptions& options, const TileFile& empty) {
  if (!options.checkpoint.empty()) return options.checkpoint;
  std::string all;
  for (const std::string& line : empty.head)
    if (!line.starts_with("scene ")) all += line + "\n";
  const std::string part =
      is_part(options) ? fmt::format("-{}-of-{}", options.job, options.jobs) : "";
  return std::filesystem::path("out") / "map" /
         fmt::format("{}-{:08x}{}.twinmap", options.scene.stem().string(),
                     hash_of(all) & 0xffffffffU, part);
}

// Blocks job, job + jobs, ..: jobs of similar cost.
std::vector<int> wanted_blocks(const MapOptions& options, const MapBlocks& blocks) {
  std::vector<int> wanted;
  const int step = is_part(options) ? options.jobs : 1;
  for (int b = is_part(options) ? options.job : 0; b < blocks.count(); b += step)
    wanted.push_back(b);
  if (wanted.empty())
    throw InputError("--jobs",
                     fmt::format("the map has {} blocks of 16 x 16 cells, fewer than {} jobs",
                                 blocks.count(), options.jobs),
                     "give fewer --jobs", "map.part");
  return wanted;
}

void write_results(const MapOptions& options, const MapJob& job, const TileFile& file) {
  const bool wants_curves = options.json || !options.svg.empty() || !options.png.empty();
  const std::vector<MapCurve> curves = wants_curves ? theory_curves(job) : std::vector<MapCurve>{};
  if (!options.csv.empty()) write_whole_file(options.csv, map_csv(job, file));
  if (!options.svg.empty()) write_whole_file(options.svg, map_svg(job, file, curves));
  if (!options.png.empty()) write_whole_file(options.png, map_png(job, file, curves));
  if (options.json)
    fmt::print("{}\n", map_json(job, file, curves));
  else
    fmt::print("{}", map_words(job, file));
  print_wrote({options.csv, options.svg, options.png}, options.json);
}

int record_one_cell(const MapOptions& options, const MapJob& job) {
  const auto at = parse_cell(options.cell, job);
  const OpenedCell cell = open_cell(job, at.first, at.second, options.record);
  if (!options.json) {
    fmt::print("{} = {} {}, {} = {} {}\n", job.x.path, number_text(cell.x), job.x_unit, job.y.path,
               number_text(cell.y), job.y_unit);
    for (std::size_t m = 0; m < kMapMeasures.size(); ++m)
      fmt::print("{}: {}\n", kMapMeasures[m], short_number_text(cell.values[m]));
    fmt::print("recording: {}\nsame run: {}\n", options.record.string(), cell.command);
    return 0;
  }
  const auto write = [&](JsonWriter& json) {
    json.members({{"cell", std::array{at.first, at.second}}, {"x", cell.x}, {"y", cell.y}});
    for (std::size_t m = 0; m < kMapMeasures.size(); ++m) json.put(kMapMeasures[m], cell.values[m]);
    json.members({{"recording", options.record.string()},
                  {"scene", cell.scene.string()},
                  {"command", cell.command}});
  };
  fmt::print("{}\n", answer_text(write));
  return 0;
}

// With --merge, options that are not given are taken from the first file.
MapOptions with_merged(MapOptions options) {
  if (options.merge.empty()) return options;
  const TileFile first = read_tile_file(options.merge.front());
  const auto take = [&](std::string& option, const char* key) {
    if (option.empty()) option = first.value_of(key);
    if (option == identity::kAsScene || option == identity::kFirstCoupling) option.clear();
  };
  const auto take_number = [&](std::optional<double>& option, const char* key) {
    if (!option) option = parse_number(first.value_of(key));
  };
  if (options.scene.empty()) options.scene = first.value_of("scene");
  take(options.x, "x");
  take(options.y, "y");
  take(options.of, "of");
  take(options.integrator, "integrator");
  options.no_simd = first.value_of("cells") == identity::kOneByOne;
  take_number(options.duration, "duration");
  take_number(options.step, "step");
  return options;
}

int compute(const MapOptions& options, const MapJob& job) {
  const TileFile empty = empty_tile_file(job);
  const MapBlocks blocks{job.nx(), job.ny()};
  const std::filesystem::path work = work_file(options, empty);
  if (!options.merge.empty()) {
    const TileFile file = merge_tile_files(options.merge, empty, blocks);
    if (!options.checkpoint.empty()) write_whole_file(work, to_text(file));
    write_results(options, job, file);
    return 0;
  }
  const std::vector<int> wanted = wanted_blocks(options, blocks);
  TileFile file = file_exists(work) ? resume_tile_file(work, empty, blocks, options.force) : empty;
  const auto is_finished = [&](int block) { return file.has_all_of(blocks[block]); };
  if (!std::ranges::all_of(wanted, is_finished))
    require_writable_folder(folder_of(work), "--checkpoint");
  try {
    compute_blocks(job, wanted, work, options.threads, file);
  } catch (const Interrupted&) {
    print_error("twinarm: {} of {} blocks of cells are finished, in {}; the same command resumes\n",
                std::ranges::count_if(wanted, is_finished), wanted.size(), work.string());
    throw;
  }
  if (!is_part(options)) {
    write_results(options, job, file);
  } else if (options.json) {
    fmt::print("{}\n", answer_text({{"job", options.job},
                                    {"jobs", options.jobs},
                                    {"blocks", wanted.size()},
                                    {"file", work.string()}}));
  } else {
    fmt::print("{}\n", work.string());
  }
  return 0;
}

int run_map(const MapOptions& given) {
  DiagnosticList faults;
  check_modes(given, faults);
  check_outputs(given, faults);
  faults.check();
  const MapOptions options = with_merged(given);
  const MapJob job = read_map_job(options);
  return options.cell.empty() ? compute(options, job) : record_one_cell(options, job);
}

}  // namespace

Command map_command() {
  return {130, "map",
          "Sweep two parameters of a scene: stability, tracking error and energy of each run\n\n"
          "Examples:\n"
          "  twinarm map assets/scenes/tracking_map.toml --x coupling.stiffness:1e4:1e6:64:log "
          "--y step:1e-3:1e-2:64:log --svg map.svg\n"
          "  twinarm map assets/scenes/tracking_map.toml --x coupling.stiffness:1e4:1e6:16:log "
          "--y coupling.damping:10:1e4:16:log --measure max_error --csv map.csv",
          add_options, run_map};
}

}  // namespace twinarm
