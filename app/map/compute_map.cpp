#include "app/map/compute_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>

#include "app/map/cell_batch.h"
#include "app/map/cell_run.h"
#include "app/support/interrupt.h"
#include "app/support/parallel_for.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

using Clock = std::chrono::steady_clock;

// What a thread takes at once: rows of a block where cells run alone; where they run side by side,
// blocks whose cells share steps of one length, and with them the table of the twin's motion.
struct MapTask {
  std::vector<std::size_t> blocks;
  int row = -1;  // of the map; -1: all rows
};

class MapWork {
 public:
  MapWork(const MapJob& job, const std::vector<int>& missing) : job_(job), blocks_(blocks_of(job)) {
    std::map<int, MapTask> groups;
    for (const int b : missing) {
      const MapBlocks::Block block = blocks_[b];
      const std::size_t place = open_.size();
      open_.push_back({b, job.side_by_side ? 1 : block.y1 - block.y0,
                       std::vector<double>(kMapMeasures.size() * block.cells())});
      if (job.side_by_side)
        groups[group_of(b)].blocks.push_back(place);
      else
        for (int y = block.y0; y < block.y1; ++y) tasks_.push_back({{place}, y});
    }
    for (auto& [number, task] : groups) tasks_.push_back(std::move(task));
  }

  std::size_t tasks() const { return tasks_.size(); }

  // In a thread of its own.
  void work(std::size_t number) {
    const MapTask& task = tasks_[number];
    std::unique_ptr<CellBatch> batch = job_.side_by_side ? free_batch() : nullptr;
    compute(task, batch.get());
    const std::lock_guard held(lock_);
    if (batch) free_.push_back(std::move(batch));
    for (const std::size_t b : task.blocks)
      if (--open_[b].tasks_left == 0)
        finished_.emplace_back(open_[b].number, std::move(open_[b].values));
  }

  // Takes over what is finished since the last call.
  void collect(TileFile& file) {
    const std::lock_guard held(lock_);
    for (auto& [number, values] : finished_) file.blocks[number] = std::move(values);
    finished_.clear();
  }

 private:
  struct OpenBlock {
    int number, tasks_left;
    std::vector<double> values;
  };
  struct Cell {
    CellBatch::Place place;
    double* out;
  };

  // As many are made as threads work at once.
  std::unique_ptr<CellBatch> free_batch() {
    {
      const std::lock_guard held(lock_);
      if (!free_.empty()) {
        std::unique_ptr<CellBatch> batch = std::move(free_.back());
        free_.pop_back();
        return batch;
      }
    }
    return CellBatch::of(job_);
  }

  int group_of(int b) const {
    if (job_.x.path == "step") return b % blocks_.columns();
    return job_.y.path == "step" ? b / blocks_.columns() : b;
  }

  std::vector<Cell> cells_of(const MapTask& task) {
    std::vector<Cell> cells;
    for (const std::size_t b : task.blocks) {
      const MapBlocks::Block block = blocks_[open_[b].number];
      double* out = open_[b].values.data();
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x, out += kMapMeasures.size())
          if (task.row < 0 || task.row == y) cells.push_back({{job_.x.at(x), job_.y.at(y)}, out});
    }
    const bool by_x = job_.x.path == "step";
    std::stable_sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
      return by_x ? a.place.x < b.place.x : a.place.y < b.place.y;
    });
    return cells;
  }

  void compute(const MapTask& task, CellBatch* batch) {
    constexpr std::size_t kAtOnce = 512;  // between two looks for Ctrl-C
    const std::vector<Cell> cells = cells_of(task);
    for (std::size_t first = 0; first < cells.size(); first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, cells.size() - first);
      std::vector<CellBatch::Place> places;
      for (std::size_t i = 0; i < count; ++i) places.push_back(cells[first + i].place);
      std::vector<std::optional<CellValues>> found(count);
      if (batch) found = batch->run(places);
      for (std::size_t i = 0; i < count; ++i) {
        check_interrupt();
        const CellBatch::Place& at = places[i];
        if (!found[i]) found[i] = run_cell(job_, prepare_cell(job_, at.x, at.y));
        std::copy(found[i]->begin(), found[i]->end(), cells[first + i].out);
      }
    }
  }

  const MapJob& job_;
  const MapBlocks blocks_;
  std::vector<MapTask> tasks_;
  std::mutex lock_{};  // of what follows
  std::vector<OpenBlock> open_;
  std::vector<std::pair<int, std::vector<double>>> finished_;
  std::vector<std::unique_ptr<CellBatch>> free_;
};

// Writes the file where something came in and the last time is a second ago, or at the end.
class Keeper {
 public:
  Keeper(const TileFile& file, const std::filesystem::path& path)
      : file_(file), path_(path), kept_(file.blocks.size()) {}
  void keep(bool at_once) {
    if (file_.blocks.size() == kept_) return;
    if (!at_once && Clock::now() - last_ < std::chrono::seconds(1)) return;
    write_whole_file(path_, to_bytes(file_));
    kept_ = file_.blocks.size();
    last_ = Clock::now();
  }

 private:
  const TileFile& file_;
  const std::filesystem::path& path_;
  std::size_t kept_;
  Clock::time_point last_{};
};

}  // namespace

void compute_blocks(const MapJob& job, const std::vector<int>& wanted,
                    const std::filesystem::path& work, const ComputeOptions& options,
                    TileFile& file) {
  std::vector<int> missing;
  for (const int b : wanted)
    if (!file.blocks.contains(b)) missing.push_back(b);
  if (missing.empty()) return;
  MapWork cells(job, missing);
  Keeper keeper(file, work);
  Progress progress(options.quiet);
  progress.stage(
      missing.size() == wanted.size()
          ? fmt::format("map, {} blocks of cells", wanted.size())
          : fmt::format("map, {} of {} blocks of cells are left", missing.size(), wanted.size()),
      1);
  std::exception_ptr failure;
  try {
    parallel_for(
        cells.tasks(), [&](std::size_t task) { cells.work(task); },
        [&](std::size_t done) {
          check_interrupt();
          cells.collect(file);
          progress.advance(static_cast<double>(done) / static_cast<double>(cells.tasks()));
          keeper.keep(false);
        },
        options.threads);
  } catch (...) {  // what is finished is kept all the same
    failure = std::current_exception();
  }
  cells.collect(file);
  progress.finish();
  keeper.keep(true);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace twinarm
