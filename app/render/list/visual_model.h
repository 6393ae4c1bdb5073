// A file of meshes as it is to be drawn: parts with colours and textures, normals mended.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/render/list/draw_list.h"

namespace twinarm {

struct VisualMesh {
  DrawMesh mesh;                         // [m]
  std::optional<Color> color;            // where the file states one
  std::shared_ptr<const Image> texture;  // or none
};
struct VisualModel {
  std::vector<VisualMesh> parts;
  std::vector<std::string> notes;  // what was mended or left out, for the user to know
};

// Of parts without a texture of their own, whether they are to know where one would lie.
enum class KeepPlaces { where_textured, always };

// Throws InputError as read_model() (collision/mesh_files/model_file.h) does. `scale` takes the
// file's numbers to metres; an odd number of negative ones mirrors it. Triangles that disagree on
// their outside are turned; a part that is not closed is drawn from both sides. A texture that is
// no picture is left out and noted.
VisualModel load_visual(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones(),
                        KeepPlaces keep = KeepPlaces::where_textured);

struct MendedWinding {
  std::vector<bool> turned;  // by triangle: its second and third corner were swapped
  bool is_closed = false;    // every edge belongs to two triangles, whose sides now agree
};

// Of a welded mesh, where triangles may disagree on which side is outside. Neighbours are made to
// agree across every edge that two triangles share, each connected surface as most of its area
// stood before; one that is closed has its outside outside (its volume is positive). O(n log n).
MendedWinding mend_winding(TriangleMesh& mesh);

}  // namespace twinarm
