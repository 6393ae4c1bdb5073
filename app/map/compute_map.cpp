#include "app/map/map_results.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <mutex>

#include "app/support/parallel_for.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

using Clock = std::chrono::steady_clock;

struct MapCell {
  std::pair<int, int> place;  // (iy, ix)
  CellPlace at;
};
// Work of a thread: a row of a block; with SIMD batches blocks whose cells have the same steps, and
// so share the table of the target's motion.
using MapTask = std::vector<MapCell>;

// Runs the cell as `twinarm simulate` does. Thread-safe. Throws Interrupted.
CellValues run_cell(const MapJob& job, const SimulatePlan& plan) {
  CellMeasure measure(plan, measured_joints(*plan.input.scene, job.measured_coupling));
  RunWatch watch;
  watch.interrupted = is_interrupted;
  watch.tick = [](double) { check_interrupt(); };
  watch.look = [&](SteppedRun& run) { measure.look(run); };
  return measure.values(run_plan(plan.input, plan.run, watch));
}

class MapWork {
 public:
  // The cells of the blocks that the file does not have.
  MapWork(const MapJob& job, const std::vector<int>& numbers, const TileFile& file) : job_(job) {
    const MapBlocks blocks{job.nx(), job.ny()};
    std::map<std::pair<int, int>, MapTask> groups;  // by group, or by block and row
    for (const int b : numbers) {
      const MapBlocks::Block block = blocks[b];
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
          if (!file.cells.contains({y, x})) {
            const auto group =
                job.side_by_side ? std::pair{group_of(b, blocks), 0} : std::pair{b, y};
            groups[group].push_back({{y, x}, {job.x.at(x), job.y.at(y)}});
          }
    }
    for (auto& [group, task] : groups) tasks_.push_back(std::move(task));
    const auto step_of = [by_x = job.x.path == "step"](const MapCell& cell) {
      return by_x ? cell.at.x : cell.at.y;
    };
    for (MapTask& task : tasks_) std::ranges::stable_sort(task, {}, step_of);
  }

  std::size_t tasks() const { return tasks_.size(); }

  void work(std::size_t number) {
    const MapTask& task = tasks_[number];
    CellBatch batch = job_.side_by_side ? free_batch() : nullptr;
    const std::vector<CellValues> values = compute(task, batch);
    const std::lock_guard held(lock_);
    if (batch) free_.push_back(std::move(batch));
    for (std::size_t i = 0; i < task.size(); ++i) finished_.emplace_back(task[i].place, values[i]);
  }

  // Moves the cells finished since the last call to the file.
  void collect(TileFile& file) {
    const std::lock_guard held(lock_);
    file.cells.insert(finished_.begin(), finished_.end());
    finished_.clear();
  }

 private:
  // At most one per thread is made.
  CellBatch free_batch() {
    std::unique_lock held(lock_);
    if (free_.empty()) {
      held.unlock();
      return cell_batch(job_);
    }
    CellBatch batch = std::move(free_.back());
    free_.pop_back();
    return batch;
  }

  int group_of(int b, const MapBlocks& blocks) const {
    if (job_.x.path == "step") return b % blocks.columns();
    return job_.y.path == "step" ? b / blocks.columns() : b;
  }

  std::vector<CellValues> compute(const MapTask& task, const CellBatch& batch) const {
    constexpr std::size_t kAtOnce = 512;  // cells between checks for Ctrl-C
    std::vector<CellValues> values;
    for (std::size_t first = 0; first < task.size(); first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, task.size() - first);
      std::vector<CellPlace> places;
      for (std::size_t i = 0; i < count; ++i) places.push_back(task[first + i].at);
      std::vector<std::optional<CellValues>> found(count);
      if (batch) found = batch(places);
      for (std::size_t i = 0; i < count; ++i) {
        check_interrupt();
        const CellPlace& at = places[i];
        values.push_back(found[i] ? *found[i] : run_cell(job_, prepare_cell(job_, at.x, at.y)));
      }
    }
    return values;
  }

  const MapJob& job_;
  std::vector<MapTask> tasks_;
  std::mutex lock_{};  // of the members below
  std::vector<std::pair<std::pair<int, int>, CellValues>> finished_;
  std::vector<CellBatch> free_;
};

// Writes the file if it has new cells: every second, less often if it is large, and at the end.
class FileUpdater {
 public:
  FileUpdater(const TileFile& file, const std::filesystem::path& path)
      : file_(file), path_(path), written_(file.cells.size()) {}
  void update(bool at_once) {
    const Clock::time_point begin = Clock::now();
    if (file_.cells.size() == written_ || (!at_once && begin < next_)) return;
    write_whole_file(path_, to_text(file_));
    written_ = file_.cells.size();
    const Clock::time_point end = Clock::now();
    next_ = end + std::max<Clock::duration>(std::chrono::seconds(1), 10 * (end - begin));
  }

 private:
  const TileFile& file_;
  const std::filesystem::path& path_;
  std::size_t written_;
  Clock::time_point next_{};
};

}  // namespace

void compute_blocks(const MapJob& job, const std::vector<int>& wanted,
                    const std::filesystem::path& work, unsigned threads, TileFile& file) {
  std::vector<int> missing = wanted;
  const MapBlocks blocks{job.nx(), job.ny()};
  std::erase_if(missing, [&](int b) { return file.has_all_of(blocks[b]); });
  if (missing.empty()) return;
  MapWork cells(job, missing, file);
  FileUpdater updater(file, work);
  Progress progress(false);
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
          cells.collect(file);
          progress.advance(done, cells.tasks());
          updater.update(false);
        },
        threads);
  } catch (...) {  // finished cells are written first
    failure = std::current_exception();
  }
  cells.collect(file);
  progress.finish();
  updater.update(true);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace twinarm
