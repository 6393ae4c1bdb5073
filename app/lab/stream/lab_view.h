// What pages see of a lab's run: frames to the bytes of docs/reference/lab_protocol.md.
//
// Made once for a scene. Used by one thread, the painter; with the run it shares nothing that
// changes: it has couplings of its own, and leads their kinematic side by what a frame says.
// The plan is to be one of its own, of LabScene::plan(): a run changes the state in its plan.
//
// Meshes, channels, rows of the ledger and legends may come up during a run. They are only ever
// added at the end, so a frame can be read with an older `scene` message; revision() says when a
// newer one is to be sent.
//
// There is no whole run to look ahead at. The view is of the start and of what robots can reach.
// Scales of arrows begin at weights and only grow, in round steps (1, 2, 5), by one step a frame at
// most: a run that explodes for two frames does not make all that comes after it small.
//
// Cost of a frame: kinematics, the overlays that are asked for, and one copy of it all (measured:
// app/lab/README.md). Not finite states make no instances and no labels; nothing throws for them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/session/scene_builder_thread.h"
#include "app/lab/stream/frame_bytes.h"
#include "app/run/simulate_input.h"

namespace twinarm {

class DrawList;

// What the session knows of a frame that the frame does not say.
struct FrameFacts {
  std::uint32_t number = 0;  // counts up
  bool stands = false, looked_back = false, stopped = false;
  double input_age = 0;  // from when its newest input came until now [s]
};

class LabView {
 public:
  // `number`: of the scene, in its message and in all frames. `header`: of a recording of the run
  // (header_of()). Of the plan only what no run changes is read. Throws InputError: a mesh of a
  // body that cannot be read.
  LabView(std::uint32_t number, std::shared_ptr<const SimulatePlan> plan,
          const RecordingHeader& header, SceneWords words, ViewVariants lanes = {});
  ~LabView();

  // The same bodies, couplings and lanes with other numbers. Throws InputError.
  void change(std::shared_ptr<const SimulatePlan> plan,
              std::vector<std::shared_ptr<const SimulatePlan>> lanes = {});
  // Names of the ledger's rows, by the numbers that frames have for them; as many as there are yet.
  void name_rows(const std::vector<std::string>& rows);

  // Counts up when scene_message() has more to say than it had.
  std::uint64_t revision() const;
  std::string scene_message() const;
  // By the names in the message, as GET /mesh/HASH and /texture/HASH answer; null: there is none.
  std::shared_ptr<const std::string> mesh(const std::string& hash) const;
  std::shared_ptr<const std::string> texture(const std::string& hash) const;

  // `layers`: names of those that anybody wants; all others are empty, those of other names
  // ignored. `before`: of the branch that was left, at the same time; may be null.
  std::string frame(const LabFrame& now, const LabFrame* before,
                    const std::vector<std::string>& layers, const FrameFacts& facts);
  // What was drawn for the last frame: for the program's own painter.
  const DrawList& drawn() const;
  // In the order of time.
  std::string history(const std::vector<const LabFrame*>& frames);

  const std::vector<std::string>& notes() const;  // what stands in for something else

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
