#include "app/lab/session/scene_builder_thread.h"

#include <pthread.h>

#include <algorithm>
#include <utility>

#include "app/lab/session/lab_command.h"
#include "app/record/recording_reader.h"
#include "app/support/files.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

std::shared_ptr<const LabScene> open_scene(const BuildRequest& order) {
  FileRoots roots;
  if (order.is_shared) roots = {find_assets()};
  if (order.file.extension() == ".twinrec")
    return std::make_shared<const LabScene>(Recording(order.file).header(), roots);
  SimulateOptions options;
  options.robot.model = order.file;
  options.robot.roots = order.roots;
  return std::make_shared<const LabScene>(options, roots);
}

std::string words_of(const InputError& error) {
  std::string words;
  for (const Diagnostic& fault : error.faults())
    words += (words.empty() ? "" : "\n") + to_string(fault);
  return words;
}

void put_asked(std::vector<Change>& changes, const Asked& asked) {
  if (asked.begins_anew) changes.clear();
  for (const Change& change : asked.changes) put(changes, change);
}

}  // namespace

BuildRequest order_to_open(const GalleryScene& scene) {
  BuildRequest order;
  order.file = scene.file;
  order.name = scene.name;
  order.words.title = scene.title;
  order.words.file = scene.file.filename().string();
  order.words.look.assign(scene.look.begin(), scene.look.end());
  order.lanes = scene.lanes;
  return order;
}

BuildResult build(BuildRequest order) {
  BuildResult built;
  for (const Asked& asked : order.asked) put_asked(order.changes, asked);
  if (!order.lanes.empty()) put(order.changes, order.lanes.change(0));
  built.scene = order.what == BuildRequest::What::open ? open_scene(order) : order.scene;
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

SceneBuilderThread::SceneBuilderThread(Inbox& inbox) : inbox_(inbox), thread_([this] { work(); }) {}

SceneBuilderThread::~SceneBuilderThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

std::optional<BuildRequest> SceneBuilderThread::order(BuildRequest order) {
  std::optional<BuildRequest> left;
  {
    const std::lock_guard lock(mutex_);
    left = std::exchange(next_, std::move(order));
  }
  wake_.notify_all();
  return left;
}

// It was tried already, with an order before this one.
void SceneBuilderThread::leave_out_refused(BuildRequest& order) const {
  std::erase_if(order.asked, [this](const Asked& asked) {
    return std::ranges::find(refused_, asked.number) != refused_.end();
  });
}

// What was asked for while others waited: what is wrong must not take the others with it. Nothing
// where no part of it holds.
std::optional<BuildResult> SceneBuilderThread::build_one_by_one(const BuildRequest& order) {
  std::optional<BuildResult> built;
  BuildRequest good = order;
  good.asked.clear();
  for (const Asked& asked : order.asked) {
    BuildRequest with = good;
    with.asked.push_back(asked);
    try {
      built = build(with);
      good = std::move(with);
    } catch (const InputError& error) {
      refused_.push_back(asked.number);
      if (&asked == &order.asked.back() && order.what == BuildRequest::What::branch && built)
        built->order.what = BuildRequest::What::change;  // the branch was for what is refused
      inbox_.note("error", words_of(error));
    }
  }
  if (built) built->order.asked = order.asked;  // all of it is done with
  return built;
}

// Nothing of it holds; why was told.
void SceneBuilderThread::fail(const BuildRequest& order) {
  if (!order.asked.empty()) inbox_.push_refused(order.asked.back().number);
}

void SceneBuilderThread::work() {
  pthread_setname_np(pthread_self(), "lab workshop");
  for (;;) {
    BuildRequest order;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stop_ || next_; });
      if (stop_) return;
      order = std::move(*next_);
      next_.reset();
    }
    leave_out_refused(order);
    try {
      try {
        inbox_.push(build(order));
      } catch (const InputError& error) {
        if (order.asked.size() < 2) throw;
        auto built = build_one_by_one(order);
        built ? inbox_.push(std::move(*built)) : fail(order);
      }
    } catch (const std::exception& error) {
      const auto* faults = dynamic_cast<const InputError*>(&error);
      const std::string why = faults ? words_of(*faults) : error.what();
      for (const Asked& asked : order.asked) refused_.push_back(asked.number);
      if (order.done) order.done(why);
      inbox_.note("error", why);
      fail(order);
    }
  }
}

}  // namespace twinarm
