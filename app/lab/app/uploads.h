// Files uploaded by clients, limited in number and bytes. Beyond, the oldest of the client with the
// largest share are removed first: no client displaces the files of one that has less.
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

#include "app/lab/server/lab_server.h"

namespace twinarm {

class UploadFolder {
 public:
  explicit UploadFolder(std::filesystem::path folder, std::size_t max_files = 256,
                        std::size_t max_bytes = std::size_t{256} << 20)
      : folder_(std::move(folder)), max_files_(max_files), max_bytes_(max_bytes) {}

  const std::filesystem::path& path() const { return folder_; }
  // `name`: relative, without "..". Returns the absolute path. Throws InputError.
  std::filesystem::path write(ClientId client, const std::string& name, const std::string& bytes);

 private:
  struct Upload {
    ClientId client = 0;
    std::filesystem::path file;
    std::size_t bytes = 0;
  };
  void remove_one(const Upload& next);

  std::filesystem::path folder_;
  std::size_t max_files_, max_bytes_, bytes_ = 0;
  std::deque<Upload> uploads_;  // the oldest first
};

// Robots, scenes and recordings are opened; meshes and textures are stored for a robot that names
// them; anything else is refused.
struct UploadedFile {
  std::string path;    // to write to; .urdf for a robot in .xml or .xacro
  bool opens = false;  // else it is stored
  std::string fault;   // empty: none
};

UploadedFile classify_upload(const std::string& name, const std::string& bytes);

// Executes tasks in its own thread, in order.
class TaskQueue {
 public:
  static constexpr std::size_t kMax = 16, kMaxReads = 12;  // reads leave places for uploads
  // `failed` is called from that thread with what a task throws.
  explicit TaskQueue(std::function<void(const std::string& why)> failed)
      : failed_(std::move(failed)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

  // From any thread. False: too many are waiting.
  bool add(std::function<void()> task, bool is_upload = true) {
    {
      const std::lock_guard lock(mutex_);
      if (tasks_.size() >= (is_upload ? kMax : kMaxReads)) return false;
      if (thread_.get_stop_token().stop_requested()) return false;
      tasks_.push_back(std::move(task));
    }
    wake_.notify_one();
    return true;
  }
  // Finishes the present task and drops the waiting ones.
  void end() {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
  }

 private:
  void work(const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "lab tasks");
    for (;;) {
      std::function<void()> task;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, stop, [this] { return !tasks_.empty(); });
        if (stop.stop_requested()) return;
        task = std::move(tasks_.front());
        tasks_.pop_front();
      }
      try {
        task();
      } catch (const std::exception& error) {
        failed_(error.what());
      }
    }
  }

  std::function<void(const std::string&)> failed_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::deque<std::function<void()>> tasks_;
  std::jthread thread_;
};

}  // namespace twinarm
