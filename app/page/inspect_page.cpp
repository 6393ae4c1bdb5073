#include "app/page/inspect_page.h"

#include "app/page/page_facts.h"
#include "app/page/page_form.h"
#include "app/page/page_layers.h"
#include "app/support/version.h"
#include "app/web/web_bundle.h"

namespace twinarm {

std::string inspect_page(const SimulateInput& input, const State<double>& x,
                         const std::string& inspection, const InspectedWords& words) {
  const WebBundle bundle = web_bundle();
  require_form(bundle.inspect, bundle.missing, "--json needs none");
  const SceneModel* scene = input.scene.get();
  const Model<double>& model = input.robot.model;
  Stage stage = scene ? make_stage(*scene) : make_stage(input.robot.robot, model);
  const Moment moment = scene ? moment_of(*scene, *input.couplings, x, {}) : moment_of(model, x);
  look_ahead(stage, moment);
  look_at(stage, moment);
  settle(stage);
  measure(stage, moment, Measured::of_picture);
  constexpr double kAspect = 1.0;  // of the view
  set_view(stage, {}, kAspect);
  PageLayers layers(stage);
  layers.add_frame(moment);
  layers.add_apart(moment);
  layers.show_at_first({"joints"});

  JsonWriter json;
  PageBytes bytes;
  json.begin_object();
  json.members({{"title", words.title},
                {"state", words.state},
                {"command", command_line(words.command)},
                {"version", kProgramVersion},
                {"inspection", inspection}});
  layers.write(json, bytes);
  write_view(json, stage);
  json.end_object();
  return fill_form(bundle.inspect, words.title, json, bytes);
}

}  // namespace twinarm
