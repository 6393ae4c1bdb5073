// Where scenes are read and built: a thread of its own, so that neither the run nor the pictures
// stand still meanwhile. Of orders that wait, only the newest is done.
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

// Title, file and hints of a scene, for the lab's page.

// What the scene's message says besides.
struct SceneWords {
  std::string title, file;        // title empty: the file's name in words
  std::vector<std::string> look;  // what to look for
};

// What was asked for at once, and is refused at once or not at all.
struct Asked {
  long number = 0;           // counts up
  bool begins_anew = false;  // without the changes before it
  std::vector<Change> changes;
};

// What is to be built, and what the run is to do with it.
struct BuildRequest {
  enum class What { open, change, branch, reset };
  What what = What::open;
  std::filesystem::path file;  // open: a scene, a robot, a recording
  FileRoots roots;             // open: of the files that this one names
  // Pages on other machines may change it: changes name only its own files, and the assets.
  bool is_shared = false;
  std::string name;                       // open: as the gallery has it
  SceneWords words;                       // open
  std::shared_ptr<const LabScene> scene;  // of all others
  std::vector<Change> changes;            // all that are to stand then, but
  std::vector<Asked> asked;               // these, which nobody has tried yet, oldest first
  VariantSet lanes;                       // empty: the run alone
  double at = 0;                          // branch [s]
  std::string hand;                       // open: who moves the robot then; empty: as it is
  // Called when it is built, with nothing, or with all faults, line by line.
  std::function<void(const std::string& faults)> done;
};

// A scene with its changes, in `order.changes` also what was asked for and held, and those of its
// first lane: each thread has a plan of its own.
struct BuildResult {
  BuildRequest order;
  std::shared_ptr<const LabScene> scene;
  RecordingHeader header;
  std::unique_ptr<LabScene::Plan> run;
  std::shared_ptr<LabScene::Plan> view, knobs;
  std::vector<std::unique_ptr<LabScene::Plan>> lanes;  // of the run, from the second lane on
  std::vector<std::shared_ptr<LabScene::Plan>> lane_views;
};

class Inbox;

class SceneBuilderThread {
 public:
  // What is built goes to the inbox, and so does what is refused, with its faults, line by line.
  explicit SceneBuilderThread(Inbox& inbox);
  ~SceneBuilderThread();
  // From any thread. Takes the place of one that has not been begun, which is returned.
  [[nodiscard]] std::optional<BuildRequest> order(BuildRequest order);

 private:
  void work();
  void leave_out_refused(BuildRequest& order) const;
  std::optional<BuildResult> build_one_by_one(const BuildRequest& order);
  void fail(const BuildRequest& order);

  Inbox& inbox_;
  std::vector<long> refused_;  // numbers of what was asked for; of the workshop's thread alone
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<BuildRequest> next_;
  bool stop_ = false;
  std::thread thread_;
};

BuildRequest order_to_open(const GalleryScene& scene);
// In the caller's thread. Throws InputError.
BuildResult build(BuildRequest order);

}  // namespace twinarm
