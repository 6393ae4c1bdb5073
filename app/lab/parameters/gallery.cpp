#include "app/lab/parameters/gallery.h"

namespace twinarm {
namespace {

// variants = { path = "integrator", values = ["verlet", "rk4"], apart = [0, 0.5, 0] }
VariantSet read_variants(TableReader& entry, const Value& value_of_key, const std::string& file,
                         DiagnosticList& faults) {
  TableReader table(value_of_key, entry.where() + ", variants", file, faults);
  VariantSet variants;
  variants.path = table.text("path").value_or("");
  variants.apart = table.vector("apart");
  if (const Value* values = table.find("values"))
    for (const Value& value : values->items)
      variants.values.push_back(value.kind == Value::Kind::number ? fmt::format("{}", value.number)
                                                                  : value.text);
  table.done();
  if (const auto found = problem_of(variants))
    entry.fault("variants", found->problem, found->fix, "gallery.variants");
  return variants;
}

GalleryScene read_entry(TableReader& table, const std::filesystem::path& folder,
                        const std::string& file, DiagnosticList& faults) {
  GalleryScene scene;
  for (const char* key : {"name", "file", "title", "look"})
    table.missing(key, "give name, file, title and three lines of look");
  scene.name = table.text("name").value_or("");
  scene.title = table.text("title").value_or("");
  scene.file = (folder.parent_path() / table.text("file").value_or("")).lexically_normal();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(scene.file, ignored))
    table.fault("file", "the file '" + scene.file.string() + "' does not exist",
                "name a scene of the folder above", "file.missing");
  scene.picture = folder / (scene.name + ".png");
  if (!std::filesystem::is_regular_file(scene.picture, ignored)) scene.picture.clear();
  const Value* look = table.find("look");
  const bool fits = look && look->items.size() == scene.look.size() &&
                    std::ranges::all_of(look->items, [](const Value& line) {
                      return line.kind == Value::Kind::text && !line.text.empty();
                    });
  if (!fits)
    table.fault("look", "is not a list of three texts", "give what to look for, in three lines",
                "gallery.look");
  else
    for (std::size_t i = 0; i < scene.look.size(); ++i) scene.look[i] = look->items[i].text;
  if (const Value* variants = table.table("variants"))
    scene.variants = read_variants(table, *variants, file, faults);
  table.done();
  return scene;
}

}  // namespace

std::vector<GalleryScene> read_gallery(const std::filesystem::path& file) {
  const Value root = read_toml(file);
  const std::string name = file.string();
  DiagnosticList faults;
  TableReader top(root, "gallery", name, faults);
  std::vector<GalleryScene> gallery;
  for (const Value* entry : top.tables("scene")) {
    TableReader table(*entry, "scene", name, faults);
    gallery.push_back(read_entry(table, file.parent_path(), name, faults));
    if (std::ranges::count(gallery, gallery.back().name, &GalleryScene::name) > 1)
      table.fault("name", "the name is used twice", "give each scene its own name",
                  "gallery.name-taken");
  }
  top.done();
  if (gallery.empty()) top.fault("scene", "there is no scene", "write [[scene]]", "gallery.empty");
  faults.check();
  return gallery;
}

std::vector<GalleryScene> read_gallery() {
  return read_gallery(std::filesystem::absolute(find_assets()) / "scenes" / "gallery" /
                      "gallery.toml");
}

// A test compares gains, step and masses of these scenes with those of `twinarm study`.
const std::vector<Preset>& all_presets() {
  static const std::vector<Preset> presets{
      {"E1", "the paper's E1: torsional coupling, moved by hand", "study_e1.toml", {}, "drag"},
      {"E2", "the paper's E2: linear coupling, moved by hand", "study_e2.toml", {}, "drag"},
      {"E3", "the paper's E3: torsional coupling, automatic motion", "study_e3.toml", {}, "scene"},
      {"E4", "the paper's E4: linear coupling, automatic motion", "study_e4.toml", {}, "scene"}};
  return presets;
}

}  // namespace twinarm
