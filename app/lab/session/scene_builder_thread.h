// Reads and builds scenes in its own thread, while run and messages go on. Of waiting requests only
// the newest is built.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/run/lab_scene.h"
#include "app/lab/run/variants.h"

namespace twinarm {

struct SceneWords {
  std::string title, file;        // title empty: made from the file's name
  std::vector<std::string> look;  // what to look for
};

// Changes that were requested together, and are accepted or refused together.
struct PendingChange {
  long number = 0;                // counts up
  bool discards_earlier = false;  // all changes before it
  std::vector<Change> changes;
};

struct BuildRequest {
  enum class What { open, change, branch, reset };
  What what = What::open;
  std::filesystem::path file;  // open: a scene, a robot, a recording
  FileRoots roots;             // open: folders of the files that this one may name
  // Pages on other machines may change it: changes name only its own files, and the assets.
  bool is_shared = false;
  bool is_uploaded = false;               // open: by a page
  std::string name;                       // open: as in the gallery
  SceneWords words;                       // open
  std::shared_ptr<const LabScene> scene;  // of all others, and of an edit
  std::optional<SceneEdit> edit;          // open: of the scene with its changes
  std::vector<Change> changes;            // in effect, accepted before
  std::vector<PendingChange> pending;     // not tried yet, oldest first
  VariantSet variants;                    // empty: the run alone
  double at = 0;                          // branch [s]
  std::string hand;                       // open: input source to choose; empty: as it is
  // Called when it is built, with "", or with all faults, one per line.
  std::function<void(const std::string& faults)> done;
};

// A built scene. `request.changes` then also has the accepted pending ones and the first variant's.
// Each thread has its own plan.
struct BuildResult {
  BuildRequest request;
  std::shared_ptr<const LabScene> scene;
  RecordingHeader header;
  std::unique_ptr<LabScene::Plan> run;
  std::shared_ptr<LabScene::Plan> view, parameters;
  std::vector<std::unique_ptr<LabScene::Plan>> variants;  // of the run, from the second on
  std::vector<std::shared_ptr<LabScene::Plan>> variant_views;
};

class Inbox;

class SceneBuilderThread {
 public:
  // Results go to the inbox, and faults as notes, one per line.
  explicit SceneBuilderThread(Inbox& inbox);
  // From any thread. Replaces a waiting request and returns it.
  [[nodiscard]] std::optional<BuildRequest> submit(BuildRequest request);

 private:
  void work(const std::stop_token& stop);
  std::optional<BuildResult> build_one_by_one(const BuildRequest& request);

  Inbox& inbox_;
  std::vector<long> refused_;  // numbers of pending changes; used by this thread only
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::optional<BuildRequest> next_;
  std::jthread thread_;
};

BuildRequest order_to_open(const GalleryScene& scene);
// In the caller's thread. Throws InputError.
BuildResult build(BuildRequest request);

}  // namespace twinarm
