#include <map>
#include <utility>

#include "devices/sim/hand/surface_net.hpp"

namespace armsreach::sim {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

class Halver {
 public:
  Halver(const TriangleMesh& mesh, const std::function<bool(const Eigen::Vector3f&)>& wanted) {
    made_.vertices = mesh.vertices;
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) halve(edge(t[i], t[(i + 1) % 3]), wanted);
    }
    for (const auto& t : mesh.triangles) split(t);
  }
  TriangleMesh take() { return std::move(made_); }

 private:
  void halve(const Edge& edge, const std::function<bool(const Eigen::Vector3f&)>& wanted) {
    if (middles_.count(edge)) return;
    const Eigen::Vector3f middle =
        0.5F * (made_.vertices[edge.first] + made_.vertices[edge.second]);
    if (!wanted(middle)) return;
    middles_[edge] = static_cast<std::uint32_t>(made_.vertices.size());
    made_.vertices.push_back(middle);
  }

  // Cuts from the middle of a halved edge to the opposite corner, then the halves likewise.
  void split(const std::array<std::uint32_t, 3>& t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      const std::uint32_t c = t[(i + 2) % 3];
      const auto middle = middles_.find(edge(a, b));
      if (middle == middles_.end()) continue;
      split({a, middle->second, c});
      split({middle->second, b, c});
      return;
    }
    made_.triangles.push_back(t);
  }

  TriangleMesh made_;
  std::map<Edge, std::uint32_t> middles_;
};

}  // namespace

TriangleMesh refined(const TriangleMesh& mesh,
                     const std::function<bool(const Eigen::Vector3f&)>& wanted) {
  return Halver(mesh, wanted).take();
}

}  // namespace armsreach::sim
