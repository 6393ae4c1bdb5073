#include "app/lab/run/variants.h"

namespace twinarm {
namespace {

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  for (const char c : text) {
    if (c == '[') ++depth;
    if (c == ']') --depth;
    if (c == ',' && depth == 0)
      values.emplace_back();
    else
      values.back() += c;
  }
  return values;
}

}  // namespace

LabVariants::LabVariants(const VariantSet& set, std::vector<std::unique_ptr<LabScene::Plan>> plans,
                         const LabFrame* from, const LabNames& names) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    Variant variant;
    variant.name = set.values[i + 1];
    const VariantFrame start = from ? from->variants[i] : VariantFrame{};
    if (start.stopped) {
      variant.last = start.frame;
      variant.stopped = true;
    } else {
      variant.unused = std::make_unique<OperatorInput>();
      variant.run =
          std::make_unique<LabRun>(std::move(plans[i]), *variant.unused, start.frame.get());
      if (from) variant.run->carry_over_energy(*start.frame, names);
    }
    variants_.push_back(std::move(variant));
  }
}

void LabVariants::follow(const LabRun& run) {
  for (Variant& variant : variants_) {
    if (variant.stopped) continue;
    const double h = variant.run->prepared().run.step;
    while (variant.run->view().time() + 0.5 * h < run.view().time()) {
      if (variant.run->step(&run.input())) continue;
      stop(variant);
      break;
    }
  }
}

void LabVariants::stop(Variant& variant) {
  variant.stopped = true;
  const PostMortem* found = variant.run->post_mortem();
  const std::string why = found ? found->reason : "";
  warnings_.push_back(fmt::format("variant {} stopped at {:.4g} s{}{}; the others continue",
                                  variant.name, variant.run->view().time(), why.empty() ? "" : ": ",
                                  why));
}

void LabVariants::add_to(LabFrame& frame, LabNames& names) {
  frame.variants.clear();
  for (Variant& variant : variants_) {
    if (variant.run) variant.last = std::make_shared<const LabFrame>(variant.run->frame(names));
    if (variant.stopped) variant.run.reset();
    frame.variants.push_back({variant.last, variant.stopped});
  }
}

VariantSet parse_variants(const std::string& text) {
  const std::size_t equals = text.find('=');
  VariantSet variants;
  variants.path = text.substr(0, equals);
  if (equals != std::string::npos) variants.values = split_values(text.substr(equals + 1));
  if (const auto found = problem_of(variants))
    throw InputError("--variants " + text, found->problem, found->fix, "option.variants");
  return variants;
}

std::optional<VariantProblem> problem_of(const VariantSet& variants) {
  const std::vector<std::string>& values = variants.values;
  const auto is_empty = [](const std::string& value) { return value.empty(); };
  if (variants.path.empty() || values.empty() || std::ranges::any_of(values, is_empty))
    return VariantProblem{"a path or a value is missing", "write integrator=semi-implicit,rk4"};
  if (values.size() < 2 || values.size() > VariantSet::kMax)
    return VariantProblem{std::to_string(values.size()) + " values; 2 to 7 variants are possible",
                          "give 2 to 7 values"};
  for (auto value = values.begin(); value != values.end(); ++value)
    if (std::find(values.begin(), value, *value) != value)
      return VariantProblem{"'" + *value + "' is given twice", "give each value once"};
  return std::nullopt;
}

void put(std::vector<Change>& changes, const Change& change) {
  std::erase_if(changes, [&](const Change& other) { return other.path == change.path; });
  changes.push_back(change);
}

}  // namespace twinarm
