#include "app/map/compute_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "app/map/cell_batch.h"
#include "app/map/cell_run.h"
#include "app/support/interrupt.h"
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

  void work_off() {
    std::unique_ptr<CellBatch> batch;
    std::unique_lock held(lock_);
    while (!stopped_ && next_ < tasks_.size()) {
      const MapTask& task = tasks_[next_++];
      held.unlock();
      std::exception_ptr failure;
      try {
        if (job_.side_by_side && !batch) batch = CellBatch::of(job_);
        compute(task, batch.get());
      } catch (...) {
        failure = std::current_exception();
      }
      held.lock();
      if (failure && !failure_) failure_ = failure;
      stopped_ = stopped_ || failure;
      if (failure) break;
      ++done_;
      for (const std::size_t b : task.blocks)
        if (--open_[b].tasks_left == 0)
          finished_.emplace_back(open_[b].number, std::move(open_[b].values));
    }
    ++ended_;
    news_.notify_one();
  }

  // Waits a moment; takes over what is finished since the last call. False when all threads ended.
  bool collect(unsigned threads, TileFile& file) {
    std::unique_lock held(lock_);
    news_.wait_for(held, std::chrono::milliseconds(100), [&] { return ended_ == threads; });
    if (is_interrupted()) stopped_ = true;
    for (auto& [number, values] : finished_) file.blocks[number] = std::move(values);
    finished_.clear();
    return ended_ < threads;
  }
  void stop() {
    const std::lock_guard held(lock_);
    stopped_ = true;
  }
  double part_done() {
    const std::lock_guard held(lock_);
    return static_cast<double>(done_) / static_cast<double>(tasks_.size());
  }
  void check() const {
    check_interrupt();
    if (failure_) std::rethrow_exception(failure_);
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
  std::mutex lock_{};
  std::condition_variable news_{};
  std::vector<OpenBlock> open_;
  std::vector<MapTask> tasks_;
  std::vector<std::pair<int, std::vector<double>>> finished_;
  std::size_t next_ = 0, done_ = 0;
  unsigned ended_ = 0;
  bool stopped_ = false;
  std::exception_ptr failure_{};
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
  unsigned threads = options.threads;
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::thread> pool;
  for (unsigned i = 0; i < threads; ++i) pool.emplace_back([&] { cells.work_off(); });
  std::exception_ptr failure;
  while (cells.collect(threads, file)) {
    progress.advance(cells.part_done());
    try {
      if (!failure) keeper.keep(false);
    } catch (...) {  // the disk is full: the threads end first
      failure = std::current_exception();
      cells.stop();
    }
  }
  for (std::thread& thread : pool) thread.join();
  cells.collect(threads, file);
  progress.finish();
  if (failure) std::rethrow_exception(failure);
  keeper.keep(true);
  cells.check();
}

}  // namespace twinarm
