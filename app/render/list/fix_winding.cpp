// Each connected surface is walked from triangle to triangle across its edges.
#include "app/render/list/fix_winding.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace twinarm {
namespace {

using Edge = std::pair<int, int>;  // of vertices, ascending

struct Beside {
  std::size_t triangle;
  bool ascending;  // whether it runs along the edge from the lower vertex to the higher
};
using Neighbours = std::map<Edge, std::vector<Beside>>;

template <class Visit>
void visit_edges(const std::array<int, 3>& t, Visit visit) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int a = t[k], b = t[(k + 1) % 3];
    visit(Edge(std::min(a, b), std::max(a, b)), a < b);
  }
}

Neighbours neighbours_of(const TriangleMesh& mesh) {
  Neighbours beside;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    visit_edges(mesh.triangles[i], [&](const Edge& edge, bool ascending) {
      beside[edge].push_back({i, ascending});
    });
  return beside;
}

class Mender {
 public:
  explicit Mender(TriangleMesh& mesh)
      : mesh_(mesh), beside_(neighbours_of(mesh)), seen_(mesh.triangles.size()) {
    result.turned.resize(mesh.triangles.size());
  }

  MendedWinding result;

  void mend() {
    result.is_closed = !mesh_.triangles.empty();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (!seen_[i]) mend_surface(i);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (result.turned[i]) std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
  }

 private:
  const Vector3& corner(std::size_t i, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[i][k])];
  }

  void mend_surface(std::size_t first) {
    std::vector<std::size_t> surface{first};
    seen_[first] = true;
    bool closed = true;
    for (std::size_t next = 0; next < surface.size(); ++next) {  // grows while it is walked
      const std::size_t i = surface[next];
      visit_edges(mesh_.triangles[i], [&](const Edge& edge, bool ascending) {
        const std::vector<Beside>& both = beside_.at(edge);
        if (both.size() != 2) {
          closed = false;
          return;
        }
        const Beside& other = both[both[0].triangle == i ? 1 : 0];
        // They agree where they run along the edge in opposite directions.
        const bool turned = result.turned[i] != (other.ascending == ascending);
        if (seen_[other.triangle]) {
          if (result.turned[other.triangle] != turned) closed = false;  // a Moebius strip
          return;
        }
        seen_[other.triangle] = true;
        result.turned[other.triangle] = turned;
        surface.push_back(other.triangle);
      });
    }
    if (!closed) result.is_closed = false;
    if (closed ? volume(surface) < 0 : area_turned(surface) > 0)
      for (const std::size_t i : surface) result.turned[i] = !result.turned[i];
  }

  // Six times, about the first corner.
  double volume(const std::vector<std::size_t>& surface) const {
    const Vector3 about = corner(surface[0], 0);
    double sum = 0;
    for (const std::size_t i : surface) {
      const Vector3 a = corner(i, 0) - about, b = corner(i, 1) - about, c = corner(i, 2) - about;
      sum += (result.turned[i] ? -1 : 1) * a.dot(b.cross(c));
    }
    return sum;
  }

  // Less that of the others, twice.
  double area_turned(const std::vector<std::size_t>& surface) const {
    double sum = 0;
    for (const std::size_t i : surface) {
      const Vector3 b = corner(i, 1) - corner(i, 0), c = corner(i, 2) - corner(i, 0);
      sum += (result.turned[i] ? 1 : -1) * b.cross(c).norm();
    }
    return sum;
  }

  TriangleMesh& mesh_;
  Neighbours beside_;
  std::vector<bool> seen_;
};

}  // namespace

MendedWinding mend_winding(TriangleMesh& mesh) {
  Mender mender(mesh);
  mender.mend();
  return std::move(mender.result);
}

}  // namespace twinarm
