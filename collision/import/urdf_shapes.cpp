// The shapes of a URDF link.
//
// A mesh file is sought relative to the folder of the URDF. Of `package://name/rest` we know no
// package path; the package is the folder called `name` above or beside the URDF, or else the
// URDF's own folder is taken for it.
#include "collision/import/urdf_shapes.h"

#include <tinyxml2.h>

namespace twinarm {

using tinyxml2::XMLElement;
namespace fs = std::filesystem;

namespace {

// The places where a file of a package may lie, the likeliest first.
std::vector<fs::path> package_places(const std::string& package_and_path, const fs::path& folder) {
  const fs::path whole(package_and_path);
  const fs::path rest = whole.lexically_relative(*whole.begin());
  std::vector<fs::path> places;
  for (fs::path up = folder;; up = up.parent_path()) {
    if (up.filename() == *whole.begin()) places.push_back(up / rest);
    places.push_back(up / whole);
    if (up == up.parent_path()) break;
  }
  places.push_back(folder / rest);
  return places;
}

fs::path find_mesh(const XMLElement& element, const std::string& where, UrdfSource& source) {
  const std::string name = source.text(element, "filename", where);
  if (name.empty()) return {};
  std::vector<fs::path> places;
  const std::size_t scheme = name.find("://");
  if (scheme == std::string::npos) {
    places = {source.folder() / name};
  } else if (name.starts_with("file://")) {
    places = {source.folder() / name.substr(7)};  // an absolute path replaces the folder
  } else if ((name.starts_with("package://") || name.starts_with("model://")) &&
             name.size() > scheme + 3) {
    places = package_places(name.substr(scheme + 3), source.folder());
  } else {
    source.fault(element.GetLineNum(), where, "mesh '" + name + "' has a scheme that is not known",
                 "give a path relative to the URDF, or package://, or file://");
    return {};
  }
  std::error_code ignored;
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, ignored)) return place.lexically_normal();
  source.fault(element.GetLineNum(), where, "mesh file '" + name + "' does not exist",
               places.size() == 1
                   ? "expected at " + places[0].lexically_normal().string()
                   : "the package was sought above and beside " + source.folder().string() +
                         "; put it there, or give a path relative to the URDF");
  return {};
}

MeshGeometry read_mesh(const XMLElement& element, const std::string& where, UrdfSource& source) {
  MeshGeometry mesh;
  mesh.file = find_mesh(element, where, source);
  const Vector3 scale =
      source.vector3(element, "scale", where, Vector3(Vector3::Ones())).value_or(Vector3::Ones());
  if (!(scale.x() > 0) || scale.y() != scale.x() || scale.z() != scale.x())
    source.fault(element.GetLineNum(), where,
                 std::string("mesh scale is '") + element.Attribute("scale") +
                     "', must be one positive number three times",
                 "stretch or mirror the mesh in its own file");
  mesh.scale = scale.x();
  return mesh;
}

PartGeometry read_geometry(const XMLElement& part, const std::string& where, UrdfSource& source) {
  const XMLElement* geometry = part.FirstChildElement("geometry");
  const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
  const std::string kind = shape ? shape->Name() : "";
  const auto length = [&](const char* attribute) {
    return source.positive(*shape, attribute, where).value_or(1.0);
  };
  if (kind == "sphere") return SphereGeometry{length("radius")};
  if (kind == "cylinder") return CylinderGeometry{length("radius"), length("length")};
  if (kind == "capsule") return CapsuleGeometry{length("radius"), length("length")};
  if (kind == "mesh") return read_mesh(*shape, where, source);
  if (kind == "box") {
    const Vector3 size = source.vector3(*shape, "size", where).value_or(Vector3::Ones());
    if (!(size.minCoeff() > 0))
      source.fault(shape->GetLineNum(), where,
                   std::string("box size is '") + shape->Attribute("size") +
                       "', must be three positive numbers",
                   "give full edges in metres");
    return BoxGeometry{size};
  }
  source.fault((shape      ? shape
                : geometry ? geometry
                           : &part)
                   ->GetLineNum(),
               where, kind.empty() ? "it has no geometry" : "shape <" + kind + "> is not known",
               "shapes: box, sphere, cylinder, capsule, mesh");
  return {};
}

// The colour of a <material> element, if it states one.
std::optional<Vector4> read_color(const XMLElement& material, UrdfSource& source) {
  const XMLElement* color = material.FirstChildElement("color");
  if (!color) return std::nullopt;
  const char* name = material.Attribute("name");
  const auto rgba =
      source.numbers(*color, "rgba", std::string("material '") + (name ? name : "") + "'", 4);
  if (!rgba) return Vector4::Ones();
  for (const double part : *rgba)
    if (part < 0 || part > 1) {
      source.fault(color->GetLineNum(), std::string("material '") + (name ? name : "") + "'",
                   std::string("colour '") + color->Attribute("rgba") + "' lies outside [0, 1]",
                   "give red, green, blue and opacity from 0 to 1");
      break;
    }
  return Vector4((*rgba)[0], (*rgba)[1], (*rgba)[2], (*rgba)[3]);
}

void read_material(const XMLElement& visual, const std::string& where,
                   const MaterialColors& materials, VisualPart& part, UrdfSource& source) {
  const XMLElement* material = visual.FirstChildElement("material");
  if (!material) return;
  if (const char* name = material->Attribute("name")) part.material = name;
  const XMLElement* color = material->FirstChildElement("color");
  if (color) {  // its faults were told by read_materials
    UrdfSource silent(source.file());
    part.color = read_color(*material, silent).value_or(part.color);
  } else if (const auto known = materials.find(part.material); known != materials.end()) {
    part.color = known->second;
  } else if (!material->FirstChildElement("texture")) {  // textures are left out
    source.fault(material->GetLineNum(), where,
                 "material '" + part.material + "' is not defined in this file",
                 "define it with a <color> below <robot>");
  }
}

}  // namespace

MaterialColors read_materials(const XMLElement& robot, UrdfSource& source) {
  MaterialColors colors;
  const auto take = [&](const XMLElement& material) {
    const auto color = read_color(material, source);
    const char* name = material.Attribute("name");
    if (color && name) colors.emplace(name, *color);
  };
  for (auto* m = robot.FirstChildElement("material"); m; m = m->NextSiblingElement("material")) {
    source.text(*m, "name", "material");
    take(*m);
  }
  for (auto* l = robot.FirstChildElement("link"); l; l = l->NextSiblingElement("link"))
    for (auto* v = l->FirstChildElement("visual"); v; v = v->NextSiblingElement("visual"))
      if (auto* m = v->FirstChildElement("material")) take(*m);
  return colors;
}

void read_shapes(const XMLElement& link_element, const MaterialColors& materials,
                 LinkDescription& link, UrdfSource& source) {
  const auto read = [&](const XMLElement& element, auto& part) {
    if (const char* name = element.Attribute("name")) part.name = name;
    part.line = element.GetLineNum();
    const std::string where = "link '" + link.name + "', " + element.Name() +
                              (part.name.empty() ? "" : " '" + part.name + "'");
    part.origin = source.origin(element, where);
    part.geometry = read_geometry(element, where, source);
    return where;
  };
  for (auto* e = link_element.FirstChildElement("visual"); e; e = e->NextSiblingElement("visual")) {
    VisualPart& part = link.visuals.emplace_back();
    const std::string where = read(*e, part);
    read_material(*e, where, materials, part, source);
  }
  for (auto* e = link_element.FirstChildElement("collision"); e;
       e = e->NextSiblingElement("collision"))
    read(*e, link.collisions.emplace_back());
}

}  // namespace twinarm
