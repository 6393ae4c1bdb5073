#include "app/lab/workshop.h"

#include <pthread.h>

#include "app/record/recording_reader.h"
#include "solver/fault.h"

namespace twinarm {
namespace {

std::shared_ptr<const LabScene> open_scene(const std::filesystem::path& file) {
  if (file.extension() == ".twinrec")
    return std::make_shared<const LabScene>(Recording(file).header());
  SimulateOptions options;
  options.robot.model = file;
  return std::make_shared<const LabScene>(options);
}

std::string words_of(const InputError& error) {
  std::string words;
  for (const Fault& fault : error.faults()) words += (words.empty() ? "" : "\n") + to_string(fault);
  return words;
}

}  // namespace

Order order_to_open(const GalleryScene& scene) {
  Order order;
  order.file = scene.file;
  order.name = scene.name;
  order.words.title = scene.title;
  order.words.file = scene.file.filename().string();
  order.words.look.assign(scene.look.begin(), scene.look.end());
  order.lanes = scene.lanes;
  return order;
}

Built build(Order order) {
  Built built;
  if (!order.lanes.empty()) put(order.changes, order.lanes.change(0));
  built.scene = order.what == Order::What::open ? open_scene(order.file) : order.scene;
  built.header = built.scene->header(order.changes, {});
  built.run = built.scene->plan(order.changes);
  built.view = built.scene->plan(order.changes);
  built.knobs = built.scene->plan(order.changes);
  for (std::size_t lane = 1; lane < order.lanes.values.size(); ++lane) {
    std::vector<Change> changes = order.changes;
    put(changes, order.lanes.change(lane));
    built.lanes.push_back(built.scene->plan(changes));
    built.lane_views.push_back(built.scene->plan(changes));
  }
  built.order = std::move(order);
  return built;
}

Workshop::Workshop(Out out) : out_(std::move(out)), thread_([this] { work(); }) {}

Workshop::~Workshop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Workshop::order(Order order) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(order);
  }
  wake_.notify_all();
}

void Workshop::work() {
  pthread_setname_np(pthread_self(), "lab workshop");
  for (;;) {
    Order order;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || next_; });
      if (stop_) return;
      order = std::move(*next_);
      next_.reset();
    }
    const Order asked = order;
    try {
      out_.built(build(std::move(order)));
    } catch (const InputError& error) {
      if (asked.done) asked.done(words_of(error));
      out_.failed(asked, words_of(error));
    } catch (const std::exception& error) {
      if (asked.done) asked.done(error.what());
      out_.failed(asked, error.what());
    }
  }
}

}  // namespace twinarm
