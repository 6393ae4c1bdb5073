// The files that pages have uploaded. Their number and bytes are limited: the oldest are removed.
#pragma once

#include <pthread.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace twinarm {

class UploadFolder {
 public:
  explicit UploadFolder(std::filesystem::path folder, std::size_t max_files = 256,
                        std::size_t max_bytes = std::size_t{256} << 20)
      : folder_(std::move(folder)), max_files_(max_files), max_bytes_(max_bytes) {}

  const std::filesystem::path& path() const { return folder_; }
  // A relative name without "..". Returns the whole path. Throws InputError.
  std::filesystem::path write(const std::string& name, const std::string& bytes);

 private:
  struct Upload {
    std::filesystem::path file;
    std::size_t bytes = 0;
  };
  void remove(const Upload& upload);

  std::filesystem::path folder_;
  std::size_t max_files_, max_bytes_, bytes_ = 0;
  std::deque<Upload> uploads_;  // the oldest first
};

// What a page brings: a robot, a scene or a recording is opened; meshes and textures wait for the
// robot that names them; all else is refused with a word of what it is.
struct BroughtFile {
  std::string path;    // that it is written to: of a robot in .xml or .xacro, .urdf
  bool opens = false;  // else it is kept
  std::string fault;   // empty: none
};

BroughtFile brought_file(const std::string& name, const std::string& bytes);

// A thread that does one thing after the other, in the order in which they were asked for.
class TaskQueue {
 public:
  // `failed` gets what an errand throws, from the thread of the errands.
  explicit TaskQueue(std::function<void(const std::string& why)> failed)
      : failed_(std::move(failed)), thread_([this] { work(); }) {}
  ~TaskQueue() { end(); }
  TaskQueue(const TaskQueue&) = delete;
  TaskQueue& operator=(const TaskQueue&) = delete;

  // From any thread. False where too many wait already.
  bool add(std::function<void()> errand) {
    {
      const std::lock_guard lock(mutex_);
      if (errands_.size() >= kMax || stop_) return false;
      errands_.push_back(std::move(errand));
    }
    wake_.notify_one();
    return true;
  }
  // After the one that is being done; what waits is left.
  void end() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }

 private:
  static constexpr std::size_t kMax = 16;

  void work() {
    pthread_setname_np(pthread_self(), "lab errands");
    for (;;) {
      std::function<void()> errand;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return stop_ || !errands_.empty(); });
        if (stop_) return;
        errand = std::move(errands_.front());
        errands_.pop_front();
      }
      try {
        errand();
      } catch (const std::exception& error) {
        failed_(error.what());
      }
    }
  }

  std::function<void(const std::string&)> failed_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> errands_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace twinarm
