// A mesh file prepared for drawing: parts with colours and textures, consistent winding.
#pragma once

#include "app/render/list/draw_list.h"

namespace twinarm {

struct VisualMesh {
  DrawMesh mesh;                         // [m]
  std::optional<Color> color;            // from the file
  std::shared_ptr<const Image> texture;  // or null
};
struct VisualModel {
  std::vector<VisualMesh> parts;
  std::vector<std::string> notes;  // repairs and omissions, for the user
};

// Whether parts without texture keep their texture coordinates.
enum class KeepPlaces { where_textured, always };

// Throws InputError like read_model() (collision/mesh_files/model_file.h). `scale`: file units to
// metres; an odd number of negative factors mirrors the mesh. Inconsistent triangles are flipped;
// open parts are two-sided. Textures that cannot be decoded are omitted with a note.
VisualModel load_visual(const std::filesystem::path& file, const Vector3& scale = Vector3::Ones(),
                        KeepPlaces keep = KeepPlaces::where_textured);

struct ConsistentWinding {
  std::vector<bool> flipped;  // by triangle: its second and third corner were swapped
  bool is_closed = false;     // every edge belongs to two triangles of consistent winding
};

// Makes the winding of a welded mesh consistent across edges of two triangles: outward (positive
// volume) for closed surfaces, else as for most of the area. O(n log n).
ConsistentWinding make_winding_consistent(TriangleMesh& mesh);

}  // namespace twinarm
