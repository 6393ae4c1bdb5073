#include "app/map/compute_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "app/interrupt.h"
#include "app/map/cell_run.h"
#include "app/progress.h"
#include "solver/whole_file.h"

namespace twinarm {
namespace {

using Clock = std::chrono::steady_clock;

// The rows of the blocks, one after the other; threads take them one by one.
class MapWork {
 public:
  MapWork(const MapJob& job, const std::vector<int>& missing) : job_(job), blocks_(blocks_of(job)) {
    for (const int b : missing) {
      const MapBlocks::Block block = blocks_[b];
      open_.push_back(
          {b, block.y1 - block.y0, std::vector<double>(kMapMeasures.size() * block.cells())});
      for (int y = block.y0; y < block.y1; ++y) rows_.push_back({open_.size() - 1, y});
    }
  }

  void work_off() {
    std::unique_lock held(lock_);
    while (!stopped_ && next_ < rows_.size()) {
      const Row row = rows_[next_++];
      held.unlock();
      std::exception_ptr failure;
      try {
        compute(row);
      } catch (...) {
        failure = std::current_exception();
      }
      held.lock();
      if (failure && !failure_) failure_ = failure;
      stopped_ = stopped_ || failure;
      if (!failure) ++done_;
      OpenBlock& block = open_[row.block];
      if (!failure && --block.rows_left == 0) finished_.emplace_back(block.number, block.values);
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
    return static_cast<double>(done_) / static_cast<double>(rows_.size());
  }
  void check() const {
    check_interrupt();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  struct OpenBlock {
    int number, rows_left;
    std::vector<double> values;
  };
  struct Row {
    std::size_t block;
    int y;
  };

  void compute(const Row& row) {
    const MapBlocks::Block block = blocks_[open_[row.block].number];
    double* values =
        open_[row.block].values.data() +
        kMapMeasures.size() * static_cast<std::size_t>((row.y - block.y0) * (block.x1 - block.x0));
    const double y = job_.y.at(row.y);
    for (int ix = block.x0; ix < block.x1; ++ix) {
      const CellValues cell = run_cell(job_, prepare_cell(job_, job_.x.at(ix), y));
      values = std::copy(cell.begin(), cell.end(), values);
    }
  }

  const MapJob& job_;
  const MapBlocks blocks_;
  std::mutex lock_{};
  std::condition_variable news_{};
  std::vector<OpenBlock> open_;
  std::vector<Row> rows_;
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
