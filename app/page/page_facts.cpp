#include "app/page/pages.h"

#include "app/support/text.h"

namespace twinarm {
namespace {

using Row = std::vector<std::string>;

constexpr std::size_t kLongestFile = 200'000;  // bytes; meshes are in the picture

std::string shell_word(const std::string& word) {
  const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  return "'" + replace_all(word, "'", "'\\''") + "'";
}

void write_pairs(JsonWriter& json, const RecordingHeader& header, const FilmedRun& run,
                 double rate) {
  const auto fact = [&](const char* name, const std::string& value) {
    if (!value.empty()) json.texts({name, value});
  };
  const SceneModel* scene = run.plan.input.scene.get();
  const Vec3<double>& g = run.model().gravity;
  json.key("facts").begin_array();
  fact("model", std::filesystem::path(header.run.robot.model).filename().string());
  fact("integrator", header.integrator);
  fact("step", number_text(1e3 * header.step) + " ms");
  fact("duration", number_text(header.duration) + " s");
  fact("gravity", number_text(g.x) + ", " + number_text(g.y) + ", " + number_text(g.z) + " m/s²");
  if (scene)
    fact("contact", header.run.contact.empty()
                        ? kContactModes[static_cast<std::size_t>(scene->description.contact)]
                        : header.run.contact);
  if (scene && scene->description.detection == Detection::fcl) fact("detection", "fcl");
  fact("seed", std::to_string(header.seed));
  fact("twinarm", header.program);
  fact("recorded frames", std::to_string(run.recording->size()));
  fact("frames of this page", fmt::format("{}, {:.4g} a second", run.shown.size(), rate));
  fact("end of the run", run.recording->end());
  json.end_array();
}

void write_table(JsonWriter& json, const std::string& title, const Row& head,
                 const std::vector<Row>& rows) {
  if (rows.empty()) return;
  json.object({{"title", title}, {"head", head}, {"rows", rows}});
}

std::vector<Row> coupling_rows(const SceneModel& scene) {
  const char* targets[] = {"start", "state", "paper", "trace", "device", "synthetic hand"};
  std::vector<Row> rows;
  for (const SceneCoupling& c : scene.couplings) {
    const bool is_linear = c.type == CouplingDescription::Type::linear;
    rows.push_back({c.name,
                    c.soft_limits ? "soft limit"
                                  : facts_of(c.law, c.printed).name +
                                        std::string(is_linear ? ", at a point"
                                                    : c.measure == SpringSpace::joint ? ", joint"
                                                                                      : ", world"),
                    scene.model.body_name[static_cast<std::size_t>(c.spring.body)],
                    number_text(c.spring.k), number_text(c.spring.b), name_of(c.discretization),
                    c.rate > 0 ? number_text(c.rate) + " Hz" : "each step",
                    targets[static_cast<std::size_t>(c.target.kind)]});
  }
  return rows;
}

std::vector<Row> body_rows(const SceneModel& scene) {
  std::vector<Row> rows;
  for (const BodyDescription& body : scene.description.bodies) {
    const int index = scene.model.find_body(body.name);
    const bool is_free = body.is_free() && index > 0;
    rows.push_back({body.name, body.fixed ? "fixed" : (is_free ? "free" : "moved"),
                    is_free ? number_text(scene.model.I[static_cast<std::size_t>(index)].m) : "–",
                    number_text(body.surface.friction), number_text(body.surface.restitution)});
  }
  return rows;
}

std::vector<Row> link_rows(const Model<double>& model, std::size_t last) {
  std::vector<Row> rows;
  for (std::size_t i = 1; i <= last && i < model.parent.size(); ++i)
    rows.push_back({model.body_name[i], model.joint_name[i],
                    model.body_name[static_cast<std::size_t>(model.parent[i])],
                    number_text(model.I[i].m)});
  return rows;
}

void write_tables(JsonWriter& json, const FilmedRun& run) {
  const SceneModel* scene = run.plan.input.scene.get();
  const Model<double>& model = run.model();
  json.key("tables").begin_array();
  if (scene)
    write_table(json, "Couplings",
                {"name", "type", "link", "k [N/m, N m/rad]", "b [N s/m, N m s/rad]",
                 "discretization", "rate", "target"},
                coupling_rows(*scene));
  write_table(json, "Links", {"link", "joint", "parent", "mass [kg]"},
              link_rows(model, scene ? static_cast<std::size_t>(scene->robot_bodies)
                                     : model.parent.size()));
  if (scene)
    write_table(json, "Bodies", {"body", "kind", "mass [kg]", "friction", "restitution"},
                body_rows(*scene));
  json.end_array();
}

// Text files: scene, robots, state.
void write_files(JsonWriter& json, const RecordingHeader& header) {
  json.key("files").list(header.files, [&](const RecordedFile& file) {
    const std::filesystem::path path = file.path;
    const std::string end = path.extension().string();
    const bool is_text = end == ".toml" || end == ".urdf" || end == ".json" || end == ".csv";
    if (is_text && file.bytes.size() <= kLongestFile)
      json.object({{"name", path.filename().string()}, {"text", file.bytes}});
  });
}

}  // namespace

std::string command_line(const std::vector<std::string>& words) {
  std::string line;
  for (std::size_t i = 0; i < words.size(); ++i)
    line += i == 0 ? shell_word(std::filesystem::path(words[i]).filename().string())
                   : " " + shell_word(words[i]);
  return line;
}

void write_facts(JsonWriter& json, const FilmedRun& run, const SceneView& view, double rate) {
  const RecordingHeader& header = run.recording->header();
  json.members({{"title", std::filesystem::path(header.run.robot.model).stem().string()},
                {"command", command_line(header.command)}});
  write_pairs(json, header, run, rate);
  write_tables(json, run);
  write_files(json, header);
  std::vector<std::string> notes = run.recording->alarms();
  for (const auto* more : {&run.recording->notes(), &view.cast.notes})
    notes.insert(notes.end(), more->begin(), more->end());
  json.key("notes").texts(notes);
}

}  // namespace twinarm
