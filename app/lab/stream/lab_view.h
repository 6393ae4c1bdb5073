// Encodes frames of the run as in docs/reference/lab_protocol.md. Made once for a scene, used by
// one thread. It needs its own plan (LabScene::plan(): a run changes the state in its plan) and has
// its own couplings.
//
// Meshes, channels, rows of the energy balance and legends may be added during a run, always at the
// end: a frame can be read with an older `scene` message, and revision() tells when a newer one is
// needed.
//
// The view shows the start and the reach of the robots. Scales of arrows begin at weights and grow
// in round steps (1, 2, 5), at most one step per frame, so that a few frames of a diverging run do
// not make all later arrows small.
//
// Cost of a frame: kinematics, the requested overlays, and one copy (measured: app/lab/README.md).
// States that are not finite give no instances and no labels, and no exception.
#pragma once

#include "app/lab/session/scene_builder_thread.h"
#include "app/lab/stream/frame_bytes.h"

namespace twinarm {

// View of a run whose end is unknown: extent by the robots' reach, and scales that grow.

// Extends the view by what is at the start; by the robots at 64 joint positions (Halton sequence
// within the limits, one revolution where there are none), of robots with constraints only the
// first links; and by one revolution of the bodies that are hinged to the world. For a robot on the
// ground points below count as on the ground.
void extend_by_reach(SceneView& stage, const RobotInput& robots, const Snapshot& start);
// Camera, ground, first scales, and the input device's place, which is in view if `has_device`.
void set_live_view(SceneView& stage, const Snapshot& start, bool has_device);

// Scales for the snapshot; each grows at most one round step (1, 2, 5).
void grow_scales(SceneView& stage, const Snapshot& snapshot);

// Adds the bodies' centres of mass to the trails: the last 10 s are drawn, ten minutes are stored.
// Removes points later than the snapshot.
void extend_trails(SceneView& stage, const Snapshot& snapshot);

// Names for the numbers in frames, for the message `scene` (docs/reference/lab_protocol.md).

// Meshes and textures of a draw list as files, named by the hash of their content.
class MeshStore {
 public:
  // Adds those that are new in the list. True: there were some.
  bool take(const DrawList& list);
  // Names by number in the list.
  const std::vector<std::string>& meshes() const { return mesh_names_; }
  const std::vector<std::string>& textures() const { return texture_names_; }
  // By name, as GET /mesh/HASH and /texture/HASH answer; null: unknown.
  std::shared_ptr<const std::string> file(const std::string& name) const;

 private:
  std::string keep(std::string bytes);

  std::vector<std::string> mesh_names_, texture_names_;
  std::map<std::string, std::shared_ptr<const std::string>> files_;
};

// Of all layers, in the order of their numbers in frames.
const std::vector<std::string>& layer_names();

// Of a frame, known by the session.
struct FrameFacts {
  std::uint32_t number = 0;  // counts up
  // looked_back: an earlier instant is shown; stopped: the run has diverged
  bool paused = false, looked_back = false, stopped = false;
  double input_age = 0;  // since the arrival of the newest input [s]
  bool operator==(const FrameFacts&) const = default;
};

class LabView {
 public:
  // `number`: of the scene, in its message and in all frames. `header`: of a recording of the run.
  // Throws InputError: a mesh that cannot be read.
  LabView(std::uint32_t number, std::shared_ptr<const SimulatePlan> plan,
          const RecordingHeader& header, SceneWords words, ViewVariants variants = {});

  // The same bodies, couplings and variants with other values. Throws InputError.
  void change(std::shared_ptr<const SimulatePlan> plan,
              std::vector<std::shared_ptr<const SimulatePlan>> variants = {});
  // Names of the rows of the energy balance, by the numbers in frames.
  void name_rows(const std::vector<std::string>& rows);

  // They increase when scene_message() has new content: what frames refer to; names of numbers,
  // which clients ignore in frames until they know them.
  std::uint64_t revision() const { return revision_; }
  std::uint64_t naming() const { return naming_; }
  std::string scene_message() const;
  const MeshStore& store() const { return store_; }

  // `layers`: names of the requested ones; all others are empty, unknown names are ignored.
  // `before`: frame of the run that the branch left, at the same time; may be null.
  std::string frame(const LabFrame& now, const LabFrame* before,
                    const std::vector<std::string>& layers, const FrameFacts& facts);
  const DrawList& drawn() const { return stage_.list; }             // of the last frame
  std::string history(const std::vector<const LabFrame*>& frames);  // in the order of time

 private:
  void draw_layers(const Snapshot& snapshot, const std::vector<std::string>& wanted);
  void take_legend(std::size_t layer, const Drawn& from, std::size_t end);
  void take_values(const LabFrame& frame, const Snapshot& snapshot);
  void take_poses(const Snapshot& snapshot);

  std::shared_ptr<const SimulatePlan> plan_;
  SceneWords words_;
  LabSnapshots snapshots_;
  SceneView stage_;
  LabChannels channels_;
  VariantViews variants_;
  MeshStore store_;
  std::vector<std::string> rows_;
  std::vector<std::vector<LegendLine>> legends_;  // by layer
  FrameColumns columns_;
  std::uint64_t revision_ = 1, naming_ = 1;
};

}  // namespace twinarm
