#include "app/draw/scene_view.h"

#include "app/support/text.h"

namespace twinarm {
namespace {

const std::vector<std::string> kCameras{"auto", "front", "side", "top", "iso"};

Vector3 towards_eye(const CameraWish& wish) {
  const double a = wish.azimuth * kDegree, e = wish.elevation * kDegree;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

[[noreturn]] void refuse(const std::string& text, const std::string& problem,
                         const std::string& fix) {
  throw InputError("--camera", "'" + text + "' " + problem, fix, "option.form");
}

CameraWish parse_orbit(const std::string& text) {
  const std::vector<std::string> words = split(text);
  std::vector<double> numbers;
  for (const std::string& word : words)
    if (const auto number = parse_number(word)) numbers.push_back(*number);
  if (words.size() < 2 || words.size() > 3 || numbers.size() != words.size())
    refuse(text, "is not a camera",
           name_remedy(text, kCameras, "cameras") +
               "; or follow:BODY, or AZIMUTH,ELEVATION[,DISTANCE] in degrees and metres");
  if (std::abs(numbers[1]) > 90)
    refuse(text, "has an elevation beyond 90 degrees", "give -90 to 90");
  if (numbers.size() == 3 && !(numbers[2] > 0))
    refuse(text, "has a distance that is not positive", "give metres");
  return {numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0, -1};
}

}  // namespace

void Extent::add(const Vector3& p_W) {
  if (!p_W.allFinite()) return;
  points_.push_back(p_W);
  box_.extend(p_W);
}

void Extent::add(const SceneMeshes& meshes, const Snapshot& snapshot) {
  const auto add_box_of = [&](const ScenePart& part, const Pose& X_WL) {
    const Pose X_WM = X_WL * part.X_LM;
    for (int corner = 0; corner < 8; ++corner)
      add(X_WM * part.box_M.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  };
  for (const ScenePart& part : meshes.parts) add_box_of(part, snapshot.k.X_WL[part.body]);
  for (const ShownTargetRobot& target : snapshot.targets)
    for (const ScenePart& part : meshes.parts)
      if (part.robot == static_cast<int>(target.robot)) add_box_of(part, target.X_WL[part.body]);
  for (const TieLine& tie : meshes.ties) {
    add(snapshot.k.X_WL[tie.a] * tie.p_La);
    add(snapshot.k.X_WL[tie.b] * tie.p_Lb);
  }
}

double Extent::reach(const Vector3& p_W) const {
  double farthest = 0;
  for (const Vector3& p : points_) farthest = std::max(farthest, (p - p_W).norm());
  return farthest;
}

double max_distance_of_interest(const std::vector<Extent>& instants) {
  constexpr double kTimes = 4;
  std::vector<double> reaches;
  for (const Extent& extent : instants)
    reaches.push_back(extent.empty() ? 0 : extent.reach(instants.front().center()));
  if (reaches.empty() || instants.front().empty()) return 1e300;
  const double first = reaches.front();
  const auto quarter = reaches.begin() + static_cast<std::ptrdiff_t>(3 * reaches.size() / 4);
  std::nth_element(reaches.begin(), quarter, reaches.end());
  return kTimes * std::max(first, *quarter);
}

CameraWish parse_camera(const std::string& text, const Model<double>& model) {
  if (text.empty() || text == "auto") return {};
  if (text == "front") return {-90, 4, 0, -1};  // x to the right
  if (text == "side") return {0, 4, 0, -1};     // y to the right
  if (text == "top") return {-90, 90, 0, -1};   // x to the right, y up
  if (text == "iso") return {-45, 35.264389682754654, 0, -1};
  const std::string prefix = "follow:";
  if (text.compare(0, prefix.size(), prefix) != 0) return parse_orbit(text);
  CameraWish wish;
  wish.follow = model.find_body(text.substr(prefix.size()));
  if (wish.follow > 0) return wish;
  std::vector<std::string> names(model.body_name.begin() + 1, model.body_name.end());
  refuse(text, "names no body of this scene",
         name_remedy(text.substr(prefix.size()), names, "bodies"));
}

// In view coordinates (right, up, forward) a point p is visible if |p_x - e_x| <= t_x (p_z - e_z),
// so e_x - t_x e_z >= A = max(p_x - t_x p_z) and -e_x - t_x e_z >= B = max(-p_x - t_x p_z): the
// nearest eye has e_z = -(A + B) / (2 t_x), e_x = (A - B) / 2. Likewise y; the farther one is used.
Camera make_camera(const CameraWish& wish, const Extent& extent, double aspect) {
  Camera camera{.field_of_view = wish.field_of_view};
  const Vector3 forward = -towards_eye(wish);
  const bool is_steep = std::abs(forward.z()) > 0.999;
  if (is_steep) {  // x to the right in the top view
    const double a = wish.azimuth * kDegree;
    camera.up = (forward.z() < 0 ? -1.0 : 1.0) * Vector3(std::cos(a), std::sin(a), 0);
  }
  const Vector3 right = forward.cross(camera.up).normalized(), up = right.cross(forward);
  const double tan_y = std::tan(0.5 * camera.field_of_view) / kFrameMargin, tan_x = tan_y * aspect;
  const auto max_of = [&](auto f) {
    double found = -1e300;
    for (const Vector3& p : extent.points()) found = std::max(found, f(p));
    return found;
  };
  Vector3 target = extent.empty() ? Vector3(Vector3::Zero()) : extent.center();
  double distance = wish.distance;
  if (distance <= 0 && !extent.empty()) {
    const auto side = [&](const Vector3& axis, double tangent) {
      const double A =
          max_of([&](const Vector3& p) { return axis.dot(p) - tangent * forward.dot(p); });
      const double B =
          max_of([&](const Vector3& p) { return -axis.dot(p) - tangent * forward.dot(p); });
      return Eigen::Vector2d(0.5 * (A - B), -0.5 * (A + B) / tangent);
    };
    const Eigen::Vector2d x = side(right, tan_x), y = side(up, tan_y);
    const Vector3 eye = x[0] * right + y[0] * up + std::min(x[1], y[1]) * forward;
    distance = std::max(1e-3, forward.dot(target - eye));
    target = eye + distance * forward;
  }
  if (distance <= 0) distance = 3;
  camera.target = target;
  camera.eye = target - distance * forward;
  return camera;
}

double closeup(const SceneMeshes& meshes, int body, double field_of_view) {
  double radius = 0;
  for (const ScenePart& part : meshes.parts)
    if (part.body == static_cast<std::size_t>(body))
      radius = std::max(radius, 0.5 * part.box_M.sizes().norm());
  return 3 * radius / std::tan(0.5 * field_of_view);
}

Camera follow(Camera camera, const Vector3& target_W) {
  if (!target_W.allFinite()) return camera;
  const Vector3 offset = target_W - camera.target;
  camera.eye += offset;
  camera.target += offset;
  return camera;
}

double round_down(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double ten = std::pow(10.0, std::floor(std::log10(value)));
  const double lead = value / ten;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * ten;
}

}  // namespace twinarm
