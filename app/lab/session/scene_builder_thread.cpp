
#include <pthread.h>

#include "app/lab/session/lab_command.h"
#include "collision/sandbox/sandboxed_process.h"

namespace twinarm {
namespace {

std::shared_ptr<const LabScene> open_scene(const BuildRequest& request) {
  FileRoots roots;
  if (request.is_shared) roots = {find_assets()};
  if (request.file.extension() == ".twinrec")
    return std::make_shared<const LabScene>(Recording(request.file).header(), roots);
  SimulateOptions options;
  options.robot.model = request.file;
  options.robot.roots = request.roots;
  if (request.file.extension() == ".toml") return std::make_shared<const LabScene>(options, roots);
  options.robot.model.replace_filename(request.file.stem().string() + "_lab.toml");
  options.scene = scene_of_robot(request.file, true);
  try {
    return std::make_shared<const LabScene>(options, roots);
  } catch (const InputError&) {  // perhaps of its meshes
    options.scene = scene_of_robot(request.file, false);
    return std::make_shared<const LabScene>(options, roots);
  }
}

void serialize(StateArchive& archive, BuildRequest& upload) {
  std::string file = upload.file.string();
  bool has_roots = upload.roots.has_value();
  std::vector<std::string> roots;
  if (has_roots) roots.assign(upload.roots->begin(), upload.roots->end());
  archive.visit(file, upload.is_shared, has_roots, roots);
  if (!archive.reads()) return;
  upload.file = file;
  if (has_roots) upload.roots.emplace(roots.begin(), roots.end());
}

std::string try_to_open(const std::string& packed) {
  StateArchive archive(packed);
  BuildRequest request;
  serialize(archive, request);
  try {
    open_scene(request);
  } catch (const InputError&) {  // reported by the reading that follows
  }
  return "";
}

// Refuses a file that crashes its reader, or takes more than the limits of time and memory.
void try_in_child(BuildRequest& request) {
  StateArchive packed;
  serialize(packed, request);
  const ChildResult tried =
      run_limited(try_to_open, packed.bytes(), {.cpu_seconds = 10, .wall_seconds = 30});
  if (!tried.fault.empty())
    throw InputError({{request.file.filename().string(), 0, "", "reading it " + tried.fault,
                       "give a smaller file, or repair it", "lab.unreadable"}});
}

}  // namespace

BuildRequest order_to_open(const GalleryScene& scene) {
  BuildRequest request;
  request.file = scene.file;
  request.name = scene.name;
  request.words = {
      scene.title, scene.file.filename().string(), {scene.look.begin(), scene.look.end()}};
  request.variants = scene.variants;
  return request;
}

BuildResult build(BuildRequest request) {
  BuildResult built;
  for (const PendingChange& pending : request.pending) {
    if (pending.discards_earlier) request.changes.clear();
    for (const Change& change : pending.changes) put(request.changes, change);
  }
  if (!request.variants.empty()) put(request.changes, request.variants.change(0));
  if (request.is_uploaded) try_in_child(request);
  built.scene = request.scene ? request.scene : open_scene(request);
  if (request.edit) {
    built.scene = built.scene->edited(request.changes, *request.edit);
    request.changes.clear();
  }
  built.header = built.scene->header(request.changes, {});
  built.run = built.scene->plan(request.changes);
  built.view = built.scene->plan(request.changes);
  built.parameters = built.scene->plan(request.changes);
  for (std::size_t variant = 1; variant < request.variants.values.size(); ++variant) {
    std::vector<Change> changes = request.changes;
    put(changes, request.variants.change(variant));
    built.variants.push_back(built.scene->plan(changes));
    built.variant_views.push_back(built.scene->plan(changes));
  }
  built.request = std::move(request);
  return built;
}

SceneBuilderThread::SceneBuilderThread(Inbox& inbox)
    : inbox_(inbox), thread_([this](const std::stop_token& stop) { work(stop); }) {}

std::optional<BuildRequest> SceneBuilderThread::submit(BuildRequest request) {
  std::optional<BuildRequest> replaced;
  {
    const std::lock_guard lock(mutex_);
    replaced = std::exchange(next_, std::move(request));
  }
  wake_.notify_all();
  return replaced;
}

// One invalid change of several must not prevent the others. Nothing if all are invalid.
std::optional<BuildResult> SceneBuilderThread::build_one_by_one(const BuildRequest& request) {
  std::optional<BuildResult> built;
  BuildRequest good = request;
  good.pending.clear();
  for (const PendingChange& pending : request.pending) {
    BuildRequest with = good;
    with.pending.push_back(pending);
    try {
      built = build(with);
      good = std::move(with);
    } catch (const InputError& error) {
      refused_.push_back(pending.number);
      if (&pending == &request.pending.back() && request.what == BuildRequest::What::branch &&
          built)
        built->request.what = BuildRequest::What::change;  // the refused one requested the branch
      inbox_.note("error", error.what());
    }
  }
  if (built) built->request.pending = request.pending;  // all of them are finished
  return built;
}

void SceneBuilderThread::work(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "lab builder");
  for (;;) try {
      BuildRequest request;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, stop, [this] { return next_.has_value(); });
        if (stop.stop_requested()) return;
        request = std::move(*next_);
        next_.reset();
      }
      // Without pending changes that were refused with an earlier request.
      std::erase_if(request.pending, [this](const PendingChange& pending) {
        return std::ranges::find(refused_, pending.number) != refused_.end();
      });
      try {
        try {
          inbox_.push(build(request));
        } catch (const InputError& error) {
          if (request.pending.size() < 2) throw;
          auto built = build_one_by_one(request);
          built ? inbox_.push(std::move(*built))
                : inbox_.push_refused(request.pending.back().number);
        }
      } catch (const std::exception& error) {
        for (const PendingChange& pending : request.pending) refused_.push_back(pending.number);
        inbox_.note("error", error.what());
        if (!request.pending.empty()) inbox_.push_refused(request.pending.back().number);
        if (request.done) request.done(error.what());
      }
    } catch (const std::exception& error) {  // of `done`
      inbox_.note("error", error.what());
    }
}

}  // namespace twinarm
